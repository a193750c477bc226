#include "block_world/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace block_world
{
namespace
{
using Eigen::Vector2d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Block makeBox(const std::string& name, double x, double y)
{
  Block block;
  block.name = name;
  block.size = Vector2d(1.0, 2.0);
  block.position = Vector2d(x, y);
  return block;
}

Block makeFixed(const std::string& name, double x, double y)
{
  Block block = makeBox(name, x, y);
  block.fixed = true;
  return block;
}

/// Two boxes and a fixed one in a room, a spring, one input of each kind.
Scene makeScene()
{
  Scene scene;
  scene.walls = Walls{ -5.0, 5.0, -4.0, 4.0 };
  scene.blocks = { makeBox("a", -2.0, 0.0), makeBox("b", 0.0, 0.0), makeFixed("c", 3.0, 0.0) };
  Spring spring;
  spring.from_block = "a";
  spring.to_block = "b";
  scene.springs = { spring };

  ThrustCommand thrust{ "a", { 0, 0, 0, 1, 0, 0 }, 0.5 };
  SpringCommand pull;
  pull.body = "b";
  SpringCommand release = pull;
  release.active = false;
  WrenchCommand wrench;
  wrench.body = "a";
  SetCommand set;
  set.gravity = 3.0;
  const std::vector<Command> commands{ thrust, pull, release, wrench, set };
  for (const Command& command : commands)
    scene.inputs.push_back({ Time::fromSeconds(static_cast<double>(scene.inputs.size())), command });
  return scene;
}

/// What completeScene says to the scene after a change; empty where it accepts.
std::string answer(const std::function<void(Scene&)>& change)
{
  Scene scene = makeScene();
  change(scene);
  try
  {
    completeScene(scene);
  }
  catch (const SceneError& error)
  {
    return error.what();
  }
  return std::string();
}

TEST(Scene, IsAcceptedAsItIs)
{
  EXPECT_EQ(answer([](Scene&) {}), "");
}

TEST(Scene, ChecksItsNumbers)
{
  EXPECT_EQ(answer([](Scene& s) { s.gravity = -1.0; }), "gravity: must be >= 0, is -1");
  EXPECT_EQ(answer([](Scene& s) { s.gravity = infinity; }), "gravity: must be finite, is inf");
  EXPECT_EQ(answer([](Scene& s) { s.elasticity = 1.5; }), "elasticity: must be 0 to 1, is 1.5");
  EXPECT_EQ(answer([](Scene& s) { s.damping = -0.5; }), "damping: must be >= 0, is -0.5");
  EXPECT_EQ(answer([](Scene& s) { s.damping = not_a_number; }), "damping: must be finite, is nan");
  EXPECT_EQ(answer([](Scene& s) { s.rotational_damping_ratio = -1.0; }), "rotational_damping_ratio: must be >= 0, is "
                                                                         "-1");
  EXPECT_EQ(answer([](Scene& s) { s.thrust = -1.0; }), "thrusters.strength: must be >= 0, is -1");
}

TEST(Scene, ChecksItsWalls)
{
  EXPECT_EQ(answer([](Scene& s) { s.walls.left = -infinity; }), "walls.left: must be finite, is -inf");
  EXPECT_EQ(answer([](Scene& s) { s.walls.right = -5.0; }), "walls.right: must be greater than walls.left, -5, is -5");
  EXPECT_EQ(answer([](Scene& s) { s.walls.top = -4.5; }), "walls.top: must be greater than walls.bottom, -4, is -4.5");
  EXPECT_EQ(answer([](Scene& s) { s.walls = Walls(); }), "");
}

TEST(Scene, ChecksNames)
{
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].name = "a"; }), "blocks[1].name: 'a' is the name of blocks[0] already");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].name = ""; }), "blocks[1].name: must not be empty");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[2].name = "wall_top"; }), "blocks[2].name: 'wall_top' is the name of a "
                                                                     "wall");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].name = "x,y"; }), "blocks[0].name: must not hold commas, double quotes "
                                                                "or control characters");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].name = "/a"; }), "blocks[0].name: must not begin with '/', which TF does "
                                                               "not allow");
}

TEST(Scene, ChecksBlocks)
{
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].mass = 0.0; }), "blocks[0].mass: must be > 0, is 0");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[2].mass = 0.0; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].position.y() = not_a_number; }), "blocks[0].pose: must be finite, is "
                                                                               "[-2, nan]");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].angle = infinity; }), "blocks[0].pose: must be finite, is inf");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].omega = -infinity; }), "blocks[0].velocity: must be finite, is -inf");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[2].velocity.x() = 1.0; }), "blocks[2].velocity: a fixed block cannot move");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].elasticity = -0.1; }), "blocks[1].elasticity: must be 0 to 1, is -0.1");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].color[2] = 255.0; }), "blocks[1].color: must be 0 to 1, is 255");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].size = Vector2d(0.0, 1.0); }), "blocks[1].size: width and height must be "
                                                                             "> 0, are [0, 1]");
}

/// The answer to block b with these vertices.
std::string answerToPolygon(const std::vector<Vector2d>& vertices)
{
  return answer([&](Scene& s) {
    s.blocks[1].size.reset();
    s.blocks[1].vertices = vertices;
  });
}

TEST(Scene, ChecksPolygons)
{
  const std::string inside = ": the polygon must be convex, without straight corners";
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1) }), "");
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 0) }), "blocks[1].vertices: a polygon needs 3 vertices or "
                                                                 "more");
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, infinity) }), "blocks[1].vertices[2]: must "
                                                                                        "be finite, is [0, inf]");
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 1), Vector2d(2, 2) }), "blocks[1].vertices: encloses no area "
                                                                                 "that can be computed with");
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 0), Vector2d(0, 1) }), "blocks[1].vertices[2]"
                                                                                                 ": lies on the vertex "
                                                                                                 "before it");
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(1, 0), Vector2d(0.1, 0.1), Vector2d(0, 1) }),
            "blocks[1].vertices[3]: is not strictly inside of the side from vertex 1 to 2" + inside);
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 0), Vector2d(0.5, 0), Vector2d(1, 0), Vector2d(0, 1) }),
            "blocks[1].vertices[2]: is not strictly inside of the side from vertex 0 to 1" + inside);
  EXPECT_EQ(answerToPolygon({ Vector2d(0, 1), Vector2d(0.1, 0.1), Vector2d(1, 0), Vector2d(0, 0) }),
            "blocks[1].vertices[2]: is not strictly inside of the side from vertex 0 to 1" + inside);
  // A star turns left at every corner.
  std::vector<Vector2d> star;
  for (int i = 0; i < 5; ++i)
    star.emplace_back(std::cos(4.0 * M_PI * i / 5.0), std::sin(4.0 * M_PI * i / 5.0));
  EXPECT_EQ(answerToPolygon(star),
            "blocks[1].vertices[3]: is not strictly inside of the side from vertex 0 to 1" + inside);
}

TEST(Scene, TurnsAndRecentresPolygons)
{
  Scene scene;
  Block block = makeBox("a", 7.0, 8.0);
  block.size.reset();
  block.vertices = { Vector2d(10, 10), Vector2d(10, 13), Vector2d(13, 10) };
  scene.blocks = { block };
  completeScene(scene);
  const std::vector<Vector2d>& vertices = scene.blocks[0].vertices;
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_EQ(vertices[0], Vector2d(-1, -1));
  EXPECT_EQ(vertices[1], Vector2d(2, -1));
  EXPECT_EQ(vertices[2], Vector2d(-1, 2));
  EXPECT_EQ(scene.blocks[0].position, Vector2d(7, 8));
}

TEST(Scene, SizeBecomesVertices)
{
  Scene scene = makeScene();
  completeScene(scene);
  const std::vector<Vector2d> expected{ Vector2d(-0.5, -1), Vector2d(0.5, -1), Vector2d(0.5, 1), Vector2d(-0.5, 1) };
  EXPECT_EQ(scene.blocks[0].vertices, expected);
}

TEST(Scene, CompletingTwiceChangesNoBit)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int completed = 0;
  for (int run = 0; run < 2000; ++run)
  {
    // Corners on an ellipse, thin or round, somewhere near or far.
    std::vector<Vector2d> vertices;
    const int corners = 3 + run % 7;
    const double width = std::pow(10.0, 2.0 - 4.0 * share(random)), flatness = std::pow(10.0, -3.0 * share(random));
    const Vector2d place = std::pow(10.0, 6.0 * share(random) - 2.0) * Vector2d(share(random), -share(random));
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 2.0 * M_PI * (i + 0.8 * share(random)) / corners;
      vertices.push_back(place + width * Vector2d(std::cos(angle), flatness * std::sin(angle)));
    }
    Scene scene;
    scene.tolerance = 1e-5 * width * flatness;
    Block block = makeBox("a", 1.0, 2.0);
    block.size.reset();
    block.vertices = vertices;
    block.thrusters = { { { Vector2d(0, 0), Vector2d(share(random), 1.0), 1.0 } } };
    scene.blocks = { block };
    try
    {
      completeScene(scene);
    }
    catch (const SceneError&)
    {
      continue;  // a sliver by chance
    }
    const Scene once = scene;
    completeScene(scene);
    ASSERT_EQ(scene.blocks[0].vertices, once.blocks[0].vertices) << run;
    ASSERT_EQ(scene.blocks[0].thrusters->front().direction, once.blocks[0].thrusters->front().direction) << run;
    ASSERT_EQ(scene.tolerance, once.tolerance) << run;
    ++completed;
  }
  EXPECT_GT(completed, 1500);
}

TEST(Scene, ChecksThrusters)
{
  const auto with = [](const Thruster& thruster) {
    return answer([&](Scene& s) { s.blocks[1].thrusters = { thruster }; });
  };
  EXPECT_EQ(with({ Vector2d(0, 1), Vector2d(2, 0), 1.0 }), "");
  EXPECT_EQ(with({ Vector2d(0, infinity), Vector2d(1, 0), 1.0 }), "blocks[1].thrusters[0].point: must be finite, is "
                                                                  "[0, inf]");
  EXPECT_EQ(with({ Vector2d(0, 1), Vector2d(0, 0), 1.0 }), "blocks[1].thrusters[0].direction: must have a length, is "
                                                           "[0, 0]");
  EXPECT_EQ(with({ Vector2d(0, 1), Vector2d(1, 0), -1.0 }), "blocks[1].thrusters[0].strength: must be >= 0, is -1");
}

TEST(Scene, DirectionsBecomeUnitVectors)
{
  Scene scene = makeScene();
  scene.blocks[1].thrusters = { { Vector2d(0, 0), Vector2d(3, -4), 2.0 } };
  completeScene(scene);
  EXPECT_EQ(scene.blocks[1].thrusters->front().direction, Vector2d(0.6, -0.8));
}

TEST(Scene, ChecksSprings)
{
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].from_block = "x"; }), "springs[0].from.block: there is no block 'x'");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].to_block = "x"; }), "springs[0].to.block: there is no block 'x'");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].to_block = "a"; }), "springs[0].to.block: both ends are at block 'a'");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].to_block = ""; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].stiffness = -1.0; }), "springs[0].stiffness: must be >= 0, is -1");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].rest_length = -1.0; }), "springs[0].rest_length: must be >= 0, is -1");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].damping = infinity; }), "springs[0].damping: must be finite, is inf");
  EXPECT_EQ(answer([](Scene& s) { s.springs[0].from_point.x() = not_a_number; }), "springs[0].from.point: must be "
                                                                                  "finite, is [nan, 0]");
}

template <class Kind>
Kind& input(Scene& scene, int index)
{
  return std::get<Kind>(scene.inputs[index].command);
}

TEST(Scene, ChecksInputTimes)
{
  EXPECT_EQ(answer([](Scene& s) { s.inputs[2].time = Time::fromSeconds(0.5); }), "inputs[2].time: must not be earlier "
                                                                                 "than the input before it, at 1 s");
  EXPECT_EQ(answer([](Scene& s) { s.inputs[2].time = s.inputs[1].time; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.inputs[0].time = Time::fromSeconds(-0.5); }), "inputs[0].time: must be >= 0, is "
                                                                                  "-0.5");
  EXPECT_EQ(answer([](Scene& s) { s.inputs[4].time = Time::infinity(); }), "inputs[4].time: must be finite");
}

TEST(Scene, ChecksInputs)
{
  EXPECT_EQ(answer([](Scene& s) { input<ThrustCommand>(s, 0).body = "x"; }), "inputs[0].thrust.block: there is no "
                                                                             "block 'x'");
  EXPECT_EQ(answer([](Scene& s) { input<ThrustCommand>(s, 0).body = "c"; }), "inputs[0].thrust.block: block 'c' is "
                                                                             "fixed");
  EXPECT_EQ(answer([](Scene& s) { input<ThrustCommand>(s, 0).levels.pop_back(); }), "inputs[0].thrust.levels: block "
                                                                                    "'a' has 6 thrusters, given are 5 "
                                                                                    "levels");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].thrusters.emplace(); }), "inputs[0].thrust.levels: block 'a' has 0 "
                                                                       "thrusters, given are 6 levels");
  EXPECT_EQ(answer([](Scene& s) { input<ThrustCommand>(s, 0).levels[3] = 2.0; }), "inputs[0].thrust.levels[3]: must be "
                                                                                  "0 to 1, is 2");
  EXPECT_EQ(answer([](Scene& s) { input<ThrustCommand>(s, 0).duration = -1.0; }), "inputs[0].thrust.duration: must be "
                                                                                  ">= 0, is -1");
  EXPECT_EQ(answer([](Scene& s) { input<SpringCommand>(s, 1).body = "x"; }), "inputs[1].spring.block: there is no "
                                                                             "block 'x'");
  EXPECT_EQ(answer([](Scene& s) { input<SpringCommand>(s, 1).body = ""; }), "");
  EXPECT_EQ(answer([](Scene& s) { input<SpringCommand>(s, 1).stiffness = -3.0; }), "inputs[1].spring.stiffness: must "
                                                                                   "be >= 0, is -3");
  EXPECT_EQ(answer([](Scene& s) { input<SpringCommand>(s, 1).anchor.x() = infinity; }), "inputs[1].spring.anchor: must "
                                                                                        "be finite, is [inf, 0]");
  EXPECT_EQ(answer([](Scene& s) { input<SpringCommand>(s, 2).body = "x"; }), "inputs[2].release.block: there is no "
                                                                             "block 'x'");
  EXPECT_EQ(answer([](Scene& s) { input<WrenchCommand>(s, 3).body = "c"; }), "inputs[3].wrench.block: block 'c' is "
                                                                             "fixed");
  EXPECT_EQ(answer([](Scene& s) { input<WrenchCommand>(s, 3).torque = infinity; }), "inputs[3].wrench.torque: must be "
                                                                                    "finite, is inf");
  EXPECT_EQ(answer([](Scene& s) { input<SetCommand>(s, 4) = SetCommand(); }), "inputs[4].set: sets nothing");
  EXPECT_EQ(answer([](Scene& s) { input<SetCommand>(s, 4).elasticity = 2.0; }), "inputs[4].set.elasticity: must be 0 "
                                                                                "to 1, is 2");
  EXPECT_EQ(answer([](Scene& s) { input<SetCommand>(s, 4).mass = 0.0; }), "inputs[4].set.mass: must be > 0, is 0");
  EXPECT_EQ(answer([](Scene& s) { s.inputs[4].command = ResetCommand(); }), "inputs[4]: can only be one of thrust, "
                                                                            "spring, release, wrench, set");
}

TEST(Scene, MassOfAFixedFirstBlockCannotBeSet)
{
  EXPECT_EQ(answer([](Scene& s) {
              std::swap(s.blocks[0], s.blocks[2]);
              input<SetCommand>(s, 4).mass = 2.0;
            }),
            "inputs[4].set.mass: is the mass of the first block, and there is none that can move");
}

TEST(Scene, RefusesOverlaps)
{
  const std::string tolerance = " m, the tolerance is 1e-06 m";
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].position.x() = -1.25; }),
            "blocks[1].pose: b overlaps a by 0.25" + tolerance);
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].position.x() = 2.5; }),
            "blocks[2].pose: c overlaps b by 0.5" + tolerance);
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].position.x() = -5.0; }),
            "blocks[0].pose: a overlaps wall_left by 0.5" + tolerance);
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].position.y() = -9.0; }),
            "blocks[0].pose: a overlaps wall_bottom by 6" + tolerance);
  // Far behind the other blocks in x, hence first in the sweep.
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].position = Vector2d(-2.5, 0.5); }),
            "blocks[1].pose: b overlaps a by 0.5" + tolerance);
}

TEST(Scene, OverlapsBelowTheToleranceAreAccepted)
{
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].position.x() = -1.0; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[1].position.x() = -1.0 - 0.9e-6; }), "");
  EXPECT_NE(answer([](Scene& s) { s.blocks[1].position.x() = -1.0 - 1.1e-6; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[0].position.y() = -3.0 - 0.9e-6; }), "");
  EXPECT_NE(answer([](Scene& s) { s.blocks[0].position.y() = -3.0 - 1.1e-6; }), "");
}

TEST(Scene, FixedBlocksMayOverlapEachOtherAndWalls)
{
  EXPECT_EQ(answer([](Scene& s) { s.blocks.push_back(makeFixed("d", 3.3, 0.5)); }), "");
  EXPECT_EQ(answer([](Scene& s) { s.blocks[2].position = Vector2d(5.0, 4.0); }), "");
}

TEST(Scene, ChecksTheTolerance)
{
  EXPECT_EQ(answer([](Scene& s) { s.tolerance = 0.0; }), "tolerance: must be > 0, is 0");
  EXPECT_EQ(answer([](Scene& s) { s.tolerance = not_a_number; }), "tolerance: must be finite, is nan");
  EXPECT_EQ(answer([](Scene& s) { s.tolerance = 0.011; }), "tolerance: must be 1e-12 to 1e-2 of the smallest block, "
                                                           "here 1e-12 to 0.01 m, is 0.011");
  EXPECT_EQ(answer([](Scene& s) { s.tolerance = 0.01; }), "");
  EXPECT_EQ(answer([](Scene& s) { s.tolerance = 1e-12; }), "");
  EXPECT_NE(answer([](Scene& s) { s.tolerance = 0.9e-12; }), "");
}

TEST(Scene, RaisesTheToleranceToWhatCoordinatesResolve)
{
  Scene scene = makeScene();
  scene.walls.right = 1e6;
  scene.tolerance = 1e-11;
  const std::vector<std::string> notes = completeScene(scene);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "tolerance raised from 1e-11 to 9.31323e-10 m, all that coordinates as large as 1e+06 m can "
                      "resolve");
  EXPECT_EQ(scene.tolerance, std::ldexp(1.0, -30));
  EXPECT_TRUE(completeScene(scene).empty());
  EXPECT_EQ(answer([](Scene& s) { s.walls.right = 1e16; }), "tolerance: coordinates as large as 1e+16 m resolve only "
                                                            "16 m, more than 1e-2 of the smallest block");
}

TEST(Scene, WithoutBlocksIsAWorldToo)
{
  Scene scene;
  EXPECT_TRUE(completeScene(scene).empty());
}

TEST(DefaultThrusters, OfATallBlock)
{
  const std::vector<Vector2d> vertices{ Vector2d(-0.5, -1.5), Vector2d(0.5, -1.5), Vector2d(0.5, 1.5),
                                        Vector2d(-0.5, 1.5) };
  const std::vector<Thruster> thrusters = defaultThrusters(vertices, 1.5);
  ASSERT_EQ(thrusters.size(), 6u);
  const Vector2d upper(0, 0.9), lower(0, -0.9);
  const std::vector<Vector2d> points{ upper, upper, upper, lower, lower, lower };
  const std::vector<Vector2d> directions{ Vector2d(-1, 0), Vector2d(1, 0),  Vector2d(0, 1),
                                          Vector2d(0, -1), Vector2d(-1, 0), Vector2d(1, 0) };
  const std::vector<double> strengths{ 0.6, 0.6, 1.5, 1.5, 0.6, 0.6 };
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_LT((thrusters[i].point - points[i]).norm(), 1e-15) << i;
    EXPECT_EQ(thrusters[i].direction, directions[i]) << i;
    EXPECT_NEAR(thrusters[i].strength, strengths[i], 1e-15) << i;
  }
}

TEST(DefaultThrusters, OfAWideBlockAreTurnedClockwise)
{
  const std::vector<Vector2d> vertices{ Vector2d(-1.5, -0.5), Vector2d(1.5, -0.5), Vector2d(1.5, 0.5),
                                        Vector2d(-1.5, 0.5) };
  const std::vector<Thruster> thrusters = defaultThrusters(vertices, 1.0);
  EXPECT_LT((thrusters[0].point - Vector2d(0.9, 0)).norm(), 1e-15);
  EXPECT_EQ(thrusters[0].direction, Vector2d(0, 1));
  EXPECT_EQ(thrusters[2].direction, Vector2d(1, 0));
  EXPECT_LT((thrusters[3].point - Vector2d(-0.9, 0)).norm(), 1e-15);
  EXPECT_EQ(thrusters[3].direction, Vector2d(-1, 0));
}

TEST(DefaultThrusters, OfASquareAreThoseOfATallBlock)
{
  const std::vector<Vector2d> vertices{ Vector2d(-1, -1), Vector2d(1, -1), Vector2d(1, 1), Vector2d(-1, 1) };
  EXPECT_EQ(defaultThrusters(vertices, 1.0)[2].direction, Vector2d(0, 1));
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
