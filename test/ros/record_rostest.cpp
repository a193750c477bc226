// A run recorded by the launch file and driven at random from outside, replayed: the same bits.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "bags.h"
#include "node_client.h"

namespace block_world
{
namespace
{
/// roslaunch in a process group of its own, like one that was started in a terminal.
class Launch
{
public:
  explicit Launch(const std::string& arguments)
  {
    pid_ = fork();
    EXPECT_GE(pid_, 0);
    if (pid_ == 0)
    {
      setpgid(0, 0);
      const std::string command =
          "exec roslaunch block_world block_world.launch rviz:=false " + arguments + " >/dev/null 2>&1";
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(1);
    }
  }
  ~Launch()
  {
    end(SIGKILL);
  }
  /// Ctrl-C, by default; waits until all is over.
  void end(int signal = SIGINT)
  {
    if (pid_ <= 0)
      return;
    kill(pid_, signal);
    wait();
  }
  /// The node alone is killed, as by kill -9.
  void killNode() const
  {
    EXPECT_EQ(runCommand("pkill -KILL -P " + std::to_string(pid_) + " block_world").status, 0);
  }
  void wait()
  {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
  }

private:
  pid_t pid_ = -1;
};

/// Everything that may be asked of a world, at random.
class Driver
{
public:
  explicit Driver(NodeClient& client) : client_(client)
  {
    thrust_ = handle_.advertise<msg::Thrust>(client.topic(topics::THRUST), 1000);
    spring_ = handle_.advertise<msg::SpringForce>(client.topic(topics::SPRING), 1000);
    wrench_ = handle_.advertise<geometry_msgs::WrenchStamped>(client.topic(topics::WRENCH), 1000);
    EXPECT_TRUE(waitFor([this] {
      return thrust_.getNumSubscribers() > 0 && spring_.getNumSubscribers() > 0 && wrench_.getNumSubscribers() > 0;
    }));
  }

  /// Commands by topic at 200 Hz of the computer's clock, and now and then a service.
  void drive(double seconds)
  {
    const ros::WallTime start = ros::WallTime::now();
    for (int k = 0; ros::WallTime::now() < start + ros::WallDuration(seconds); ++k)
    {
      command();
      if (k % 40 == 39)
        callService(k / 40);
      ros::WallTime::sleepUntil(start + ros::WallDuration(k / 200.0));
    }
  }

private:
  double between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::string anyBlock()
  {
    return "block" + std::to_string(1 + random_() % 3);
  }
  void command()
  {
    switch (random_() % 4)
    {
      case 0: {
        msg::SpringForce spring;
        spring.active = random_() % 3 != 0;
        spring.anchor.x = between(-5, 5);
        spring.anchor.y = between(-5, 5);
        spring.stiffness = between(1, 20);
        spring.damping = between(0, 1);
        spring.duration = between(0, 0.3);
        return spring_.publish(spring);
      }
      case 1: {
        geometry_msgs::WrenchStamped wrench;
        wrench.header.frame_id = anyBlock();
        wrench.wrench.force.x = between(-1, 1);
        wrench.wrench.force.y = between(-1, 1);
        wrench.wrench.torque.z = between(-1, 1);
        return wrench_.publish(wrench);
      }
      default: {
        msg::Thrust thrust;
        thrust.body = anyBlock();
        for (int i = 0; i < 6; ++i)
          thrust.levels.push_back(between(0, 1));
        thrust.duration = between(0, 0.4);
        return thrust_.publish(thrust);
      }
    }
  }
  void callService(int which)
  {
    const std::string state = testing::TempDir() + "block_world_record.state";
    switch (which % 8)
    {
      case 0: {
        msg::SetState::Request request;
        request.state.name = anyBlock();
        request.state.x = between(-3, 3);
        request.state.y = between(-3, 3);
        request.state.vx = between(-1, 1);
        client_.call<msg::SetState>(topics::SET_STATE, request);  // may be refused
        break;
      }
      case 1: {
        msg::SpawnBlock::Request request;
        request.block = "{name: extra, size: [0.3, 0.2], pose: [" + std::to_string(between(-5, 5)) + ", 5.5, 0.1]}";
        client_.call<msg::SpawnBlock>(topics::SPAWN_BLOCK, request);
        break;
      }
      case 2: {
        dynamic_reconfigure::Reconfigure service;
        service.request.config.doubles.resize(1);
        service.request.config.doubles[0].name = random_() % 2 == 0 ? "gravity" : "damping";
        service.request.config.doubles[0].value = between(0, 0.5);
        EXPECT_TRUE(ros::service::call(client_.topic("set_parameters"), service));
        break;
      }
      case 3: {
        msg::SaveState::Request request;
        request.path = state;
        EXPECT_TRUE(client_.call<msg::SaveState>(topics::SAVE_STATE, request).success);
        break;
      }
      case 4: {
        msg::DeleteBlock::Request request;
        request.name = "extra";
        client_.call<msg::DeleteBlock>(topics::DELETE_BLOCK, request);
        break;
      }
      case 5:
        client_.pause(true);
        client_.advance(0.0123);
        client_.pause(false);
        break;
      case 6: {
        msg::RestoreState::Request request;
        request.path = state;
        EXPECT_TRUE(client_.call<msg::RestoreState>(topics::RESTORE_STATE, request).success);
        break;
      }
      default:
        client_.reset();
    }
  }

  NodeClient& client_;
  ros::NodeHandle handle_;
  ros::Publisher thrust_, spring_, wrench_;
  std::mt19937 random_{ 11 };
};

std::string bagPath(const std::string& name)
{
  return testing::TempDir() + "block_world_" + std::to_string(getpid()) + "_" + name + ".bag";
}

double driveTime()
{
  const char* const given = std::getenv("BLOCK_WORLD_DRIVE_SECONDS");
  return given != nullptr ? std::atof(given) : 8.0;
}

std::vector<msg::BodyStates> statesOf(const std::string& path)
{
  std::vector<msg::BodyStates> states;
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/block_world/bodies")))
    states.push_back(*message.instantiate<msg::BodyStates>());
  return states;
}
}  // namespace

TEST(Record, ADrivenRunReplays)
{
  const std::string bag = bagPath("driven");
  msg::BodyStates last;
  {
    Launch launch("record:=" + bag);
    NodeClient client("block_world");
    Driver(client).drive(driveTime());
    client.pause(true);
    last = client.state();
    launch.end();
  }
  const Outcome outcome = replay(bag);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  std::printf("%s", outcome.text.c_str());
  // From the first instant to the last one.
  const std::vector<msg::BodyStates> states = statesOf(bag);
  ASSERT_FALSE(states.empty());
  EXPECT_EQ(states.front().time_ns, 0);
  EXPECT_EQ(states.front().inputs, 1u);
  EXPECT_EQ(states.back().state_hash, last.state_hash);
  EXPECT_EQ(states.back().inputs, last.inputs);
  EXPECT_GT(last.inputs, static_cast<std::uint64_t>(driveTime() * 100));
  std::remove(bag.c_str());
}

// Killed in the middle of it, at other rates of publication and of time.
TEST(Record, AKilledRunReplaysUpToThere)
{
  const std::string bag = bagPath("killed");
  ros::NodeHandle handle;
  handle.setParam("/block_world/publish_rate", 37.0);
  Launch launch("record:=" + bag + " scene:=pile real_time_factor:=3");
  NodeClient client("block_world");
  Listener<msg::BodyStates> bodies(client.topic(topics::BODIES), 1000);
  ASSERT_TRUE(waitFor([&] { return !bodies.messages.empty() && bodies.messages.back().time_ns > 6000000000; }, 30.0));
  launch.killNode();
  launch.wait();
  handle.deleteParam("/block_world/publish_rate");
  EXPECT_EQ(replay(bag + ".active").status, 2);
  EXPECT_EQ(runCommand("rosbag reindex -q " + bag + ".active").status, 0);
  const Outcome outcome = replay(bag + ".active");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_GT(std::atoi(outcome.text.c_str()), 37 * 4) << outcome.text;
  std::printf("%s", outcome.text.c_str());
  std::remove((bag + ".active").c_str());
  std::remove((bag + ".active.orig").c_str());
}

TEST(Record, ABagThatCannotBeWrittenEndsTheLaunch)
{
  Launch launch("record:=/no/such/folder/run.bag");
  launch.wait();
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "record_rostest", ros::init_options::NoSigintHandler);
  return RUN_ALL_TESTS();
}
