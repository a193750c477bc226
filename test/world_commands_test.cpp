// Commands, timed inputs and the energy account of World.

#include <limits>

#include "closed_forms.h"
#include "world_testing.h"

namespace block_world
{
namespace
{
/// A tall block of 1 x 3 and 2 kg adrift, a square beside it and a fixed one above.
Scene makeThree(double gravity = 0.0)
{
  return makeScene(gravity, 1.0,
                   { withMass(makeBox("tall", { 1, 3 }, { 0, 0 }), 2.0), makeBox("square", { 1, 1 }, { 3, 0 }),
                     fixedOne(makeBox("fixed", { 1, 1 }, { 0, 4 })) });
}

SpringCommand makePull(const std::string& body, const Vector2d& attach, const Vector2d& anchor, double stiffness)
{
  SpringCommand pull;
  pull.body = body;
  pull.attach = attach;
  pull.anchor = anchor;
  pull.stiffness = stiffness;
  return pull;
}

SpringCommand makeRelease(const std::string& body)
{
  SpringCommand release;
  release.active = false;
  release.body = body;
  return release;
}

// Thruster 2 pushes with the full strength along the block's own y: 1.5 N on 2 kg for 1 s, and coasting from there.
TEST(Commands, ThrustEndsWithItsDuration)
{
  World world(makeThree());
  ASSERT_TRUE(world.apply(ThrustCommand{ "tall", { 0, 0, 1, 0, 0, 0 }, 1.0 }).ok);
  EXPECT_EQ(world.thrustLevels(0), std::vector<double>({ 0, 0, 1, 0, 0, 0 }));
  EXPECT_NEAR(stateAt(world, 1.0).velocity.y(), 0.75, 1e-15);
  EXPECT_NEAR(stateAt(world, 2.0).velocity.y(), 0.75, 1e-15);
  EXPECT_NEAR(world.state(0).position.y(), 0.375 + 0.75, 1e-15);
  EXPECT_EQ(world.thrustLevels(0), std::vector<double>(6, 0.0));
  EXPECT_NEAR(world.energy().thrust_work, 0.5 * 2.0 * 0.75 * 0.75, 1e-15);
  expectExact(world, 1e-15);
}

// 0 and 5 are a pair of 0.4 x 1.5 N at arms of 0.9 m; a second command replaces the first, duration 0 ends it.
TEST(Commands, ThrustIsReplacedAndSwitchedOff)
{
  World world(makeThree());
  const double alpha = 2.0 * 0.4 * 1.5 * 0.9 / (2.0 * 10.0 / 12.0);
  world.apply(ThrustCommand{ "tall", { 0, 0, 1, 0, 0, 0 }, 5.0 });
  world.apply(ThrustCommand{ "tall", { 1, 0, 0, 0, 0, 1 }, 5.0 });
  EXPECT_NEAR(stateAt(world, 1.0).omega, alpha, 1e-15);
  EXPECT_NEAR(world.state(0).velocity.norm(), 0.0, 1e-14);
  world.apply(ThrustCommand{ "tall", std::vector<double>(6, 1.0), 0.0 });
  EXPECT_NEAR(stateAt(world, 2.0).omega, alpha, 1e-15);
}

TEST(Commands, WrenchIsHeldInBodyAxes)
{
  Scene scene = makeThree();
  scene.blocks[1].angle = pi / 2.0;
  World world(scene);
  WrenchCommand wrench;
  wrench.body = "square";
  wrench.force = Vector2d(2.0, 0.0);
  ASSERT_TRUE(world.apply(wrench).ok);
  EXPECT_NEAR(stateAt(world, 3.0, 1).velocity.y(), 6.0, 1e-14);
  wrench.force.setZero();
  wrench.torque = 0.5;
  world.apply(wrench);
  EXPECT_NEAR(stateAt(world, 4.0, 1).omega, 3.0, 1e-14);  // inertia 1/6
  EXPECT_NEAR(world.energy().thrust_work, 18.0 + 0.5 / 6.0 * 9.0, 1e-13);
}

TEST(Commands, SpringPicksTheNearestPoint)
{
  World world(makeThree());
  const Applied applied = world.apply(makePull("", Vector2d::Zero(), Vector2d(1.7, 0.2), 3.0));
  ASSERT_TRUE(applied.ok);
  const SpringCommand& pull = std::get<SpringCommand>(applied.command);
  EXPECT_EQ(pull.body, "square");
  EXPECT_NEAR((pull.attach - Vector2d(-0.5, 0.2)).norm(), 0.0, 1e-15);
  ASSERT_EQ(world.springs().size(), 1u);
  EXPECT_NEAR((world.springs()[0].from - Vector2d(2.5, 0.2)).norm(), 0.0, 1e-15);
  EXPECT_TRUE(world.springs()[0].mouse);
  // The fixed block is nearest to this anchor but cannot be pulled.
  EXPECT_EQ(std::get<SpringCommand>(world.apply(makePull("", Vector2d::Zero(), Vector2d(0, 3.4), 3.0)).command).body,
            "tall");
  EXPECT_EQ(world.springs().size(), 2u);
  EXPECT_TRUE(world.apply(makeRelease("tall")).ok);
  EXPECT_EQ(world.springs().size(), 1u);
  EXPECT_TRUE(world.apply(makeRelease("")).ok);
  EXPECT_TRUE(world.springs().empty());
}

// 3 N/m on 1 kg from 1 m: after a quarter period at the anchor with sqrt(3) m/s; so it stays when released there.
TEST(Commands, SpringReleasedAndExpired)
{
  const double quarter = pi / (2.0 * std::sqrt(3.0));
  for (const bool expires : { false, true })
  {
    World world(makeThree());
    SpringCommand pull = makePull("square", Vector2d::Zero(), Vector2d(4.0, 0.0), 3.0);
    pull.duration = expires ? quarter : 0.0;
    ASSERT_TRUE(world.apply(pull).ok);
    EXPECT_DOUBLE_EQ(world.energy().spring_work, 1.5);
    run(world, quarter);
    if (!expires)
      world.apply(makeRelease("square"));
    EXPECT_NEAR(stateAt(world, 3.0, 1).velocity.x(), std::sqrt(3.0), 1e-13);
    EXPECT_TRUE(world.springs().empty());
    EXPECT_NEAR(world.energy().spring_work, 1.5, 1e-14);
    EXPECT_NEAR(world.energy().translational, 1.5, 1e-13);
    expectExact(world, 1e-13);
  }
}

TEST(Commands, SetGravityMassAndDamping)
{
  World world(makeThree());
  SetCommand set;
  set.gravity = 2.0;
  ASSERT_TRUE(world.apply(set).ok);
  EXPECT_NEAR(stateAt(world, 1.0).velocity.y(), -2.0, 1e-15);
  set = SetCommand();
  set.mass = 5.0;
  const double before = world.energy().total;
  ASSERT_TRUE(world.apply(set).ok);
  EXPECT_NEAR(world.energy().command_work, world.energy().total - before, 1e-14);  // gravity jumped at height 0
  world.apply(ThrustCommand{ "tall", { 0, 0, 1, 0, 0, 0 }, 1.0 });
  EXPECT_NEAR(stateAt(world, 2.0).velocity.y(), -4.0 + 1.5 / 5.0, 1e-14);
  set = SetCommand();
  set.gravity = 0.0;
  set.damping = 1.0;
  world.apply(set);
  const double speed = world.state(0).velocity.y(), square = world.state(1).velocity.y();
  EXPECT_NEAR(stateAt(world, 3.0).velocity.y(), speed * std::exp(-1.0 / 5.0), 1e-14);
  const double loss = 2.5 * speed * speed * -std::expm1(-0.4) + 0.5 * square * square * -std::expm1(-2.0);
  EXPECT_NEAR(world.energy().damping_loss, loss, 1e-13);
  expectExact(world, 1e-12);
}

TEST(Commands, SetThrustAndElasticity)
{
  Scene scene = makeScene(0.0, 1.0,
                          { moving(makeBox("a", { 1, 1 }, { 0, 0.5 + 1.0 }), { 0, -1 }),
                            moving(makeBox("b", { 1, 1 }, { 3, 0.5 + 1.0 }), { 0, -1 }) },
                          onFloor());
  scene.blocks[1].elasticity = 0.75;  // its own stays; a pair uses the smaller one
  World world(scene);
  SetCommand set;
  set.elasticity = 0.8;
  set.thrust = 4.0;
  ASSERT_TRUE(world.apply(set).ok);
  run(world, 2.0);
  expectSpeeds(world, 1, { 0.8, 0.75 }, 1e-15);
  EXPECT_NEAR(world.energy().impact_loss, 0.5 * (1 - 0.64) + 0.5 * (1 - 0.5625), 1e-15);
  EXPECT_EQ(world.thrusters(0)[2].strength, 4.0);
  EXPECT_EQ(world.scene().elasticity, 0.8);
  expectExact(world, 1e-15);
}

TEST(Commands, SpawnAndDelete)
{
  World world(makeThree(9.8));
  run(world, 0.5);
  const MotionState square = world.state(1);
  ASSERT_TRUE(world.apply(SpawnCommand{ moving(makeBox("new", { 1, 1 }, { 6, 0 }), { 1, 0 }) }).ok);
  ASSERT_EQ(world.bodyCount(), 4);
  EXPECT_EQ(world.find("new"), 3);
  expectSameBits(world.state(1), square);
  EXPECT_EQ(world.scene().blocks.size(), 4u);
  EXPECT_NEAR(world.energy().command_work, 0.5, 1e-14);
  EXPECT_NEAR(stateAt(world, 1.0, 3).position.x(), 6.5, 1e-15);
  EXPECT_NEAR(world.state(3).velocity.y(), -4.9, 1e-14);
  world.apply(makePull("tall", Vector2d::Zero(), Vector2d(0, 0), 3.0));
  ASSERT_TRUE(world.apply(DeleteCommand{ "tall" }).ok);
  EXPECT_TRUE(world.springs().empty());
  EXPECT_EQ(world.find("tall"), -1);
  EXPECT_NEAR(world.state(0).velocity.y(), -9.8, 1e-14);
  run(world, 1.5);
  expectExact(world, 1e-11);
}

// A spawned block that strikes what it touches: 1/2 m v^2 is the command's, 1/2 m v^2 (1 - e^2) the impact's.
TEST(Commands, SpawnIntoAnImpact)
{
  World world(makeScene(0.0, 0.5, {}, onFloor()));
  ASSERT_TRUE(world.apply(SpawnCommand{ moving(makeBox("new", { 1, 1 }, { 0, 0.5 }), { 0, -2 }) }).ok);
  EXPECT_NEAR(world.state(0).velocity.y(), 1.0, 1e-15);
  EXPECT_NEAR(world.energy().command_work, 2.0, 1e-15);
  EXPECT_NEAR(world.energy().impact_loss, 1.5, 1e-15);
  expectExact(world, 1e-15);
}

struct Refusal
{
  std::string what;
  Command command;
  std::string reason;  ///< some of it
};

std::vector<Refusal> makeRefusals()
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<double> six(6, 0.5);
  std::vector<Refusal> all{
    { "thrust on nobody", ThrustCommand{ "nobody", six, 1.0 }, "body" },
    { "thrust on a fixed block", ThrustCommand{ "fixed", six, 1.0 }, "fixed" },
    { "too few levels", ThrustCommand{ "tall", { 1, 1 }, 1.0 }, "levels" },
    { "level above 1", ThrustCommand{ "tall", { 0, 0, 1.5, 0, 0, 0 }, 1.0 }, "levels" },
    { "level nan", ThrustCommand{ "tall", { 0, 0, nan, 0, 0, 0 }, 1.0 }, "levels" },
    { "negative duration", ThrustCommand{ "tall", six, -1.0 }, "duration" },
    { "endless duration", ThrustCommand{ "tall", six, inf }, "duration" },
    { "spring on nobody", makePull("nobody", { 0, 0 }, { 1, 1 }, 1.0), "body" },
    { "spring to nowhere", makePull("tall", { 0, 0 }, { nan, 1 }, 1.0), "anchor" },
    { "spring from nowhere", makePull("tall", { inf, 0 }, { 1, 1 }, 1.0), "attach" },
    { "negative stiffness", makePull("tall", { 0, 0 }, { 1, 1 }, -1.0), "stiffness" },
    { "release of nobody", makeRelease("nobody"), "body" },
    { "wrench on nobody", WrenchCommand{ "nobody", { 1, 0 }, 0.0 }, "body" },
    { "wrench nan", WrenchCommand{ "tall", { nan, 0 }, 0.0 }, "force" },
    { "torque inf", WrenchCommand{ "tall", { 1, 0 }, inf }, "torque" },
    { "state of nobody", SetStateCommand{ "nobody", { 9, 9 }, 0, { 0, 0 }, 0 }, "body" },
    { "state of a fixed block", SetStateCommand{ "fixed", { 9, 9 }, 0, { 0, 0 }, 0 }, "fixed" },
    { "state that overlaps", SetStateCommand{ "tall", { 2.5, 0 }, 0, { 0, 0 }, 0 }, "square" },
    { "pose nan", SetStateCommand{ "tall", { nan, 0 }, 0, { 0, 0 }, 0 }, "pose" },
    { "velocity nan", SetStateCommand{ "tall", { 9, 9 }, 0, { 0, nan }, 0 }, "velocity" },
    { "spawn that overlaps", SpawnCommand{ makeBox("new", { 1, 1 }, { 3.4, 0 }) }, "square" },
    { "spawn of a name taken", SpawnCommand{ makeBox("tall", { 1, 1 }, { 9, 0 }) }, "tall" },
    { "spawn without mass", SpawnCommand{ withMass(makeBox("new", { 1, 1 }, { 9, 0 }), 0.0) }, "mass" },
    { "delete of nobody", DeleteCommand{ "nobody" }, "nobody" },
  };
  const auto set = [&all](const std::string& key, std::optional<double> SetCommand::*member, double value) {
    SetCommand command;
    command.*member = value;
    all.push_back({ key + " " + std::to_string(value), command, key });
  };
  set("gravity", &SetCommand::gravity, -1.0);
  set("elasticity", &SetCommand::elasticity, 1.1);
  set("damping", &SetCommand::damping, nan);
  set("thrust", &SetCommand::thrust, -1.0);
  set("mass", &SetCommand::mass, 0.0);
  return all;
}

TEST(Commands, RefusedOnesChangeNothing)
{
  Scene scene = makeThree(9.8);
  scene.walls = onFloor(-3.0);
  World world(scene), untouched(scene);
  run(world, 0.2);
  run(untouched, 0.2);
  const std::uint64_t hash = world.stateHash();
  for (const Refusal& refusal : makeRefusals())
  {
    const Applied answer = world.check(refusal.command), applied = world.apply(refusal.command);
    EXPECT_FALSE(applied.ok) << refusal.what;
    EXPECT_EQ(answer.ok, applied.ok) << refusal.what;
    EXPECT_EQ(answer.reason, applied.reason) << refusal.what;
    EXPECT_NE(applied.reason.find(refusal.reason), std::string::npos) << refusal.what << ": " << applied.reason;
    EXPECT_EQ(world.stateHash(), hash) << refusal.what;
    EXPECT_EQ(writeScene(world.scene()), writeScene(untouched.scene())) << refusal.what;
  }
  run(world, 5.0);
  run(untouched, 5.0);
  EXPECT_EQ(world.stateHash(), untouched.stateHash());
  EXPECT_EQ(world.energy().balance_error, untouched.energy().balance_error);
}

TEST(Commands, CheckDoesNothing)
{
  World world(makeThree(9.8));
  run(world, 0.2);
  const std::uint64_t hash = world.stateHash();
  const std::vector<Command> commands{ ThrustCommand{ "tall", std::vector<double>(6, 0.5), 1.0 },
                                       makePull("", { 0, 0 }, { 2, 0 }, 1.0),
                                       WrenchCommand{ "tall", { 1, 0 }, 0.0 },
                                       SetStateCommand{ "tall", { 9, 9 }, 0, { 0, 0 }, 0 },
                                       SpawnCommand{ makeBox("new", { 1, 1 }, { 9, 0 }) },
                                       DeleteCommand{ "tall" },
                                       ResetCommand() };
  for (const Command& command : commands)
  {
    EXPECT_TRUE(world.check(command).ok) << command.index();
    EXPECT_EQ(world.stateHash(), hash) << command.index();
  }
  EXPECT_EQ(world.bodyCount(), 3);
  EXPECT_TRUE(world.springs().empty());
  EXPECT_EQ(std::get<SpringCommand>(world.check(commands[1]).command).body, "square");
}

TEST(Commands, ResetBringsBackTheScene)
{
  Scene scene = shipped("thrusters");
  World world(scene), fresh(scene);
  SetCommand set;
  set.gravity = 5.0;
  world.apply(set);
  world.apply(DeleteCommand{ "spin" });
  run(world, 1.5);
  world.takeInputs();
  ASSERT_TRUE(world.apply(ResetCommand()).ok);
  EXPECT_EQ(world.now(), Time::fromSeconds(1.5));
  EXPECT_EQ(world.stateHash(), fresh.stateHash());
  EXPECT_EQ(world.energy().command_work, 0.0);
  EXPECT_EQ(writeScene(world.scene()), writeScene(fresh.scene()));
  run(world, 1.5 + 5.0);
  run(fresh, 5.0);
  for (int i = 0; i < 4; ++i)
    expectState(world.state(i), fresh.state(i), 1e-13);
  EXPECT_EQ(world.takeInputs().size(), scene.inputs.size());
}

TEST(Commands, TimedInputsAreCommandsAtTheirTimes)
{
  Scene scene = shipped("thrusters");
  World timed(scene);
  const std::vector<TimedCommand> inputs = scene.inputs;
  scene.inputs.clear();
  World live(scene);
  for (const TimedCommand& input : inputs)
  {
    live.advance(input.time);
    ASSERT_TRUE(live.apply(input.command).ok);
  }
  run(timed, 5.0);
  run(live, 5.0);
  EXPECT_EQ(timed.stateHash(), live.stateHash());
  const std::vector<TimedCommand> done = timed.takeInputs();
  ASSERT_EQ(done.size(), inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    EXPECT_EQ(done[i].time, inputs[i].time);
  EXPECT_NEAR(timed.energy().spring_work, live.energy().spring_work, 1e-14);
}

// Whether anything takes energy between impacts follows from what acts, not from the order in which it came.
TEST(Commands, DampersOfTheMouseInAnyOrder)
{
  const Scene scene = makeScene(9.8, 1.0, { makeBox("a", { 1, 1 }, { 0, 5 }) }, onFloor());
  SpringCommand pull;
  pull.body = "a";
  pull.anchor = Vector2d(0.0, 6.0);
  pull.stiffness = 1.0;
  SpringCommand damped = pull, none;
  damped.damping = 0.5;
  none.active = false;
  const SpawnCommand spawn{ makeBox("b", { 1, 1 }, { 10, 5 }) };
  const auto hashAfter = [&](const std::vector<Command>& commands) {
    World world(scene);
    for (const Command& command : commands)
      EXPECT_TRUE(world.apply(command).ok);
    return world.stateHash();
  };
  EXPECT_EQ(hashAfter({ damped, spawn }), hashAfter({ spawn, damped }));
  EXPECT_EQ(hashAfter({ spawn, damped, none }), hashAfter({ spawn }));
  EXPECT_EQ(hashAfter({ damped, pull }), hashAfter({ pull }));
  EXPECT_NE(hashAfter({ damped }), hashAfter({ pull }));
  // Nothing pulls and nothing moves: what is left after the damper's end is the time.
  damped.stiffness = 0.0;
  damped.duration = 0.5;
  World world(makeScene(0.0, 1.0, { makeBox("a", { 1, 1 }, { 0, 5 }) }, onFloor())),
      still = World::restore(world.save());
  ASSERT_TRUE(world.apply(damped).ok);
  run(world, 1.0);
  run(still, 1.0);
  EXPECT_EQ(world.stateHash(), still.stateHash());
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
