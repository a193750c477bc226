#include "block_world/scene_yaml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace block_world
{
namespace
{
namespace fs = std::filesystem;
using Eigen::Vector2d;

/// The scene files of a folder of the project, sorted.
std::vector<std::string> sceneFiles(const std::string& folder)
{
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(std::string(BLOCK_WORLD_DIR) + "/" + folder))
    if (entry.path().extension() == ".yaml")
      paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string firstLine(const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// The complaint about a text; empty where it loads.
std::string complaintAbout(const std::string& text, const SceneOverrides& overrides = SceneOverrides())
{
  try
  {
    loadSceneText(text, "f", overrides);
  }
  catch (const SceneFileError& error)
  {
    return error.what();
  }
  return std::string();
}

// Equality of all fields, to the bit.

bool same(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same(const Vector2d& a, const Vector2d& b)
{
  return same(a.x(), b.x()) && same(a.y(), b.y());
}

bool same(const std::string& a, const std::string& b)
{
  return a == b;
}

bool same(const Time& a, const Time& b)
{
  return a.wholeSeconds() == b.wholeSeconds() && same(a.fraction(), b.fraction());
}

bool same(const Thruster& a, const Thruster& b);
bool same(const Block& a, const Block& b);
bool same(const Spring& a, const Spring& b);
bool same(const TimedCommand& a, const TimedCommand& b);
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b);

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const T& x, const T& y) { return same(x, y); });
}

bool same(const Thruster& a, const Thruster& b)
{
  return same(a.point, b.point) && same(a.direction, b.direction) && same(a.strength, b.strength);
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b)
{
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

bool same(const Block& a, const Block& b)
{
  return same(a.name, b.name) && same(a.size, b.size) && same(a.vertices, b.vertices) && same(a.mass, b.mass) &&
         a.fixed == b.fixed && same(a.position, b.position) && same(a.angle, b.angle) && same(a.velocity, b.velocity) &&
         same(a.omega, b.omega) && same(a.elasticity, b.elasticity) && a.color == b.color &&
         same(a.thrusters, b.thrusters);
}

bool same(const Spring& a, const Spring& b)
{
  return same(a.from_block, b.from_block) && same(a.from_point, b.from_point) && same(a.to_block, b.to_block) &&
         same(a.to_point, b.to_point) && same(a.stiffness, b.stiffness) && same(a.rest_length, b.rest_length) &&
         same(a.damping, b.damping);
}

bool same(const TimedCommand& a, const TimedCommand& b)
{
  if (!same(a.time, b.time) || a.command.index() != b.command.index())
    return false;
  if (const auto* x = std::get_if<ThrustCommand>(&a.command))
  {
    const auto& y = std::get<ThrustCommand>(b.command);
    return same(x->body, y.body) && same(x->levels, y.levels) && same(x->duration, y.duration);
  }
  if (const auto* x = std::get_if<SpringCommand>(&a.command))
  {
    const auto& y = std::get<SpringCommand>(b.command);
    return x->active == y.active && same(x->body, y.body) && same(x->attach, y.attach) && same(x->anchor, y.anchor) &&
           same(x->stiffness, y.stiffness) && same(x->damping, y.damping) && same(x->duration, y.duration);
  }
  if (const auto* x = std::get_if<WrenchCommand>(&a.command))
  {
    const auto& y = std::get<WrenchCommand>(b.command);
    return same(x->body, y.body) && same(x->force, y.force) && same(x->torque, y.torque);
  }
  const auto& x = std::get<SetCommand>(a.command);
  const auto& y = std::get<SetCommand>(b.command);
  return same(x.gravity, y.gravity) && same(x.elasticity, y.elasticity) && same(x.damping, y.damping) &&
         same(x.thrust, y.thrust) && same(x.mass, y.mass);
}

bool same(const Scene& a, const Scene& b)
{
  return same(a.name, b.name) && same(a.gravity, b.gravity) && same(a.elasticity, b.elasticity) &&
         same(a.damping, b.damping) && same(a.rotational_damping_ratio, b.rotational_damping_ratio) &&
         same(a.tolerance, b.tolerance) && same(a.thrust, b.thrust) && same(a.walls.left, b.walls.left) &&
         same(a.walls.right, b.walls.right) && same(a.walls.bottom, b.walls.bottom) && same(a.walls.top, b.walls.top) &&
         same(a.blocks, b.blocks) && same(a.springs, b.springs) && same(a.inputs, b.inputs);
}

const char* const full_scene = R"(
name: "full: of \"everything\""
gravity: 0.1
elasticity: 0.7
damping: 0.3
rotational_damping_ratio: 0.2
tolerance: 3.0e-7
walls: {left: -20.1, top: 30.3}
thrusters: {strength: 2.5}
blocks:
  - {name: "yes: 1 # block", size: [0.1, 0.3], mass: 0.7, pose: [0.1, -0.2, 0.3], velocity: [-0.0, 1.0e-300, 3.3], elasticity: 0.9}
  - name: triangle
    vertices: [[0, 0.1], [0.1, 1.7], [1.3, 0.2]]
    pose: [5, 0, 0]
    color: [0.1, 0.2, 0.3]
    thrusters:
      - {point: [0.1, 0.2], direction: [1, 3], strength: 0.6}
      - {point: [0.3, 0.2], direction: [-1, 0], strength: 0.7}
  - {name: wreck, fixed: true, pose: [9, 0, 1], thrusters: []}
springs:
  - {from: {block: triangle, point: [0.1, 0.2]}, to: {point: [1.1, 2.2]}, stiffness: 0.3, rest_length: 0.2, damping: 0.1}
  - {from: {block: triangle, point: [0.1, 0.2]}, to: {block: "yes: 1 # block", point: [0, 0]}}
inputs:
  - {time: 0.1, thrust: {block: triangle, levels: [0.1, 1], duration: 0.3}}
  - {time: 1.1, spring: {block: triangle, point: [0.1, 0.9], anchor: [1.3, 2], stiffness: 3.3, damping: 0.1, duration: 0.7}}
  - {time: 1.1, spring: {block: "", anchor: [1.3, 2]}}
  - {time: 1000000.123456789, release: {block: triangle}}
  - {time: 1000000.2, release: {block: ""}}
  - {time: 1.0e+7, wrench: {block: triangle, force: [0.1, 2.3], torque: 0.1}}
  - {time: 2.0e+7, set: {gravity: 3.1, elasticity: 0.5, damping: 0.1, thrust: 0.2, mass: 1.7}}
  - {time: 2.0e+7, set: {gravity: 0}}
)";

TEST(InvalidScenes, AreRefusedWithFileLineKeyAndReason)
{
  const std::vector<std::string> paths = sceneFiles("test/scenes/invalid");
  EXPECT_GE(paths.size(), 80u);
  for (const std::string& path : paths)
  {
    // The first line of each is a comment that holds the rest of the message: "# line: key: reason".
    try
    {
      loadSceneFile(path);
      ADD_FAILURE() << path << " was accepted";
    }
    catch (const SceneFileError& error)
    {
      EXPECT_EQ("# " + std::string(error.what()).substr(path.size() + 1), firstLine(path)) << path;
      EXPECT_EQ(std::string(error.what()).substr(0, path.size() + 1), path + ":");
    }
  }
}

TEST(LoadSceneFile, NamesAFileThatCannotBeRead)
{
  try
  {
    loadSceneFile("/no/such/scene.yaml");
    FAIL();
  }
  catch (const SceneFileError& error)
  {
    EXPECT_STREQ(error.what(), "/no/such/scene.yaml: cannot be read: No such file or directory");
  }
  try
  {
    loadSceneFile(BLOCK_WORLD_DIR);
    FAIL();
  }
  catch (const SceneFileError& error)
  {
    EXPECT_EQ(std::string(error.what()), std::string(BLOCK_WORLD_DIR) + ": cannot be read: Is a directory");
  }
}

TEST(ShippedScenes, AreWrittenAndReadBackToTheBit)
{
  const std::vector<std::string> paths = sceneFiles("config/scenes");
  EXPECT_GE(paths.size(), 11u);
  for (const std::string& path : paths)
  {
    const Scene scene = loadSceneFile(path);
    EXPECT_FALSE(scene.name.empty()) << path;
    EXPECT_TRUE(same(loadSceneText(writeScene(scene)), scene)) << path;
  }
}

TEST(ShippedScenes, LoadWithAllTheirBlocks)
{
  for (const std::string name : { "six_blocks", "springs" })
    for (int count = 0; count <= 6; ++count)
    {
      SceneOverrides overrides;
      overrides.count = count;
      const Scene scene = loadSceneFile(std::string(BLOCK_WORLD_DIR) + "/config/scenes/" + name + ".yaml", overrides);
      EXPECT_EQ(scene.blocks.size(), static_cast<std::size_t>(count));
    }
}

TEST(WriteScene, KeepsEverything)
{
  const Scene scene = loadSceneText(full_scene);
  ASSERT_EQ(scene.blocks.size(), 3u);
  ASSERT_EQ(scene.springs.size(), 2u);
  ASSERT_EQ(scene.inputs.size(), 8u);
  const std::string text = writeScene(scene);
  const Scene again = loadSceneText(text);
  EXPECT_TRUE(same(again, scene)) << text;
  EXPECT_EQ(writeScene(again), text);
}

TEST(WriteScene, KeepsAnyPolygon)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 300; ++run)
  {
    std::ostringstream text;
    text << "blocks:\n  - name: a\n    pose: [0, 0, 0]\n    vertices:\n";
    const int corners = 3 + run % 6;
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 2.0 * M_PI * (i + 0.5 * share(random)) / corners;
      text << "      - [" << 100.0 * (run % 3) + std::cos(angle) << ", " << 0.3 * std::sin(angle) << "]\n";
    }
    const Scene scene = loadSceneText(text.str());
    ASSERT_TRUE(same(loadSceneText(writeScene(scene)), scene)) << text.str();
  }
}

TEST(LoadSceneText, Defaults)
{
  const Scene scene = loadSceneText("blocks:\n  - pose: [1, 2, 3]\nsprings:\n"
                                    "  - {from: {block: block1, point: [0, 0]}, to: {point: [1, 1]}}\n"
                                    "inputs:\n  - {time: 1, spring: {block: block1, point: [0, 0], anchor: [1, 2]}}\n");
  EXPECT_EQ(scene.gravity, 0.0);
  EXPECT_EQ(scene.elasticity, 1.0);
  EXPECT_EQ(scene.damping, 0.0);
  EXPECT_EQ(scene.rotational_damping_ratio, 0.1);
  EXPECT_EQ(scene.tolerance, 1e-6);
  EXPECT_EQ(scene.thrust, 1.5);
  EXPECT_FALSE(scene.walls.left || scene.walls.right || scene.walls.bottom || scene.walls.top);
  const Block& block = scene.blocks.at(0);
  EXPECT_EQ(block.name, "block1");
  EXPECT_EQ(*block.size, Vector2d(1, 3));
  EXPECT_EQ(block.mass, 1.0);
  EXPECT_FALSE(block.fixed);
  EXPECT_EQ(block.position, Vector2d(1, 2));
  EXPECT_EQ(block.angle, 3.0);
  EXPECT_EQ(block.velocity, Vector2d(0, 0));
  EXPECT_FALSE(block.elasticity);
  EXPECT_FALSE(block.thrusters);
  const Spring& spring = scene.springs.at(0);
  EXPECT_EQ(spring.stiffness, 1.0);
  EXPECT_EQ(spring.rest_length, 0.75);
  EXPECT_EQ(spring.damping, 0.0);
  const auto& mouse = std::get<SpringCommand>(scene.inputs.at(0).command);
  EXPECT_EQ(mouse.stiffness, 3.0);
  EXPECT_EQ(mouse.damping, 0.0);
  EXPECT_EQ(mouse.duration, 0.0);
}

TEST(LoadSceneText, AnEmptyWorld)
{
  EXPECT_TRUE(loadSceneText("gravity: 9.8\n").blocks.empty());
}

TEST(LoadSceneText, Colors)
{
  const auto color = [](const std::string& text) {
    return loadSceneText("blocks:\n  - {pose: [0, 0, 0], color: " + text + "}\n").blocks.at(0).color;
  };
  EXPECT_EQ(color("cyan"), (std::array<double, 3>{ { 0.0, 1.0, 1.0 } }));
  EXPECT_EQ(color("orange"), (std::array<double, 3>{ { 1.0, 165.0 / 255.0, 0.0 } }));
  EXPECT_EQ(color("[0.6, 1, 0.2]"), (std::array<double, 3>{ { 0.6, 1.0, 0.2 } }));
}

TEST(LoadSceneText, TimesAreWholeNanosecondsWhereTheirDigitsAre)
{
  const auto time = [](const std::string& text) {
    return loadSceneText("inputs:\n  - {time: " + text + ", set: {gravity: 1}}\n").inputs.at(0).time;
  };
  EXPECT_EQ(time("0"), Time());
  EXPECT_EQ(time("3"), Time::fromNanoseconds(3000000000));
  EXPECT_EQ(time("1.1"), Time::fromNanoseconds(1100000000));
  EXPECT_EQ(time("1000000.123456789"), Time::fromNanoseconds(1000000123456789));
  EXPECT_EQ(time("2.5e-3"), Time::fromSeconds(0.0025));
}

const char* const chain = R"(count: 2
blocks:
  - {name: a, pose: [0, 0, 0]}
  - {name: b, pose: [2, 0, 0]}
  - {name: c, pose: [4, 0, 0]}
springs:
  - {from: {block: a, point: [0, 0]}, to: {block: b, point: [0, 0]}}
  - {from: {block: b, point: [0, 0]}, to: {block: c, point: [0, 0]}}
  - {from: {block: c, point: [0, 0]}, to: {point: [0, 0]}}
inputs:
  - {time: 1, release: {block: c}}
  - {time: 2, release: {block: b}}
  - {time: 3, set: {gravity: 1}}
  - {time: 4, wrench: {block: c}}
)";

TEST(Count, LeavesOutWhatNeedsTheOtherBlocks)
{
  const Scene scene = loadSceneText(chain);
  EXPECT_EQ(scene.blocks.size(), 2u);
  ASSERT_EQ(scene.springs.size(), 1u);
  EXPECT_EQ(scene.springs[0].to_block, "b");
  ASSERT_EQ(scene.inputs.size(), 2u);
  EXPECT_EQ(scene.inputs[0].time, Time::fromSeconds(2.0));
  EXPECT_EQ(scene.inputs[1].time, Time::fromSeconds(3.0));
}

TEST(Count, CanBeOverridden)
{
  SceneOverrides overrides;
  overrides.count = 3;
  EXPECT_EQ(loadSceneText(chain, "f", overrides).springs.size(), 3u);
  overrides.count = 4;
  EXPECT_EQ(complaintAbout(chain, overrides), "f: count: must be 0 to 3, the number of blocks in the file; is 4");
}

TEST(Count, BlocksBeyondItMayOverlap)
{
  EXPECT_EQ(complaintAbout("count: 1\nblocks:\n  - {pose: [0, 0, 0]}\n  - {pose: [0, 0, 0]}\n"), "");
}

TEST(LoadBlockText, IsAnEntryOfTheBlocks)
{
  const Scene scene = loadSceneText("blocks:\n  - {pose: [0, 0, 0]}\n");
  const Block block = loadBlockText("{size: [1, 2], mass: 3, pose: [5, 6, 0.7], velocity: [1, 2, 3]}", scene);
  EXPECT_EQ(block.name, "block2");
  EXPECT_EQ(block.vertices.size(), 4u);
  EXPECT_EQ(block.mass, 3.0);
  EXPECT_EQ(block.position, Eigen::Vector2d(5.0, 6.0));
  EXPECT_EQ(block.omega, 3.0);
}

TEST(LoadBlockText, RefusesWithLineAndKey)
{
  const auto complaint = [](const std::string& text, double tolerance = 1e-6) -> std::string {
    Scene scene;
    scene.tolerance = tolerance;
    try
    {
      loadBlockText(text, scene, "b");
    }
    catch (const SceneFileError& error)
    {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(complaint("name: a\nmass: -1\npose: [0, 0, 0]\n"), "b:2: mass: must be > 0, is -1");
  EXPECT_EQ(complaint("name: a\nsize: [1, 1]\n"), "b:1: pose: is missing");
  EXPECT_EQ(complaint("pose: [0, 0, 0]\nvertices: [[0, 0], [1, 0], [2, 0]]\n").substr(0, 14), "b:2: vertices:");
  EXPECT_EQ(complaint("pose: [0, 0\n").substr(0, 19), "b:2: not valid YAML");
  // A tolerance of the scene that the block is to join.
  EXPECT_EQ(complaint("{size: [1.0e-5, 1.0e-5], pose: [0, 0, 0]}").substr(0, 14), "b:1: tolerance");
  EXPECT_EQ(complaint("{size: [1.0e-5, 1.0e-5], pose: [0, 0, 0]}", 1e-9), "accepted");
}

TEST(Tolerance, CanBeOverridden)
{
  SceneOverrides overrides;
  overrides.tolerance = 1e-4;
  const std::string overlapping = "blocks:\n  - {pose: [0, 0, 0]}\n  - {pose: [0.99999, 0, 0]}\n";
  EXPECT_EQ(complaintAbout(overlapping), "f:3: blocks[1].pose: block2 overlaps block1 by 1e-05 m, the tolerance is "
                                         "1e-06 m");
  EXPECT_EQ(loadSceneText(overlapping, "f", overrides).tolerance, 1e-4);
  overrides.tolerance = 0.5;
  EXPECT_EQ(complaintAbout(overlapping, overrides), "f: tolerance: must be 1e-12 to 1e-2 of the smallest block, here "
                                                    "1e-12 to 0.01 m, is 0.5");
}

TEST(Tolerance, StaysAsGivenForTheWorldToRaise)
{
  Scene scene = loadSceneText("tolerance: 1.0e-11\nwalls: {right: 1.0e+6}\nblocks:\n  - {pose: [0, 0, 0]}\n");
  EXPECT_EQ(scene.tolerance, 1e-11);
  EXPECT_EQ(completeScene(scene).size(), 1u);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
