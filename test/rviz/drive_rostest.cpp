// The tool in a real rviz, driven by true mouse and key events, judged by what the node says.

#include <ros/callback_queue.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "display.h"
#include "ros/node_client.h"

namespace block_world
{
namespace
{
using Levels = std::vector<double>;
const Levels NONE = { 0, 0, 0, 0, 0, 0 };
constexpr double THRUST = 1.5;   // N, the scene's
constexpr double PIXEL = 0.025;  // m, more than one is wide in the shipped view

struct Pixel
{
  int x, y;
};

/// The shipped configuration, drawn less often: here the processor draws, and takes most of rviz's time at 60 Hz. Its
/// window has a fixed size; where the world is in it is measured.
std::string configuration()
{
  std::ifstream shipped(BLOCK_WORLD_DIR "/config/block_world.rviz");
  std::string text{ std::istreambuf_iterator<char>(shipped), std::istreambuf_iterator<char>() };
  const std::string fast = "Frame Rate: 60";
  EXPECT_NE(text.find(fast), std::string::npos);
  text.replace(text.find(fast), fast.size(), "Frame Rate: 10");
  const std::string path = testing::TempDir() + "drive_rostest_" + std::to_string(getpid()) + ".rviz";
  std::ofstream(path) << text;
  return path;
}

}  // namespace

class Drive : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    display_ = new Display;
    controls_ = new Controls;
    configuration_ = configuration();
  }
  static void TearDownTestSuite()
  {
    delete rviz_;
    rviz_ = nullptr;
    delete controls_;
    unlink(configuration_.c_str());
    delete display_;
  }

  void SetUp() override
  {
    if (!rviz_)
    {
      rviz_ = new Process({ "rviz", "-d", configuration_ });
      measureView();
    }
    type("mousemove " + at(0, 3));
    client.pause(false);
    client.reset();
    ASSERT_TRUE(waitFor([this] { return !bodies.messages.empty() && body(0).vx == 0.0 && body(0).x == -4.0; }));
    pass(0.1);
    inputs.messages.clear();
  }

  void TearDown() override
  {
    if (rviz_)
      type("keyup e keyup s keyup shift keyup Left keyup ctrl mouseup 1");
  }

  static void type(const std::string& commands)
  {
    (*controls_)(commands);
  }

  static void pass(double seconds)
  {
    waitFor([] { return false; }, seconds);
  }

  const msg::BodyState& body(int index) const
  {
    return bodies.messages.back().bodies[index];
  }

  std::vector<msg::Input> inputsOf(int kind) const
  {
    std::vector<msg::Input> found;
    for (const msg::Input& input : inputs.messages)
      if (input.kind == kind)
        found.push_back(input);
    return found;
  }

  /// Thrusts of a block without those that only repeat.
  std::vector<msg::Input> thrustsOf(const std::string& block) const
  {
    std::vector<msg::Input> changes;
    for (const msg::Input& input : inputsOf(msg::Input::THRUST))
      if (input.thrust.body == block && (changes.empty() || changes.back().thrust.levels != input.thrust.levels))
        changes.push_back(input);
    return changes;
  }

  bool waitForThrust(const std::string& block, const Levels& levels) const
  {
    return waitFor([&] {
      const std::vector<msg::Input> thrusts = thrustsOf(block);
      return !thrusts.empty() && thrusts.back().thrust.levels == levels;
    });
  }

  /// The point of the world that the tool finds under a pixel; also waits for rviz to come.
  msg::SpringForce click(const Pixel& pixel, double patience)
  {
    inputs.messages.clear();
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience);
    while (inputsOf(msg::Input::SPRING).empty() && ros::WallTime::now() < end)
    {
      type("mousemove " + std::to_string(pixel.x) + " " + std::to_string(pixel.y));
      pass(0.1);
      type("mousedown 1");
      waitFor([this] { return !inputsOf(msg::Input::SPRING).empty(); }, 0.5);
      type("mouseup 1");
    }
    EXPECT_FALSE(inputsOf(msg::Input::SPRING).empty()) << "rviz does not answer to the mouse";
    pass(0.3);
    return inputsOf(msg::Input::SPRING).empty() ? msg::SpringForce() : inputsOf(msg::Input::SPRING).front().spring;
  }

  void measureView()
  {
    const Pixel first{ 700, 300 }, second{ 900, 500 };
    click(first, 60.0);
    pass(1.0);
    const geometry_msgs::Point a = click(first, 5.0).anchor, b = click(second, 5.0).anchor;
    scale_ = (second.x - first.x) / (b.x - a.x);
    EXPECT_NEAR((second.y - first.y) / (a.y - b.y), scale_, 1e-3 * scale_);
    left_ = first.x - a.x * scale_;
    top_ = first.y + a.y * scale_;
  }

  static Pixel pixelOf(double x, double y)
  {
    return { static_cast<int>(std::lround(left_ + x * scale_)), static_cast<int>(std::lround(top_ - y * scale_)) };
  }

  /// Point of the world as xdotool takes it.
  static std::string at(double x, double y)
  {
    const Pixel pixel = pixelOf(x, y);
    return std::to_string(pixel.x) + " " + std::to_string(pixel.y);
  }

  static Display* display_;
  static Controls* controls_;
  static Process* rviz_;
  static std::string configuration_;
  static double scale_, left_, top_;

  NodeClient client{ "block_world" };
  Listener<msg::Input> inputs{ client.topic(topics::INPUTS), 10000 };
  Listener<msg::BodyStates> bodies{ client.topic(topics::BODIES), 1000 };
};

Display* Drive::display_ = nullptr;
Controls* Drive::controls_ = nullptr;
Process* Drive::rviz_ = nullptr;
std::string Drive::configuration_;
double Drive::scale_ = 1.0, Drive::left_ = 0.0, Drive::top_ = 0.0;

TEST_F(Drive, aSpringPullsTheBlockUnderTheMouse)
{
  type("mousemove " + at(3.2, 0.3));
  pass(0.1);
  type("mousedown 1");
  pass(0.1);
  type("mousemove " + at(4.5, 1.0));
  ASSERT_TRUE(waitFor([this] { return body(1).vx > 0.1 && body(1).vy > 0.05; }));
  EXPECT_EQ(body(0).vx, 0.0) << "the other block stays";
  type("mouseup 1");
  const auto released = [this] {
    const auto springs = inputsOf(msg::Input::SPRING);
    return !springs.empty() && !springs.back().spring.active;
  };
  ASSERT_TRUE(waitFor(released));
  for (const msg::Input& input : inputsOf(msg::Input::SPRING))
    EXPECT_EQ(input.spring.body, "block2");
  const msg::SpringForce first = inputsOf(msg::Input::SPRING).front().spring;
  EXPECT_NEAR(first.attach.x, 0.2, PIXEL);
  EXPECT_NEAR(first.attach.y, 0.3, PIXEL);

  pass(0.1);
  const double vx = body(1).vx;
  pass(0.3);
  EXPECT_EQ(body(1).vx, vx) << "nothing pulls any more";
}

TEST_F(Drive, outsideOfAllTheNearestBlockIsTaken)
{
  // 1.5 m from block1, whose right side is at x = -3.5, and 4.5 m from block2.
  const msg::SpringForce spring = click(pixelOf(-2, 0.5), 5.0);
  EXPECT_EQ(spring.body, "block1");
  EXPECT_NEAR(spring.attach.x, 0.5, 0.05) << "the nearest point of it, which by then has begun to move";
  EXPECT_NEAR(spring.attach.y, 0.5, PIXEL);
}

TEST_F(Drive, aKeyThrustsUntilItIsLetGo)
{
  type("keydown e");
  pass(1.3);
  type("keyup e");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  const std::vector<msg::Input> thrusts = thrustsOf("block1");
  ASSERT_EQ(thrusts.size(), 2u) << "on and off, however the keyboard repeats";
  EXPECT_EQ(thrusts[0].thrust.levels, (Levels{ 0, 0, 1, 0, 0, 0 }));

  // Along y through the centre of mass of 1 kg: the speed is force times time.
  pass(0.2);
  const double time = static_cast<double>(thrusts[1].time_ns - thrusts[0].time_ns) * 1e-9;
  EXPECT_NEAR(time, 1.3, 0.2);
  EXPECT_NEAR(body(0).vy, THRUST * time, 1e-9);
  EXPECT_EQ(body(0).omega, 0.0);
}

TEST_F(Drive, twoKeysAreHeldAtOnce)
{
  type("keydown e");
  pass(0.3);
  type("keydown Left");
  pass(1.2);  // the keyboard repeats the one pressed last
  type("keyup e");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  pass(0.5);
  EXPECT_EQ(thrustsOf("block2").size(), 1u) << "letting one key go must not let go the other";
  type("keyup Left");
  ASSERT_TRUE(waitForThrust("block2", NONE));
  EXPECT_EQ(thrustsOf("block1").size(), 2u);
  ASSERT_EQ(thrustsOf("block2").size(), 2u);
  EXPECT_EQ(thrustsOf("block2")[0].thrust.levels, (Levels{ 1, 0, 0, 0, 1, 0 }));

  // Of two keys the later one let go: the earlier one is not repeated.
  inputs.messages.clear();
  type("keydown e keydown s");
  pass(1.0);
  type("keyup s");
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }));
  pass(0.5);
  type("keyup e");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  const std::vector<msg::Input> thrusts = thrustsOf("block1");
  ASSERT_EQ(thrusts.size(), 4u);
  EXPECT_EQ(thrusts[1].thrust.levels, (Levels{ 1, 0, 1, 0, 1, 0 }));
}

TEST_F(Drive, shiftSpinsAndMayBeLetGoFirst)
{
  type("keydown shift keydown s");
  ASSERT_TRUE(waitForThrust("block1", { 1, 0, 0, 0, 0, 1 }));
  type("keyup shift");
  pass(0.2);
  type("keyup s");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  EXPECT_EQ(thrustsOf("block1").size(), 2u);
  EXPECT_GT(body(0).omega, 0.0);
}

TEST_F(Drive, whenTheKeyboardGoesElsewhereAllIsReleased)
{
  const auto pulls = [this] {
    const auto springs = inputsOf(msg::Input::SPRING);
    return !springs.empty() && springs.back().spring.active;
  };
  type("mousemove " + at(3, 0) + " mousedown 1 keydown e");
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }) && waitFor(pulls));
  type("key Tab");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  EXPECT_TRUE(waitFor([&] { return !pulls(); }));
  pass(0.3);
  EXPECT_FALSE(pulls());
  EXPECT_EQ(thrustsOf("block1").back().thrust.levels, NONE);
}

TEST_F(Drive, anotherToolReleasesAndTakesTheKeys)
{
  type("keydown e");
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }));
  type("key m");  // the key of rviz's tool that moves the camera
  ASSERT_TRUE(waitForThrust("block1", NONE));
  type("keyup e");
  pass(0.1);
  inputs.messages.clear();
  type("key e");
  pass(0.3);
  EXPECT_TRUE(inputsOf(msg::Input::THRUST).empty());
  type("key Escape");  // back to the first tool, this one
  pass(0.1);
  type("keydown e");
  EXPECT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }));
}

TEST_F(Drive, spacePausesAndStepsAndRResets)
{
  type("keydown e");
  pass(0.2);
  type("keyup e");
  ASSERT_TRUE(waitForThrust("block1", NONE));
  type("key space");
  pass(0.5);
  const ros::Time paused = bodies.messages.back().header.stamp;
  pass(0.3);
  ASSERT_EQ(bodies.messages.back().header.stamp, paused);
  type("key n");
  ASSERT_TRUE(waitFor([&] { return bodies.messages.back().header.stamp > paused; }));
  pass(0.2);
  EXPECT_EQ((bodies.messages.back().header.stamp - paused).toNSec(), 16666667);
  EXPECT_GT(body(0).vy, 0.0);
  type("key r");
  EXPECT_TRUE(waitFor([this] { return body(0).vy == 0.0; }));
  type("key space");
  EXPECT_TRUE(waitFor([&] { return bodies.messages.back().header.stamp > paused + ros::Duration(0.1); }));
}

TEST_F(Drive, whilePausedTheMouseMovesTheBlock)
{
  type("key space");
  pass(0.5);
  type("mousemove " + at(3.2, 0.1));
  pass(0.1);
  type("mousedown 1");
  pass(0.2);
  type("mousemove " + at(3.2, 2.1));
  ASSERT_TRUE(waitFor([this] { return std::fabs(body(1).y - 2.0) < PIXEL; })) << body(1).y;
  EXPECT_NEAR(body(1).x, 3.0, PIXEL);

  // Onto the other block: refused, so it stays.
  type("mousemove " + at(-3.8, 0.1));
  pass(0.5);
  EXPECT_NEAR(body(1).y, 2.0, PIXEL);
  EXPECT_EQ(body(0).x, -4.0);
  type("mousemove " + at(3.2, 0.1));
  ASSERT_TRUE(waitFor([this] { return std::fabs(body(1).y) < PIXEL; }));
  type("mouseup 1");

  // From straight right of the centre to straight above it is a quarter turn.
  type("keydown ctrl mousemove " + at(3.4, 0));
  pass(0.1);
  type("mousedown 1");
  pass(0.2);
  type("mousemove " + at(3.0, 0.4));
  EXPECT_TRUE(waitFor([this] { return std::fabs(body(1).angle - M_PI / 2) < 2 * PIXEL / 0.4; })) << body(1).angle;
  type("mouseup 1 keyup ctrl");
  pass(0.2);
  const auto springs = inputsOf(msg::Input::SPRING);
  ASSERT_FALSE(springs.empty());
  EXPECT_FALSE(springs.back().spring.active) << "no spring is left behind";
  type("key space");
  pass(0.5);
  EXPECT_EQ(body(1).vx, 0.0);
}

TEST_F(Drive, answersAtOnce)
{
  // The time from the command to xdotool until the input is told, both ways through other processes.
  ros::CallbackQueue queue;
  ros::NodeHandle handle;
  handle.setCallbackQueue(&queue);
  ros::WallTime arrived;
  const boost::function<void(const msg::Input::ConstPtr&)> note = [&](const msg::Input::ConstPtr&) {
    arrived = ros::WallTime::now();
  };
  const ros::Subscriber subscriber = handle.subscribe<msg::Input>(
      client.topic(topics::INPUTS), 100, note, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  ASSERT_TRUE(waitFor([&] { return subscriber.getNumPublishers() > 0; }));
  pass(0.2);
  std::vector<double> presses, releases;
  const auto measure = [&](const std::string& command, std::vector<double>& times) {
    pass(0.05 + 0.0007 * static_cast<double>(times.size()));  // not in step with rviz's frames
    queue.callAvailable();
    arrived = ros::WallTime();
    const ros::WallTime sent = ros::WallTime::now();
    type(command);
    while (arrived.isZero() && ros::WallTime::now() < sent + ros::WallDuration(1.0))
      queue.callAvailable(ros::WallDuration(0.1));
    times.push_back(arrived.isZero() ? 1.0 : (arrived - sent).toSec());
  };
  for (int i = 0; i < 41; ++i)
  {
    measure("keydown e", presses);
    measure("keyup e", releases);
  }
  for (std::vector<double>* times : { &presses, &releases })
  {
    std::sort(times->begin(), times->end());
    const double median = (*times)[times->size() / 2];
    std::printf("%s: median %.1f ms, 90%% %.1f ms, worst %.1f ms\n", times == &presses ? "press" : "release",
                1e3 * median, 1e3 * (*times)[times->size() * 9 / 10], 1e3 * times->back());
    EXPECT_LT(median, 0.020);
  }
}

TEST_F(Drive, closingRvizReleases)
{
  type("keydown e");
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }));
  type("key --clearmodifiers ctrl+q");
  EXPECT_TRUE(waitForThrust("block1", NONE));
  const int status = rviz_->wait();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "rviz ends in order";
  delete rviz_;
  rviz_ = nullptr;
  type("keyup e");
}

TEST_F(Drive, aDeadRvizHoldsNothing)
{
  type("keydown e");
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 1, 0, 0, 0 }));
  pass(0.5);
  rviz_->end(SIGKILL);
  pass(1.0);
  // The last repetition lasts for half a second of simulated time.
  const std::vector<msg::Input> thrusts = inputsOf(msg::Input::THRUST);
  const double time = static_cast<double>(thrusts.back().time_ns - thrusts.front().time_ns) * 1e-9 + 0.5;
  EXPECT_EQ(thrusts.back().thrust.levels, (Levels{ 0, 0, 1, 0, 0, 0 }));
  EXPECT_NEAR(body(0).vy, THRUST * time, 1e-9);
  type("keyup e");
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "drive_rostest");
  return RUN_ALL_TESTS();
}
