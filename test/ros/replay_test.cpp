// The program replay on bags of all kinds, made here without a master by what the node makes them with.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "bag_writer.h"
#include "bags.h"
#include "block_world/scene_yaml.h"
#include "conversions.h"
#include "publishers.h"

namespace block_world
{
namespace
{
constexpr char NODE[] = "/block_world";

/// Runs a world as the node does, with a bag.
class Session
{
public:
  Session(const std::string& path, const std::string& scene, const std::optional<int>& count = {})
    : world_(loadSceneFile(std::string(BLOCK_WORLD_DIR) + "/config/scenes/" + scene + ".yaml", { count, {} }))
    , bag_(path, NODE)
    , publishers_({ nullptr, &bag_, NODE }, world_, "world", "")
  {
    publishers_.publishScene(0);
    publish();
  }
  void advance(std::int64_t time_ns)
  {
    world_.advance(Time::fromNanoseconds(time_ns));
    now_ns_ = time_ns;
    for (const TimedCommand& input : world_.takeInputs())
      publishers_.publishInput(input.command, input.time.nanoseconds(), true);
  }
  void publish()
  {
    publishers_.publishState(now_ns_, world_.takeContacts());
  }
  void apply(const Command& command)
  {
    const Applied applied = world_.apply(command);
    ASSERT_TRUE(applied.ok) << applied.reason;
    publishers_.publishInput(applied.command, now_ns_, false);
  }
  void loadAgain()
  {
    world_ = World(Scene(world_.scene()), Time::fromNanoseconds(now_ns_));
    publishers_.publishScene(now_ns_);
  }
  void saveAndRestore()
  {
    const std::string saved = world_.save();
    world_ = World::restore(saved);
    publishers_.publishRestored(saved, now_ns_);
  }
  World& world()
  {
    return world_;
  }
  void close()
  {
    bag_.close();
  }

private:
  World world_;
  BagWriter bag_;
  Publishers publishers_;
  std::int64_t now_ns_ = 0;
};

class Replaying : public testing::Test
{
protected:
  std::string path(const std::string& name)
  {
    const std::string file = testing::TempDir() + "block_world_" + std::to_string(getpid()) + "_" + name;
    files_.push_back(file);
    return file;
  }
  void TearDown() override
  {
    for (const std::string& file : files_)
      for (const char* end : { "", ".active", ".orig", ".active.orig" })
        std::remove((file + end).c_str());
  }

  /// Six blocks for 4 s, pushed at random by all kinds of commands; states at 60 Hz and some between commands of one
  /// instant.
  std::string driven(const std::string& scene = "six_blocks")
  {
    const std::string bag = path("driven.bag");
    Session session(bag, scene, 6);
    std::mt19937 random(7);
    const auto share = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    for (int k = 1; k <= 240; ++k)
    {
      session.advance(k * 16666667ll - 5000001);
      const std::string block = "block" + std::to_string(1 + random() % 2);
      if (k % 3 == 0)
        session.apply(
            ThrustCommand{ block, { share(0, 1), share(0, 1), share(0, 1), 0, share(0, 1), 0 }, share(0, 1) });
      if (k % 7 == 0)
        session.apply(WrenchCommand{ block, Eigen::Vector2d(share(-1, 1), share(-1, 1)), share(-0.5, 0.5) });
      session.advance(k * 16666667ll);
      if (k % 11 == 0)
        session.publish();
      if (k % 11 == 0)
        session.apply(
            SpringCommand{ true, "", {}, Eigen::Vector2d(share(-4, 4), share(-4, 4)), 5.0, 0.1, share(0, 1) });
      session.publish();
      if (k % 40 == 0)
        session.apply(SetCommand{ share(0, 5), share(0.5, 1), share(0, 0.1), {}, {} });
      if (k == 100)
        session.apply(DeleteCommand{ "block3" });
      if (k == 150)
        session.loadAgain();
      if (k == 170)
        session.saveAndRestore();
      if (k == 200)
        session.apply(ResetCommand());
      if (k % 50 == 0)
        session.publish();
    }
    session.close();
    return bag;
  }

  /// The bag with one input changed.
  std::string withChange(const std::string& bag, std::uint64_t index, const std::function<void(msg::Input&)>& change)
  {
    const std::string changed = path("changed.bag");
    copyBag(bag, changed, [&](msg::Input& input) {
      if (input.index == index)
        change(input);
      return true;
    });
    return changed;
  }

private:
  std::vector<std::string> files_;
};

/// Number of the first logged input of a kind, after some.
std::uint64_t findInput(const std::string& path, int kind, std::uint64_t after = 5)
{
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/block_world/inputs")))
  {
    const msg::Input::ConstPtr input = message.instantiate<msg::Input>();
    if (input->kind == kind && input->index > after)
      return input->index;
  }
  ADD_FAILURE() << "no input of kind " << kind;
  return 0;
}

TEST_F(Replaying, SameBits)
{
  for (const char* scene : { "six_blocks", "pile", "springs" })
  {
    const Outcome outcome = replay(driven(scene));
    EXPECT_EQ(outcome.status, 0) << scene << ": " << outcome.text;
    EXPECT_TRUE(has(outcome.text, "states identical")) << outcome.text;
  }
}

TEST_F(Replaying, OneUlpOfACommandIsFound)
{
  const std::string bag = driven();
  const auto nudge = [](double& value) { value = std::nextafter(value, HUGE_VAL); };
  const std::pair<int, std::function<void(msg::Input&)>> changes[] = {
    { msg::Input::THRUST, [&](msg::Input& input) { nudge(input.thrust.levels[1]); } },
    { msg::Input::THRUST, [&](msg::Input& input) { nudge(input.thrust.duration); } },
    { msg::Input::SPRING, [&](msg::Input& input) { nudge(input.spring.anchor.y); } },
    { msg::Input::WRENCH, [&](msg::Input& input) { nudge(input.wrench.torque.z); } },
    { msg::Input::SET, [&](msg::Input& input) { nudge(input.values[0]); } },
  };
  for (const auto& [kind, change] : changes)
  {
    const std::uint64_t index = findInput(bag, kind);
    const Outcome outcome = replay(withChange(bag, index, change));
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(has(outcome.text, "after input " + std::to_string(index) + " ")) << outcome.text;
  }
}

// Those in flight just then: their states remember when they were pushed.
TEST_F(Replaying, OneNanosecondIsFound)
{
  const std::string bag = driven();
  for (const int kind : { msg::Input::THRUST, msg::Input::WRENCH })
    for (const int shift : { -1, 1 })
    {
      const std::uint64_t index = findInput(bag, kind);
      const Outcome outcome = replay(withChange(bag, index, [&](msg::Input& input) { input.time_ns += shift; }));
      EXPECT_EQ(outcome.status, 1) << outcome.text;
      EXPECT_TRUE(has(outcome.text, "input " + std::to_string(index) + " ")) << outcome.text;
    }
}

TEST_F(Replaying, TimedInputsOfTheSceneAreComparedToo)
{
  const std::string bag = path("timed.bag");
  Session session(bag, "thrusters");
  for (int k = 1; k <= 120; ++k)
  {
    session.advance(k * 16666667ll);
    session.publish();
  }
  session.close();
  EXPECT_EQ(replay(bag).status, 0) << replay(bag).text;
  const std::uint64_t index = findInput(bag, msg::Input::THRUST, 0);
  const Outcome outcome = replay(withChange(bag, index, [](msg::Input& input) { ++input.time_ns; }));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(has(outcome.text, "input " + std::to_string(index) + " (THRUST, the scene's)")) << outcome.text;
}

// A state that is wrong by one bit: time, block, field and both values are told.
TEST_F(Replaying, TellsWhatDiffers)
{
  const std::string bag = driven(), changed = path("state.bag");
  rosbag::Bag source(bag), target(changed, rosbag::bagmode::Write);
  int count = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(source))
  {
    const msg::BodyStates::ConstPtr states = message.instantiate<msg::BodyStates>();
    if (!states || ++count != 33)
    {
      target.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
      continue;
    }
    msg::BodyStates wrong = *states;
    wrong.bodies[1].vy = 0.125;
    wrong.state_hash += 1;
    target.write(message.getTopic(), message.getTime(), wrong, message.getConnectionHeader());
  }
  target.close();
  const Outcome outcome = replay(changed);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(has(outcome.text, "block2.vy is 0.125 in the bag, ")) << outcome.text;
  EXPECT_EQ(replay(changed, "--until 0.4").status, 0);
}

TEST_F(Replaying, WritesTheNewRun)
{
  const std::string bag = driven(), again = path("again.bag");
  EXPECT_EQ(replay(bag, "--out " + again).status, 0);
  const Outcome first = replay(bag), second = replay(again);
  EXPECT_EQ(second.status, 0) << second.text;
  EXPECT_EQ(second.text, first.text);
}

TEST_F(Replaying, AnotherToleranceIsADeviation)
{
  const std::string bag = path("pile.bag");
  EXPECT_EQ(runCommand(std::string(BLOCK_WORLD_SIMULATE) + " " + BLOCK_WORLD_DIR +
                       "/config/scenes/pile.yaml --duration 2 " + "--states /dev/null --bag " + bag)
                .status,
            0);
  const Outcome outcome = replay(bag, "--tolerance 1e-5");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_TRUE(has(outcome.text, "121 states compared, largest deviation")) << outcome.text;
}

TEST_F(Replaying, SimulateWritesWhatTheNodeWould)
{
  const std::string bag = path("simulated.bag");
  const std::string simulate = std::string(BLOCK_WORLD_SIMULATE) + " " + BLOCK_WORLD_DIR +
                               "/config/scenes/thrusters.yaml " +
                               "--duration 3 --sample 0.07 --states /dev/null --bag ";
  EXPECT_EQ(runCommand(simulate + bag).status, 0);
  const Outcome outcome = replay(bag);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(has(outcome.text, "181 states identical")) << outcome.text;
  rosbag::Bag written(bag);
  std::set<std::string> latched;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(written).getConnections())
    if (connection->header->at("latching") == "1")
      latched.insert(connection->topic);
  EXPECT_EQ(latched, std::set<std::string>({ "/block_world/markers", "/block_world/scene" }));
  EXPECT_EQ(runCommand(simulate + "/no/such/folder/x.bag").status, 2);
}

// Bags that cannot be used.

TEST_F(Replaying, RefusesWhatIsNoBag)
{
  const std::string file = path("text.bag");
  std::ofstream(file) << "no bag\n";
  EXPECT_EQ(replay(file).status, 2);
  EXPECT_TRUE(has(replay(file).text, "is no bag"));
  EXPECT_EQ(replay(path("absent.bag")).status, 2);
  EXPECT_EQ(replay(file, "--tolerance 0").status, 2);
  EXPECT_EQ(replay(file, "--unknown").status, 2);
}

/// A bag without its index: replay says what to do, and then there are more than so many states.
void expectMended(const std::string& bag, int states)
{
  const Outcome cut = replay(bag);
  EXPECT_EQ(cut.status, 2);
  EXPECT_TRUE(has(cut.text, "rosbag reindex")) << cut.text;
  EXPECT_EQ(runCommand("rosbag reindex -q " + bag).status, 0);
  const Outcome rest = replay(bag);
  EXPECT_EQ(rest.status, 0) << rest.text;
  EXPECT_GT(std::atoi(rest.text.c_str()), states) << rest.text;
}

// A program killed while it records, as by kill -9: what was written replays once it is indexed.
TEST_F(Replaying, TheRestOfAKilledRecording)
{
  const std::string bag = path("killed.bag");
  const pid_t child = fork();
  if (child == 0)
  {
    Session session(bag, "six_blocks");
    for (int k = 1; k <= 3000; ++k)
    {
      session.advance(k * 16666667ll);
      if (k % 5 == 0)
        session.apply(WrenchCommand{ "block1", Eigen::Vector2d(0.1 * (k % 7), 0.0), 0.1 });
      session.publish();
    }
    _exit(0);  // no buffer is flushed, no index is written
  }
  waitpid(child, nullptr, 0);
  expectMended(bag + ".active", 2000);
}

TEST_F(Replaying, TruncatedBag)
{
  const std::string bag = driven(), half = path("half.bag");
  ASSERT_EQ(runCommand("head -c $(($(stat -c %s " + bag + ") * 2 / 3)) " + bag + " >" + half).status, 0);
  expectMended(half, 100);
}

TEST_F(Replaying, WithoutScene)
{
  const std::string bag = driven(), without = path("without.bag");
  copyBag(bag, without,
          [](msg::Input& input) { return input.kind != msg::Input::LOAD_SCENE && input.kind != msg::Input::RESTORE; });
  EXPECT_EQ(replay(without).status, 2);
  EXPECT_TRUE(has(replay(without).text, "no scene"));
  copyBag(bag, without, [](msg::Input&) { return false; });
  EXPECT_EQ(replay(without).status, 2);
  EXPECT_TRUE(has(replay(without).text, "no commands")) << replay(without).text;
}

TEST_F(Replaying, AMissingCommand)
{
  const std::string bag = driven(), without = path("without.bag");
  copyBag(bag, without, [](msg::Input& input) { return input.index != 17; });
  EXPECT_EQ(replay(without).status, 2);
  EXPECT_TRUE(has(replay(without).text, "commands 17 to 17 are missing")) << replay(without).text;
  // The last one.
  copyBag(bag, without, [](msg::Input& input) { return input.index < 17; });
  EXPECT_EQ(replay(without).status, 2);
  EXPECT_TRUE(has(replay(without).text, "command 17 is missing")) << replay(without).text;
}

TEST_F(Replaying, AnUnknownCommand)
{
  const Outcome outcome = replay(withChange(driven(), 9, [](msg::Input& input) { input.kind = 77; }));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.text, "input 9")) << outcome.text;
  EXPECT_TRUE(has(outcome.text, "kind 77")) << outcome.text;
}

TEST_F(Replaying, MessagesOfAnotherVersion)
{
  const std::string bag = driven(), other = path("other.bag");
  {
    rosbag::Bag source(bag), target(other, rosbag::bagmode::Write);
    std::map<std::string, boost::shared_ptr<ros::M_string>> headers;
    for (const rosbag::MessageInstance& message : rosbag::View(source))
    {
      boost::shared_ptr<ros::M_string>& header = headers[message.getTopic()];
      if (!header)
      {
        header = boost::make_shared<ros::M_string>(*message.getConnectionHeader());
        if (message.getTopic() == "/block_world/inputs")
          (*header)["md5sum"] = "0123456789abcdef0123456789abcdef";
      }
      target.write(message.getTopic(), message.getTime(), message, header);
    }
  }
  const Outcome outcome = replay(other);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.text, "in another version")) << outcome.text;
}

}  // namespace
}  // namespace block_world
