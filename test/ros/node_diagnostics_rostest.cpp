// What /diagnostics says of worlds that do well and of worlds in trouble. The tests share one world.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "block_world/scene_yaml.h"
#include "block_world/world.h"
#include "node_client.h"

namespace block_world
{
namespace
{
using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;

class NodeDiagnostics : public testing::Test
{
protected:
  NodeDiagnostics() : client("block_world"), diagnostics("/diagnostics", 100)
  {
    EXPECT_TRUE(diagnostics.waitForPublisher());
  }

  /// The next but one message: all of it is of what was done before.
  DiagnosticArray next()
  {
    diagnostics.messages.clear();
    EXPECT_TRUE(diagnostics.waitForCount(2));
    return diagnostics.messages.back();
  }

  NodeClient client;
  Listener<DiagnosticArray> diagnostics;
};

const DiagnosticStatus& part(const DiagnosticArray& array, const std::string& name)
{
  for (const DiagnosticStatus& status : array.status)
    if (status.name == "block_world: " + name)
      return status;
  throw std::runtime_error("no part " + name);
}

std::string value(const DiagnosticStatus& status, const std::string& key)
{
  for (const auto& entry : status.values)
    if (entry.key == key)
      return entry.value;
  return "no value " + key;
}

double number(const DiagnosticStatus& status, const std::string& key)
{
  return std::atof(value(status, key).c_str());
}

}  // namespace

TEST_F(NodeDiagnostics, comeOncePerSecondWhilePaused)
{
  ASSERT_TRUE(diagnostics.waitForCount(2));
  diagnostics.messages.clear();
  waitFor([] { return false; }, 3.5);
  EXPECT_GE(diagnostics.messages.size(), 3u);
  EXPECT_LE(diagnostics.messages.size(), 4u);
  const DiagnosticStatus& pace = part(diagnostics.messages.back(), "pace");
  EXPECT_EQ(pace.level, DiagnosticStatus::OK);
  EXPECT_EQ(pace.message, "paused");
  EXPECT_EQ(value(pace, "mode"), "exact");
  EXPECT_EQ(value(pace, "blocks"), "2");
  EXPECT_EQ(value(pace, "slowest island"), "none");
  EXPECT_EQ(part(diagnostics.messages.back(), "accuracy").level, DiagnosticStatus::OK);
}

// A unit square between walls 2 m apart at 50 m/s hits one every 0.02 s.
TEST_F(NodeDiagnostics, tellThePaceAndTheEvents)
{
  client.load("walls: {left: -1, right: 1}\nblocks: [{size: [1, 1], pose: [0, 0, 0], velocity: [50, 0, 0]}]");
  client.pause(false);
  const DiagnosticArray message = next();
  client.pause(true);
  const DiagnosticStatus& pace = part(message, "pace");
  EXPECT_EQ(pace.level, DiagnosticStatus::OK) << pace.message;
  EXPECT_EQ(pace.message, "running");
  EXPECT_EQ(value(pace, "real-time factor asked for"), "1");
  EXPECT_NEAR(number(pace, "real-time factor reached"), 1.0, 0.1);
  // 50 hits, and looks ahead that find none yet; a hit more or less where the second begins.
  EXPECT_GE(number(pace, "events per simulated second"), 49.0);
  // Of a second, and so of 50 hits, one more or less may fall into the message.
  const std::string slowest = value(pace, "slowest island");
  double rate = 0.0;
  int share = 0;
  EXPECT_EQ(std::sscanf(slowest.c_str(), "block1: 100 %% of the computing; %d %% impacts, %lf a second", &share, &rate),
            2)
      << slowest;
  EXPECT_NEAR(rate, 50.0, 1.0) << slowest;
  const DiagnosticStatus& accuracy = part(message, "accuracy");
  EXPECT_EQ(accuracy.level, DiagnosticStatus::OK) << accuracy.message;
  EXPECT_NEAR(number(accuracy, "total energy (J)"), 0.5 * 50.0 * 50.0, 0.01);
  EXPECT_NEAR(number(accuracy, "balance error (J)"), 0.0, 1e-9);
  EXPECT_LT(number(accuracy, "worst overlap (m)"), 1e-6);
}

// A slot of 2e-7 m: 5 million hits per second are what truly happens there, and more than can be computed in a second.
TEST_F(NodeDiagnostics, warnWhereTimeFallsBehind)
{
  client.load("tolerance: 1.0e-12\nwalls: {left: -0.5000001, right: 0.5000001}\n"
              "blocks: [{size: [1, 1], pose: [0, 0, 0], velocity: [1, 0, 0]}]");
  client.pause(false);
  const DiagnosticArray message = next();
  client.pause(true);
  const DiagnosticStatus& pace = part(message, "pace");
  EXPECT_EQ(pace.level, DiagnosticStatus::WARN);
  EXPECT_NE(pace.message.find("too slow"), std::string::npos) << pace.message;
  EXPECT_NE(pace.message.find("real_time_factor"), std::string::npos) << pace.message;
  EXPECT_NE(pace.message.find("; block1: 100 % of the computing; "), std::string::npos) << pace.message;
  EXPECT_NE(pace.message.find(" % impacts, "), std::string::npos) << pace.message;
  EXPECT_LT(number(pace, "real-time factor reached"), 0.9);
  EXPECT_GT(number(pace, "simulated time lost (s)"), 0.0);
  client.reset();
  EXPECT_EQ(part(next(), "pace").level, DiagnosticStatus::OK) << "what is over is no warning any more";
}

// A slot of 2 nm at 1e6 m/s: 500 hits within 1e-12 s, of which this world, restored as it is, takes no more than 100
// for true.
TEST_F(NodeDiagnostics, failWhereTimeStandsStill)
{
  World world(loadSceneText("tolerance: 1.0e-12\nwalls: {left: -0.500000001, right: 0.500000001}\n"
                            "blocks: [{name: rattler, size: [1, 1], pose: [0, 0, 0], velocity: [1.0e+6, 0, 0]},\n"
                            "  {name: calm, size: [1, 1], pose: [0, 5, 0]}]",
                            "storm"));
  world.stallAfter(100);
  const std::string path = "/tmp/node_diagnostics_" + std::to_string(getpid());
  std::ofstream(path, std::ios::binary) << world.save();
  msg::RestoreState::Request restored;
  restored.path = path;
  ASSERT_TRUE(client.call<msg::RestoreState>(topics::RESTORE_STATE, restored).success);
  EXPECT_EQ(part(next(), "pace").message, "paused");

  // A step ends where time does.
  msg::Step::Request second;
  second.duration = 1.0;
  const msg::Step::Response step = client.step(second);
  EXPECT_FALSE(step.success);
  EXPECT_EQ(step.message.find("stalled at 'rattler': 100 events within 1e-12 s, "), 0u) << step.message;

  const DiagnosticArray message = next();
  const DiagnosticStatus& pace = part(message, "pace");
  EXPECT_EQ(pace.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(pace.message.find("stalled at 'rattler': 100 events within 1e-12 s, "), 0u) << pace.message;
  EXPECT_NE(pace.message.find(" % impacts; reset, or load another scene"), std::string::npos) << pace.message;
  EXPECT_NE(value(pace, "mode"), "exact");
  client.pause(false);
  EXPECT_EQ(part(next(), "pace").level, DiagnosticStatus::ERROR) << "running changes nothing";
  client.pause(true);

  // Commands act at whole nanoseconds, none of which comes any more.
  msg::SetState::Request moved;
  moved.state.name = "rattler";
  const msg::SetState::Response refused = client.call<msg::SetState>(topics::SET_STATE, moved);
  EXPECT_FALSE(refused.success);
  EXPECT_EQ(refused.message.find("stalled at 'rattler'"), 0u) << refused.message;
  client.reset();
  EXPECT_EQ(part(next(), "pace").message, "paused");

  ASSERT_TRUE(client.call<msg::RestoreState>(topics::RESTORE_STATE, restored).success);
  EXPECT_FALSE(client.step(second).success);
  client.load("blocks: [{size: [1, 1], pose: [0, 0, 0]}]");
  EXPECT_EQ(part(next(), "pace").message, "paused");
  EXPECT_EQ(client.advance(1.0).size(), 1u);
  std::remove(path.c_str());
}

TEST_F(NodeDiagnostics, failWhereTheEnergyIsNotFinite)
{
  client.load("blocks: [{size: [1, 1], pose: [0, 0, 0]}]");
  msg::SetState::Request fast;
  fast.state.name = "block1";
  fast.state.vx = 1e170;
  ASSERT_TRUE(client.call<msg::SetState>(topics::SET_STATE, fast).success);
  const DiagnosticArray broken = next();
  EXPECT_EQ(part(broken, "accuracy").level, DiagnosticStatus::ERROR);
  EXPECT_NE(part(broken, "accuracy").message.find("not finite"), std::string::npos);
  client.reset();
  EXPECT_EQ(part(next(), "accuracy").level, DiagnosticStatus::OK);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_diagnostics_rostest");
  return RUN_ALL_TESTS();
}
