// The services that change the scene: load, set_state, spawn and delete. The world is paused, so that all that moves is
// moved by the test. Expected values are closed forms.

#include <std_msgs/String.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <set>

#include "block_world/scene_yaml.h"
#include "conversions.h"
#include "node_client.h"

namespace block_world
{
namespace
{
// A few roundings of numbers around 10.
constexpr double ROUNDING = 1e-14;
constexpr double G = 9.8;

// Three unit squares at rest on one another.
const char* const STACK = R"(name: three
gravity: 9.8
elasticity: 0.3
walls: {bottom: 0}
blocks:
  - {name: low, size: [1, 1], pose: [0, 0.5, 0]}
  - {name: middle, size: [1, 1], pose: [0, 1.5, 0]}
  - {name: high, size: [1, 1], pose: [0, 2.5, 0]}
)";

const char* const ALONE = R"(name: alone
blocks:
  - {name: first, size: [1, 1], pose: [0, 0, 0]}
  - {name: rock, size: [1, 1], pose: [0, 5, 0], fixed: true}
)";

class NodeScene : public testing::Test
{
protected:
  NodeScene() : client("block_world")
  {
  }

  msg::SetState::Response setState(const std::string& name, double x, double y, double angle = 0.0, double vx = 0.0,
                                   double vy = 0.0, double omega = 0.0)
  {
    msg::SetState::Request request;
    request.state.name = name;
    request.state.x = x;
    request.state.y = y;
    request.state.angle = angle;
    request.state.vx = vx;
    request.state.vy = vy;
    request.state.omega = omega;
    return client.call<msg::SetState>(topics::SET_STATE, request);
  }

  msg::SpawnBlock::Response spawn(const std::string& block)
  {
    msg::SpawnBlock::Request request;
    request.block = block;
    return client.call<msg::SpawnBlock>(topics::SPAWN_BLOCK, request);
  }

  msg::DeleteBlock::Response remove(const std::string& name)
  {
    msg::DeleteBlock::Request request;
    request.name = name;
    return client.call<msg::DeleteBlock>(topics::DELETE_BLOCK, request);
  }

  msg::LoadScene::Response load(const std::string& path, const std::string& text)
  {
    msg::LoadScene::Request request;
    request.path = path;
    request.text = text;
    return client.call<msg::LoadScene>(topics::LOAD_SCENE, request);
  }

  std::vector<std::string> names()
  {
    std::vector<std::string> names;
    for (const msg::BodyState& body : client.state().bodies)
      names.push_back(body.name);
    return names;
  }

  NodeClient client;
};

void expectWords(const std::string& text, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

/// Frames in which a message draws blocks.
std::set<std::string> drawnBlocks(const visualization_msgs::MarkerArray& array)
{
  std::set<std::string> frames;
  for (const auto& marker : array.markers)
    if (marker.ns == "blocks" && marker.action == visualization_msgs::Marker::ADD)
      frames.insert(marker.header.frame_id);
  return frames;
}

}  // namespace

TEST_F(NodeScene, loadReplacesTheWorldWhileTimeGoesOn)
{
  client.advance(0.123456789);
  Listener<msg::BodyStates> bodies(client.topic(topics::BODIES), 1000);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  Listener<msg::Energy> energies(client.topic(topics::ENERGY), 100);
  Listener<std_msgs::String> scenes(client.topic(topics::SCENE), 10);
  Listener<visualization_msgs::MarkerArray> markers(client.topic(topics::MARKERS), 10);
  ASSERT_TRUE(bodies.waitForCount(1) && inputs.waitForCount(1) && energies.waitForCount(1) && scenes.waitForCount(1) &&
              markers.waitForCount(1));

  client.load("name: falls\ngravity: 9.8\nblocks: [{name: stone, size: [1, 1], pose: [1, 10, 0], velocity: [2, 0, "
              "0]}]\n"
              "inputs: [{time: 0.5, set: {gravity: 0}}]\n");
  const msg::BodyStates begin = client.state();
  EXPECT_EQ(begin.header.stamp.toNSec(), 123456789u);
  ASSERT_EQ(begin.bodies.size(), 1u);
  EXPECT_EQ(begin.bodies[0].y, 10.0);

  ASSERT_TRUE(inputs.waitForCount(2) && scenes.waitForCount(2) && markers.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::LOAD_SCENE));
  EXPECT_EQ(inputs.messages[1].time_ns, 123456789);
  EXPECT_EQ(inputs.messages[1].index, inputs.messages[0].index + 1);
  EXPECT_EQ(loadSceneText(inputs.messages[1].text).name, "falls");
  EXPECT_EQ(scenes.messages[1].data, inputs.messages[1].text);
  EXPECT_EQ(drawnBlocks(markers.messages[1]), std::set<std::string>({ "stone" }));

  // Falls for 0.5 s, when the scene's own input takes gravity away.
  const msg::BodyState after = client.advance(0.75)[0];
  EXPECT_NEAR(after.x, 1.0 + 2.0 * 0.75, ROUNDING);
  EXPECT_NEAR(after.y, 10.0 - 0.5 * G * 0.25 - 0.5 * G * 0.25, ROUNDING);
  EXPECT_NEAR(after.vy, -0.5 * G, ROUNDING);
  ASSERT_TRUE(inputs.waitForCount(3));
  EXPECT_EQ(inputs.messages[2].time_ns, 623456789);
  EXPECT_TRUE(inputs.messages[2].from_scene);

  // The account begins with the scene: 5 m s^-1 of fall and the potential energy that was switched off.
  ASSERT_TRUE(waitFor([&] { return energies.messages.back().header.stamp.toNSec() == 873456789u; }));
  EXPECT_NEAR(energies.messages.back().command_work, -G * (10.0 - 0.5 * G * 0.25), 1e-12);
  EXPECT_NEAR(energies.messages.back().balance_error, 0.0, 1e-12);
  for (std::size_t i = 1; i < bodies.messages.size(); ++i)
    EXPECT_GE(bodies.messages[i].header.stamp, bodies.messages[i - 1].header.stamp);
}

TEST_F(NodeScene, loadRefusesAndChangesNothing)
{
  client.load(STACK);
  const std::uint64_t before = client.hash();
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  Listener<std_msgs::String> scenes(client.topic(topics::SCENE), 10);
  ASSERT_TRUE(inputs.waitForCount(1) && scenes.waitForCount(1));

  const auto expectRefusal = [&](const std::string& path, const std::string& text,
                                 const std::vector<std::string>& words) {
    const msg::LoadScene::Response response = load(path, text);
    EXPECT_FALSE(response.success);
    expectWords(response.message, words);
  };
  expectRefusal("", "", { "path", "text" });
  expectRefusal("a.yaml", "gravity: 1", { "path", "text" });
  expectRefusal("/nowhere/a.yaml", "", { "/nowhere/a.yaml", "No such file" });
  expectRefusal(BLOCK_WORLD_DIR "/test/scenes/invalid/mass_zero.yaml", "",
                { "mass_zero.yaml:", "mass", "must be > 0" });
  expectRefusal("", "gravity: 1\nblocks:\n  - {pose: [0, 0, 0], mass: -1}\n",
                { "text:3: blocks[0].mass: must be > 0" });
  expectRefusal("", "gravity: [", { "text:", "not valid YAML" });
  expectRefusal("", "blocks: [{name: a, pose: [0, 0, 0]}, {name: b, pose: [0.5, 0, 0]}]", { "a", "b", "overlaps" });

  EXPECT_EQ(client.hash(), before);
  waitFor([] { return false; }, 0.2);
  EXPECT_EQ(inputs.messages.size(), 1u);
  EXPECT_EQ(scenes.messages.size(), 1u);
}

// G1, and what a refusal has to say.
TEST_F(NodeScene, spawnOverlappingIsRefused)
{
  client.load(ALONE);
  const std::uint64_t before = client.hash();
  const auto expectRefusal = [&](const std::string& block, const std::vector<std::string>& words) {
    const msg::SpawnBlock::Response response = spawn(block);
    EXPECT_FALSE(response.success) << block;
    expectWords(response.message, words);
    EXPECT_EQ(client.hash(), before) << block;
  };
  expectRefusal("{name: second, size: [1, 1], pose: [0.9, 0, 0]}", { "second", "first", "overlaps" });
  expectRefusal("{name: second, size: [1, 1], pose: [0.5, 5.5, 0]}", { "second", "rock", "overlaps" });
  expectRefusal("{name: first, size: [1, 1], pose: [9, 0, 0]}", { "name", "first" });
  expectRefusal("name: second\nsize: [1, 1]\npose: [9, 0]\n", { "block:3: pose" });
  expectRefusal("name: second\nmass: 0\npose: [9, 0, 0]\n", { "block:2: mass: must be > 0" });
  expectRefusal("name: second\nspeed: 0\npose: [9, 0, 0]\n", { "block:2: speed: unknown key" });
  expectRefusal("- {name: second, pose: [9, 0, 0]}", { "block:1:", "must be a mapping" });
  expectRefusal("{name: second, pose: [9, .nan, 0]}", { "block:1: pose", "finite" });
  expectRefusal("", { "must be a mapping" });
}

// G1: an overlap below the tolerance is taken out, each block moving half of it, and gives no velocity.
TEST_F(NodeScene, spawnBarelyOverlappingIsSeparated)
{
  client.load(ALONE);
  const msg::SpawnBlock::Response response = spawn("{name: second, size: [1, 1], pose: [0.9999996, 0, 0]}");
  ASSERT_TRUE(response.success) << response.message;
  const std::vector<msg::BodyState> bodies = client.state().bodies;
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_NEAR(bodies[0].x, -2e-7, 1e-15);
  EXPECT_NEAR(bodies[2].x, 1.0 - 2e-7, 1e-15);
  for (const msg::BodyState& body : bodies)
    EXPECT_EQ(std::fabs(body.vx) + std::fabs(body.vy) + std::fabs(body.omega), 0.0) << body.name;
}

// G2.
TEST_F(NodeScene, spawnWithoutRoomIsRefused)
{
  client.load("walls: {left: -0.45, right: 0.45}\n");
  const std::uint64_t before = client.hash();
  const msg::SpawnBlock::Response response = spawn("{name: square, size: [1, 1], pose: [0, 0, 0]}");
  EXPECT_FALSE(response.success);
  expectWords(response.message, { "square", "wall_left", "overlaps" });
  EXPECT_EQ(client.hash(), before);
  EXPECT_TRUE(client.state().bodies.empty());
}

// G3: what stood on the block that is taken out falls freely from that instant, a = -g exactly.
TEST_F(NodeScene, blockMovedOutOfAStack)
{
  client.load(STACK);
  client.advance(0.3);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  const std::int64_t then = static_cast<std::int64_t>(client.state().header.stamp.toNSec());
  const msg::SetState::Response response = setState("middle", 10.0, 3.0, 0.5, 1.0, 2.0, -1.0);
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_TRUE(inputs.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::SET_STATE));
  EXPECT_EQ(inputs.messages[1].time_ns, then);
  EXPECT_EQ(inputs.messages[1].state.name, "middle");
  EXPECT_EQ(inputs.messages[1].state.omega, -1.0);

  const double t = 0.25;  // it lands after sqrt(2 / g) = 0.45 s
  const std::vector<msg::BodyState> bodies = client.advance(t);
  EXPECT_EQ(bodies[0].y, 0.5);
  EXPECT_EQ(bodies[0].vy, 0.0);
  EXPECT_NEAR(bodies[1].x, 10.0 + t, ROUNDING);
  EXPECT_NEAR(bodies[1].y, 3.0 + 2.0 * t - 0.5 * G * t * t, ROUNDING);
  EXPECT_NEAR(bodies[1].angle, 0.5 - t, ROUNDING);
  EXPECT_NEAR(bodies[2].y, 2.5 - 0.5 * G * t * t, ROUNDING);
  EXPECT_NEAR(bodies[2].vy, -G * t, ROUNDING);
  EXPECT_EQ(bodies[2].x, 0.0);
  EXPECT_EQ(bodies[2].omega, 0.0);
}

TEST_F(NodeScene, blockMovedInFlight)
{
  client.load("gravity: 9.8\nblocks: [{name: stone, size: [1, 1], pose: [0, 50, 0], velocity: [3, 0, 1]}]\n");
  client.advance(0.7);
  ASSERT_TRUE(setState("stone", -4.0, 20.0, 2.0, 0.0, 5.0, 0.25).success);
  const double t = 0.5;
  const msg::BodyState stone = client.advance(t)[0];
  EXPECT_EQ(stone.x, -4.0);
  EXPECT_NEAR(stone.y, 20.0 + 5.0 * t - 0.5 * G * t * t, ROUNDING);
  EXPECT_NEAR(stone.angle, 2.0 + 0.25 * t, ROUNDING);
  EXPECT_NEAR(stone.vy, 5.0 - G * t, ROUNDING);
}

// G4: the same where the block is deleted.
TEST_F(NodeScene, blockDeletedOutOfAStack)
{
  client.load(STACK);
  client.advance(0.3);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  Listener<std_msgs::String> scenes(client.topic(topics::SCENE), 10);
  Listener<visualization_msgs::MarkerArray> markers(client.topic(topics::MARKERS), 10);
  ASSERT_TRUE(inputs.waitForCount(1) && scenes.waitForCount(1) && markers.waitForCount(1));
  const msg::DeleteBlock::Response response = remove("middle");
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_TRUE(inputs.waitForCount(2) && scenes.waitForCount(2) && markers.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::DELETE));
  EXPECT_EQ(inputs.messages[1].body, "middle");
  EXPECT_EQ(loadSceneText(scenes.messages[1].data).blocks.size(), 2u);
  EXPECT_EQ(drawnBlocks(markers.messages[1]), std::set<std::string>({ "low", "high" }));

  const double t = 0.25;
  const std::vector<msg::BodyState> bodies = client.advance(t);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].y, 0.5);
  EXPECT_NEAR(bodies[1].y, 2.5 - 0.5 * G * t * t, ROUNDING);
  EXPECT_NEAR(bodies[1].vy, -G * t, ROUNDING);
  EXPECT_EQ(bodies[1].omega, 0.0);

  const std::uint64_t before = client.hash();
  EXPECT_FALSE(remove("middle").success);
  expectWords(remove("middle").message, { "middle" });
  EXPECT_FALSE(remove("").success);
  EXPECT_FALSE(remove("wall_bottom").success);
  EXPECT_EQ(client.hash(), before);
}

TEST_F(NodeScene, setStateRefusesAndChangesNothing)
{
  client.load(STACK);
  client.advance(0.1);
  const std::uint64_t before = client.hash();
  const double nan = std::nan("");
  expectWords(setState("middle", 0.5, 0.7).message, { "middle", "low" });
  expectWords(setState("middle", 9.0, 0.2).message, { "middle", "wall_bottom" });
  expectWords(setState("nobody", 9.0, 3.0).message, { "nobody" });
  for (const auto& refused : { setState("middle", 0.5, 0.7), setState("middle", 9.0, 0.2), setState("nobody", 9.0, 3.0),
                               setState("middle", nan, 3.0), setState("middle", 9.0, 3.0, 0.0, 0.0, nan) })
    EXPECT_FALSE(refused.success);
  EXPECT_EQ(client.hash(), before);
}

TEST_F(NodeScene, resetBringsBackTheSceneAsLoaded)
{
  client.load(STACK);
  const std::uint64_t loaded = client.hash();
  Listener<std_msgs::String> scenes(client.topic(topics::SCENE), 10);
  ASSERT_TRUE(scenes.waitForCount(1));
  ASSERT_TRUE(spawn("{name: new, size: [1, 1], pose: [5, 5, 0]}").success);
  ASSERT_TRUE(remove("high").success);
  client.advance(0.5);
  EXPECT_EQ(names(), std::vector<std::string>({ "low", "middle", "new" }));
  client.reset();
  EXPECT_EQ(names(), std::vector<std::string>({ "low", "middle", "high" }));
  EXPECT_EQ(client.hash(), loaded);
  ASSERT_TRUE(scenes.waitForCount(4));
  EXPECT_EQ(scenes.messages[3].data, scenes.messages[0].data);
}

// Saved in a fall and in a heap; the hash covers positions and velocities of all blocks.
TEST_F(NodeScene, aSavedStateGoesOnBitForBit)
{
  msg::SaveState::Request save;
  save.path = testing::TempDir() + "block_world_node_scene.state";
  msg::RestoreState::Request restore;
  restore.path = save.path;
  client.load(STACK);
  ASSERT_TRUE(setState("high", 0.3, 6.0, 0.2, 0.5, 0.0, 2.0).success);
  for (const double later : { 0.4, 1.3 })
  {
    client.advance(later);
    ASSERT_TRUE(client.call<msg::SaveState>(topics::SAVE_STATE, save).success);
    const std::int64_t saved_ns = client.state().time_ns;
    client.advance(2.1);
    const std::uint64_t hash = client.hash();
    ASSERT_TRUE(remove("low").success);
    const std::int64_t before_ns = client.state().time_ns;
    const msg::RestoreState::Response restored = client.call<msg::RestoreState>(topics::RESTORE_STATE, restore);
    ASSERT_TRUE(restored.success) << restored.message;
    // Time has gone on, by less than a second, to the saved fraction of a second.
    const std::int64_t now_ns = client.state().time_ns;
    EXPECT_GE(now_ns, before_ns);
    EXPECT_LT(now_ns, before_ns + 1000000000);
    EXPECT_EQ((now_ns - saved_ns) % 1000000000, 0);
    client.advance(2.1);
    EXPECT_EQ(client.hash(), hash);
  }
}

TEST_F(NodeScene, aStateThatCannotBeRestoredChangesNothing)
{
  client.advance(0.1);
  const std::uint64_t hash = client.hash();
  msg::RestoreState::Request restore;
  for (const char* path : { "/no/such/file", "/proc/self/exe", "" })
  {
    restore.path = path;
    const msg::RestoreState::Response answer = client.call<msg::RestoreState>(topics::RESTORE_STATE, restore);
    EXPECT_FALSE(answer.success);
    EXPECT_FALSE(answer.message.empty());
  }
  msg::SaveState::Request save;
  save.path = "/no/such/folder/file";
  EXPECT_FALSE(client.call<msg::SaveState>(topics::SAVE_STATE, save).success);
  EXPECT_EQ(client.hash(), hash);
}

// What ~inputs tells of a session is enough to have it again, bit for bit, without the node.
TEST_F(NodeScene, inputsTellAllThatARunDependsOn)
{
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 1000);
  ASSERT_TRUE(inputs.waitForCount(1));
  client.advance(0.017);
  client.load(STACK);
  // A new subscriber gets the last scene that was loaded before.
  ASSERT_TRUE(inputs.waitForCount(2));
  inputs.messages.erase(inputs.messages.begin());
  client.advance(0.1);
  ASSERT_TRUE(setState("middle", 3.0, 4.0, 0.3, -1.0, 0.0, 2.0).success);
  client.advance(0.4321);
  ASSERT_TRUE(spawn("{name: new, vertices: [[0, 0], [1, 0], [0.3, 0.8]], pose: [0.2, 6, 0.1], mass: 3}").success);
  client.advance(1.0);
  ASSERT_TRUE(remove("low").success);
  msg::Step::Request push;
  push.duration = 2.0;
  push.thrust.resize(1);
  push.thrust[0].body = "new";
  push.thrust[0].levels = { 0, 0.5, 1, 0, 0, 0 };
  push.thrust[0].duration = 1.5;
  ASSERT_TRUE(client.step(push).success);
  client.reset();
  client.advance(0.5);
  ASSERT_TRUE(setState("high", 0.3, 6.0).success);
  client.advance(3.0);
  const msg::BodyStates end = client.state();
  // load, set_state, spawn, delete, thrust, reset, set_state
  ASSERT_TRUE(inputs.waitForCount(7));
  ASSERT_EQ(inputs.messages.size(), 7u);

  const msg::Input& first = inputs.messages[0];
  ASSERT_EQ(first.kind, static_cast<int>(msg::Input::LOAD_SCENE));
  World world(loadSceneText(first.text), Time::fromNanoseconds(first.time_ns));
  for (std::size_t i = 1; i < inputs.messages.size(); ++i)
  {
    const msg::Input& input = inputs.messages[i];
    EXPECT_EQ(input.index, first.index + i);
    world.advance(Time::fromNanoseconds(input.time_ns));
    const Applied applied = world.apply(toCommand(input));
    EXPECT_TRUE(applied.ok) << applied.reason;
  }
  world.advance(Time::fromNanoseconds(static_cast<std::int64_t>(end.header.stamp.toNSec())));
  EXPECT_EQ(world.stateHash(), end.state_hash);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_scene_rostest");
  return RUN_ALL_TESTS();
}
