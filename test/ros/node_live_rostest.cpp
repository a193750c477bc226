// Parameters that change while the node runs, as a user changes them: by dynamic_reconfigure. The tests share one
// world.

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <thread>

#include "block_world/scene_yaml.h"
#include "node_client.h"

namespace block_world
{
namespace
{
constexpr double G = 9.8;
// A few roundings of numbers around 10.
constexpr double ROUNDING = 1e-13;

using Values = std::map<std::string, double>;

Values toValues(const dynamic_reconfigure::Config& config)
{
  Values values;
  for (const auto& entry : config.doubles)
    values[entry.name] = entry.value;
  for (const auto& entry : config.ints)
    values[entry.name] = entry.value;
  return values;
}

class NodeLive : public testing::Test
{
protected:
  NodeLive() : client("block_world")
  {
  }

  /// Asks for values and returns those that hold afterwards.
  Values set(const Values& asked, const std::string& node = "/block_world")
  {
    dynamic_reconfigure::Reconfigure service;
    for (const auto& [name, value] : asked)
      if (name == "count")
      {
        service.request.config.ints.emplace_back();
        service.request.config.ints.back().name = name;
        service.request.config.ints.back().value = static_cast<int>(value);
      }
      else
      {
        service.request.config.doubles.emplace_back();
        service.request.config.doubles.back().name = name;
        service.request.config.doubles.back().value = value;
      }
    EXPECT_TRUE(ros::service::call(node + "/set_parameters", service));
    return toValues(service.response.config);
  }

  double parameter(const std::string& name, const std::string& node = "/block_world")
  {
    double value = std::nan("");
    handle.getParam(node + "/" + name, value);
    return value;
  }

  ros::NodeHandle handle;
  NodeClient client;
};

}  // namespace

TEST_F(NodeLive, beginsWithTheSceneAndTheParametersInPlaceOfIt)
{
  Listener<dynamic_reconfigure::Config> updates(client.topic("parameter_updates"), 10);
  ASSERT_TRUE(updates.waitForCount(1));
  const Values wanted = { { "gravity", 2.5 },       { "elasticity", 1.0 },      { "damping", 0.0 },
                          { "thrust", 4.0 },        { "count", 3.0 },           { "mass", 1.0 },
                          { "mouse_damping", 0.0 }, { "mouse_stiffness", 3.0 }, { "real_time_factor", 1.0 } };
  EXPECT_EQ(toValues(updates.messages.back()), wanted);
  for (const auto& [name, value] : wanted)
    EXPECT_EQ(parameter(name), value) << name;
}

// The way of the command line. A block falls 1 m from rest and rises to e^2 m.
TEST_F(NodeLive, commandLineToolSetsAndAgreesWithAllOthers)
{
  msg::LoadScene::Request scene;
  scene.path = BLOCK_WORLD_DIR "/test/scenes/bounce.yaml";
  ASSERT_TRUE(client.call<msg::LoadScene>(topics::LOAD_SCENE, scene).success);
  EXPECT_EQ(parameter("gravity"), G) << "a scene loaded brings its own values";
  EXPECT_EQ(parameter("mass"), 2.0);
  EXPECT_EQ(parameter("count"), 2.0);

  Listener<dynamic_reconfigure::Config> updates(client.topic("parameter_updates"), 10);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(updates.waitForCount(1) && inputs.waitForCount(1));
  client.advance(0.1);
  const std::int64_t now = static_cast<std::int64_t>(client.state().header.stamp.toNSec());
  // Debian's python3, whatever else PATH offers first.
  ASSERT_EQ(std::system("PATH=/usr/bin:$PATH timeout 30 rosrun dynamic_reconfigure dynparam set /block_world "
                        "elasticity 0.5"),
            0);
  EXPECT_EQ(parameter("elasticity"), 0.5);
  ASSERT_TRUE(updates.waitForCount(2) && inputs.waitForCount(2));
  EXPECT_EQ(toValues(updates.messages.back())["elasticity"], 0.5);
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::SET));
  EXPECT_EQ(inputs.messages[1].names, std::vector<std::string>({ "elasticity" }));
  EXPECT_EQ(inputs.messages[1].values, std::vector<double>({ 0.5 }));
  EXPECT_EQ(inputs.messages[1].time_ns, now);

  const double fall = std::sqrt(2.0 / G);
  const msg::BodyState top = client.advance(fall - 0.1 + 0.5 * fall)[0];
  // Within the tolerance of where it touches.
  EXPECT_NEAR(top.y, 0.5 + 0.25, 3e-6);
  EXPECT_NEAR(top.vy, 0.0, 1e-5);
}

TEST_F(NodeLive, valuesActOnTheWorldAtOnce)
{
  client.load("blocks: [{name: a, size: [1, 1], mass: 2, pose: [0, 0, 0], velocity: [1, 0, 0]}]");
  Values values = set({ { "gravity", 3.0 }, { "mass", 4.0 }, { "thrust", 8.0 } });
  EXPECT_EQ(values["gravity"], 3.0);
  EXPECT_EQ(values["mass"], 4.0);
  msg::Step::Request push;
  push.duration = 1.0;
  push.thrust.resize(1);
  push.thrust[0].body = "a";
  push.thrust[0].levels = { 0, 0, 1, 0, 0, 0 };
  push.thrust[0].duration = 1.0;
  // 8 N on 4 kg against a gravity of 3 m/s^2.
  EXPECT_NEAR(client.step(push).state.bodies[0].vy, 8.0 / 4.0 - 3.0, ROUNDING);

  set({ { "gravity", 0.0 }, { "damping", 2.0 } });
  // v' = -k v / m
  EXPECT_NEAR(client.advance(1.5)[0].vx, std::exp(-2.0 * 1.5 / 4.0), ROUNDING);

  set({ { "mouse_stiffness", 5.0 }, { "mouse_damping", 0.25 } });
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  msg::Step::Request pull;
  pull.spring.resize(1);
  pull.spring[0].active = true;
  pull.spring[0].body = "a";
  ASSERT_TRUE(client.step(pull).success);
  ASSERT_TRUE(inputs.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].spring.stiffness, 5.0);
  EXPECT_EQ(inputs.messages[1].spring.damping, 0.25);
  set({ { "mouse_stiffness", 3.0 }, { "mouse_damping", 0.0 } });
}

TEST_F(NodeLive, resetBringsBackTheValuesOfTheScene)
{
  client.load("gravity: 1\nelasticity: 0.75\nthrusters: {strength: 2}\nblocks: [{mass: 2, pose: [0, 0, 0]}]");
  set({ { "gravity", 5.0 }, { "elasticity", 0.25 }, { "damping", 1.0 }, { "thrust", 6.0 }, { "mass", 7.0 } });
  client.reset();
  EXPECT_EQ(parameter("gravity"), 1.0);
  EXPECT_EQ(parameter("elasticity"), 0.75);
  EXPECT_EQ(parameter("damping"), 0.0);
  EXPECT_EQ(parameter("thrust"), 2.0);
  EXPECT_EQ(parameter("mass"), 2.0);
}

TEST_F(NodeLive, valuesThatASceneSetsItselfAreShared)
{
  client.load("gravity: 1\nblocks: [{pose: [0, 0, 0]}]\ninputs: [{time: 0.5, set: {gravity: 4}}]");
  EXPECT_EQ(parameter("gravity"), 1.0);
  client.advance(1.0);
  EXPECT_EQ(parameter("gravity"), 4.0);
}

TEST_F(NodeLive, outOfRangeIsClampedAndSaid)
{
  client.load("elasticity: 0.5\nblocks: [{pose: [0, 0, 0]}]");
  Listener<rosgraph_msgs::Log> log("/rosout", 100);
  ASSERT_TRUE(log.waitForPublisher());
  EXPECT_EQ(set({ { "elasticity", 1.5 } })["elasticity"], 1.0);
  EXPECT_EQ(parameter("elasticity"), 1.0);
  // Again until the log's subscriber has found the node.
  EXPECT_TRUE(waitFor([&] {
    set({ { "elasticity", 0.5 } });
    set({ { "elasticity", 1.5 } });
    return std::any_of(log.messages.begin(), log.messages.end(), [](const rosgraph_msgs::Log& line) {
      return line.msg.find("elasticity changed from 0.5 to 1 (the most there is)") != std::string::npos;
    });
  }));
}

TEST_F(NodeLive, whatTheWorldRefusesChangesNothing)
{
  client.load("gravity: 1\nblocks: [{mass: 2, pose: [0, 0, 0]}, {pose: [5, 0, 0]}]");
  const std::uint64_t before = client.hash();
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  const double nan = std::nan(""), infinite = HUGE_VAL;
  for (const Values& bad : { Values{ { "mass", 0.0 } }, Values{ { "count", 3.0 } }, Values{ { "count", 0.0 } },
                             Values{ { "gravity", nan } }, Values{ { "gravity", 7.0 }, { "mass", infinite } },
                             Values{ { "real_time_factor", nan } }, Values{ { "mouse_stiffness", nan } } })
  {
    const Values values = set(bad);
    EXPECT_EQ(values.at("gravity"), 1.0);
    EXPECT_EQ(values.at("mass"), 2.0);
    EXPECT_EQ(values.at("count"), 2.0);
    EXPECT_EQ(values.at("real_time_factor"), 1.0);
    EXPECT_EQ(values.at("mouse_stiffness"), 3.0);
  }
  EXPECT_EQ(client.hash(), before);
  EXPECT_EQ(inputs.messages.size(), 1u);
}

// A scene of the sun's gravity and 20 blocks keeps both when something else is changed.
TEST_F(NodeLive, valuesOfTheSceneAreNotClampedByTheChangeOfAnother)
{
  std::string text = "gravity: 274\nblocks:\n";
  for (int i = 0; i < 20; ++i)
    text += "  - {size: [1, 1], mass: 5000, pose: [" + std::to_string(2 * i) + ", 0, 0]}\n";
  client.load(text);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  const Values values = set({ { "elasticity", 0.5 } });
  EXPECT_EQ(values.at("gravity"), 274.0);
  EXPECT_EQ(values.at("count"), 20.0);
  EXPECT_EQ(values.at("mass"), 5000.0);
  ASSERT_TRUE(inputs.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].names, std::vector<std::string>({ "elasticity" }));
}

TEST_F(NodeLive, anotherCountLoadsTheSceneAgain)
{
  msg::LoadScene::Request scene;
  scene.path = BLOCK_WORLD_DIR "/config/scenes/six_blocks.yaml";
  ASSERT_TRUE(client.call<msg::LoadScene>(topics::LOAD_SCENE, scene).success);
  client.advance(0.25);
  set({ { "gravity", 1.5 }, { "mass", 3.0 } });
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  const std::int64_t now = static_cast<std::int64_t>(client.state().header.stamp.toNSec());
  EXPECT_EQ(set({ { "count", 5.0 }, { "elasticity", 0.5 } })["count"], 5.0);
  const std::vector<msg::BodyState> bodies = client.state().bodies;
  ASSERT_EQ(bodies.size(), 5u);
  EXPECT_EQ(bodies[0].x, -5.3) << "the scene begins again";
  ASSERT_TRUE(inputs.waitForCount(2));
  EXPECT_EQ(inputs.messages.size(), 2u) << "all of it is one event";
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::LOAD_SCENE));
  EXPECT_EQ(inputs.messages[1].time_ns, now);
  const Scene loaded = loadSceneText(inputs.messages[1].text);
  EXPECT_EQ(loaded.blocks.size(), 5u);
  EXPECT_EQ(loaded.gravity, 1.5) << "values set before are kept";
  EXPECT_EQ(loaded.elasticity, 0.5);
  EXPECT_EQ(loaded.blocks[0].mass, 3.0);
}

// Without a new anchor, time would be due at 50 x what has passed since the run began.
TEST_F(NodeLive, paceChangesWithoutAJump)
{
  client.load("blocks: [{pose: [0, 0, 0]}]");
  const double before = client.state().header.stamp.toSec();
  const auto simulated = [&] {
    // A running world tells no state by its step service, so that pauses measure.
    client.pause(true);
    return client.state().header.stamp.toSec() - before;
  };
  client.pause(false);
  const ros::WallTime start = ros::WallTime::now();
  waitFor([] { return false; }, 1.0);
  const ros::WallTime asked = ros::WallTime::now();
  set({ { "real_time_factor", 50.0 } });
  const double at_once = simulated();
  const double slow = (asked - start).toSec(), fast = (ros::WallTime::now() - asked).toSec();
  EXPECT_GT(at_once, slow - 0.3);
  EXPECT_LT(at_once, slow + 50.0 * fast) << "of " << slow << " s slow and " << fast << " s fast";
  EXPECT_LT(fast, 0.5) << "this computer is too busy for this test";

  client.pause(false);
  waitFor([] { return false; }, 0.5);
  set({ { "real_time_factor", 0.0 } });
  waitFor([] { return false; }, 0.2);
  EXPECT_GT(simulated(), at_once + 0.3 * 50.0);
  EXPECT_EQ(set({ { "real_time_factor", 1.0 } })["real_time_factor"], 1.0);
  EXPECT_EQ(parameter("real_time_factor"), 1.0);
}

TEST_F(NodeLive, aFollowerHasNoPaceOfItsOwn)
{
  EXPECT_EQ(set({ { "real_time_factor", 2.0 } }, "/follower")["real_time_factor"], 1.0);
  EXPECT_EQ(set({ { "gravity", 2.0 } }, "/follower")["gravity"], 2.0);
}

TEST_F(NodeLive, pauseIsTold)
{
  Listener<std_msgs::Bool> paused(client.topic(topics::PAUSED), 10);
  ASSERT_TRUE(paused.waitForCount(1));
  EXPECT_TRUE(paused.messages.back().data);
  client.pause(true);
  client.pause(false);
  ASSERT_TRUE(paused.waitForCount(2));
  EXPECT_FALSE(paused.messages[1].data);
  client.pause(true);
  ASSERT_TRUE(paused.waitForCount(3));
  EXPECT_TRUE(paused.messages[2].data);
}

// What the server writes to the parameter server must not be taken for the user's wish by the next node of the name.
TEST_F(NodeLive, nothingOutlivesTheNode)
{
  handle.setParam("/guest/gravity", 2.0);
  for (const char* end : { "INT", "TERM" })
  {
    const std::string run = std::string("timeout -s ") + end +
                            " 20 " BLOCK_WORLD_NODE " __name:=guest _publish_clock:=false _tf_prefix:=guest/ "
                            "_scene:=" BLOCK_WORLD_DIR "/test/scenes/bounce.yaml 2>/dev/null >/dev/null & pid=$!; "
                            "sleep 3; kill -" +
                            end + " $pid; wait $pid";
    std::thread other([run] { std::system(("bash -c '" + run + "'").c_str()); });
    ASSERT_TRUE(waitFor([&] { return ros::service::exists("/guest/set_parameters", false); }, 3.0));
    EXPECT_EQ(set({ { "gravity", 7.0 } }, "/guest")["gravity"], 7.0);
    EXPECT_EQ(parameter("gravity", "/guest"), 7.0);
    EXPECT_EQ(parameter("mass", "/guest"), 2.0);
    other.join();
    EXPECT_EQ(parameter("gravity", "/guest"), 2.0) << end;
    for (const char* name :
         { "mass", "elasticity", "damping", "thrust", "count", "mouse_stiffness", "mouse_damping", "real_time_factor" })
      EXPECT_FALSE(handle.hasParam(std::string("/guest/") + name)) << name << " after " << end;
  }
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_live_rostest");
  return RUN_ALL_TESTS();
}
