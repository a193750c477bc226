// B. Simultaneous impact.

#include "hard_cases.h"
#include "simultaneous_scenes.h"

namespace block_world
{
namespace
{
// B1, B2
TEST(Simultaneous, Cradle)
{
  World one(shipped("cradle"));
  run(one, 1.0);
  expectSpeeds(one, 0, { 0, 0, 0, 0, 1 }, 1e-15);
  World two(makeRow(1.0, { 1, 1, 1, 1, 1 }, { 1, 1, 0, 0, 0 }));
  run(two, 1.0);
  expectSpeeds(two, 0, { 0, 0, 0, 1, 1 }, 1e-15);
}

// B3. Separate blocks hit one another in pairs, one after the other: the reference computes those hits on a line.
// Without any gap the engine has no order to follow; its stages agree with the limit of small gaps to the four digits
// in which the orders of the hits agree among themselves.
TEST(Simultaneous, CradleThatLoses)
{
  const std::vector<double> ones(5, 1.0), speeds{ 1, 0, 0, 0, 0 };
  for (const double gap : { 1e-2, 1e-4, 1e-6 })
  {
    SCOPED_TRACE(gap);
    Scene scene = makeRow(0.9, ones, speeds, gap);
    scene.tolerance = 1e-9;
    std::vector<double> positions;
    for (int i = 0; i < 5; ++i)
      positions.push_back(gap * i);  // without their own lengths
    World world(scene);
    run(world, 20.0);
    // Some 20 hits of speeds below 1, each rounded.
    expectSpeeds(world, 0, closed_form::rowOfHits(positions, speeds, 0.9), 20.0 * 4.0 * rounding);
    expectExact(world, 1e-14);
  }
  World touching(makeRow(0.9, ones, speeds));
  run(touching, 20.0);
  expectSpeeds(touching, 0, { 0.0435, 0.0454, 0.0473, 0.0493, 0.8145 }, 1e-4);
  EXPECT_NEAR(touching.energy().momentum_x, 1.0, 1e-15);
}

// B4: 1 hits 1000, 1000 hits 1.
TEST(Simultaneous, UnequalMasses)
{
  World world(makeRow(1.0, { 1, 1000, 1 }, { 1, 0, 0 }));
  run(world, 0.1);
  expectSpeeds(world, 0, { -999.0 / 1001.0, 2.0 / 1001.0 * 999.0 / 1001.0, 2.0 / 1001.0 * 2000.0 / 1001.0 }, 1e-15);
}

// B5
TEST(Simultaneous, FlatLanding)
{
  for (const double e : { 1.0, 0.5 })
  {
    World world(makeFlatLanding(e));
    const MotionState after = stateAt(world, 0.5);
    EXPECT_NEAR(after.velocity.y(), e, 2.0 * rounding);
    EXPECT_EQ(after.velocity.x(), 0.0);
    EXPECT_NEAR(after.omega, 0.0, 4.0 * rounding);
    EXPECT_EQ(world.statistics().impacts, 1);
  }
}

// B6. Rigid impact is discontinuous: corners that land within the tolerance of one another land together, others in
// three hits. The limit of small tilts follows from three single hits; at a finite tilt the arms and heights differ in
// proportion to it.
TEST(Simultaneous, TiltLadder)
{
  const double fall = std::sqrt(2.0 * 9.8 * 0.75), inertia = 1.25 / 12.0, rest = 0.5 - fall / 9.8;
  MotionState box, floor;
  box.velocity.y() = -fall;
  for (const double corner : { -0.5, 0.5, -0.5 })  // a positive tilt lowers the left one
    box = closed_form::strike(box, 1.0, inertia, floor, 1e300, 1e300, { corner, -0.25 }, { 0, 1 }, 1.0).a;
  EXPECT_NEAR(box.omega, 3.48366, 1e-5);  // the reference's five digits
  EXPECT_NEAR(box.velocity.y() - 9.8 * rest, 2.59955, 1e-5);

  for (const double tolerance : { 1e-6, 1e-9, 1e-12 })
    for (const double tilt : { 0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 })
      for (const double side : { 1.0, -1.0 })
      {
        SCOPED_TRACE("tolerance " + std::to_string(std::log10(tolerance)) + ", tilt " + std::to_string(tilt * 1e9) +
                     "e-9");
        World world(makeTiltedLanding(side * tilt, tolerance));
        const MotionState after = stateAt(world, 0.5);
        const int impacts = static_cast<int>(world.statistics().impacts);
        EXPECT_TRUE(impacts == 1 || impacts == 3) << impacts;
        // The corners' heights differ by the tilt times the width, 1 m; near the tolerance either may be.
        if (tilt < 0.3 * tolerance)
        {
          EXPECT_EQ(impacts, 1);
        }
        if (tilt > 3.0 * tolerance)
        {
          EXPECT_EQ(impacts, 3);
        }
        // First order in the tilt, of coefficients below 10 (3.4897 and 2.5992 at 1e-3); dividing a rounded height by a
        // lever costs nothing.
        const double error = 10.0 * tilt + 1e-13;
        EXPECT_NEAR(after.velocity.y() + 9.8 * rest, impacts == 1 ? fall : box.velocity.y(), error);
        EXPECT_NEAR(after.omega, impacts == 1 ? 0.0 : side * box.omega, error);
        EXPECT_NEAR(world.energy().total, 9.8, 1e-14 * 9.8);
        if (tilt == 1e-3 && impacts == 3)
        {
          EXPECT_NEAR(after.omega, side * 3.4897, 5e-5);
          EXPECT_NEAR(after.velocity.y(), 2.5992, 5e-5);
        }
      }
}

// B7: three stages: the top on its supports, these on the floor, these on the top.
TEST(Simultaneous, OneBlockOnTwo)
{
  World world(makeOneOnTwo());
  run(world, 0.1);
  expectSpeeds(world, 1, { 7.0 / 9.0, 4.0 / 9.0, 4.0 / 9.0 }, 1e-15);
  expectSpeeds(world, 0, { 0, 0, 0 }, 1e-15);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(world.state(i).omega, 0.0, 1e-15) << world.name(i);
  EXPECT_NEAR(world.state(1).velocity.y(), world.state(2).velocity.y(), 1e-15);
  EXPECT_NEAR(world.energy().total, 0.5, 1e-14);
}

// B8
TEST(Simultaneous, SquareInAVee)
{
  for (const double e : { 1.0, 0.5, 0.0 })
  {
    World world(makeVee(e));
    const MotionState after = stateAt(world, 1.0);
    EXPECT_NEAR(after.velocity.y(), e, 1e-14);  // cos 45 degrees is not a number: some ten roundings
    EXPECT_NEAR(after.velocity.x(), 0.0, 1e-14);
    EXPECT_NEAR(after.omega, 0.0, 1e-14);
  }
}

// B10: no velocity but zero opens these contacts, so the energy cannot stay; what is free keeps its speed.
TEST(Simultaneous, LockedCones)
{
  World slot(makeTightSlot());
  const MotionState after = stateAt(slot, 1.0);
  // Up to 50 stages that each reflect a speed of 1.
  EXPECT_NEAR(after.velocity.x(), 0.0, 50.0 * 2.0 * rounding);
  EXPECT_NEAR(after.velocity.y(), 0.25, 50.0 * 2.0 * rounding);
  EXPECT_NEAR(after.position.x(), 0.0, 50.0 * 2.0 * rounding);
  EXPECT_NEAR(slot.energy().total, 0.03125, 50.0 * 2.0 * rounding);
  // Recognised as locked after 50 stages of at most 2 m v, not after the thousand at which any group ends.
  double pushed = 0.0;
  for (const ContactEvent& contact : slot.takeContacts())
    pushed += contact.impulse;
  EXPECT_LE(pushed, 51 * 2.0);
  EXPECT_LT(slot.statistics().events, 100);

  Walls walls;
  walls.left = walls.bottom = -0.5;
  walls.right = walls.top = 0.5;
  World cell(makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0.25 }, 0.7) }, walls));
  const MotionState stuck = stateAt(cell, 1.0);
  EXPECT_NEAR(stuck.velocity.norm(), 0.0, 100.0 * rounding);
  EXPECT_NEAR(stuck.omega, 0.0, 100.0 * rounding);
  EXPECT_LT(cell.statistics().events, 100);
  expectExact(cell, 1e-13);
}

/// Regular polygon of `count` corners on the unit circle, its first face in the direction `angle`, held by fixed blocks
/// along some of its faces. They are placed by their own turned frames, so that the gaps are closed to rounding only.
Scene makeHeld(int count, const std::vector<int>& faces, double angle, const Vector2d& velocity, double omega)
{
  Block held;
  held.name = "held";
  held.elasticity = 1.0;
  for (int k = 0; k < count; ++k)
    held.vertices.push_back({ std::cos((2 * k - 1) * pi / count), std::sin((2 * k - 1) * pi / count) });
  held.angle = angle;
  std::vector<Block> blocks{ moving(held, velocity, omega) };
  for (const int k : faces)
  {
    const double turn = angle + 2 * k * pi / count, distance = std::cos(pi / count) + 0.5;
    blocks.push_back(fixedOne(
        makeBox("jaw" + std::to_string(k), { 1, 0.2 }, distance * Vector2d(std::cos(turn), std::sin(turn)), turn)));
  }
  return makeScene(0.0, 1.0, blocks);
}

// B10 at random: faces that hold all around lock the polygon (each pair of corners takes the turn away too), others let
// it go with all its energy. Gordan's alternative in the plane: it is held if no gap between neighbouring faces reaches
// half a turn.
TEST(Simultaneous, HeldAllAroundOrNot)
{
  Random random(7);
  int held_count = 0, free_count = 0;
  for (int i = 0; i < 200; ++i)
  {
    SCOPED_TRACE(i);
    const int count = 3 + random.below(5);
    std::vector<int> faces;
    for (int k = 0; k < count; ++k)
      if (random.below(3) > 0)
        faces.push_back(k);
    if (faces.empty())
      continue;
    int widest = faces.front() + count - faces.back();
    for (std::size_t k = 1; k < faces.size(); ++k)
      widest = std::max(widest, faces[k] - faces[k - 1]);
    const double angle = random.in(-pi, pi);
    const Vector2d velocity = random.vector(1.0);
    World world(makeHeld(count, faces, angle, velocity, random.in(-1.0, 1.0)));
    const double before = world.energy().total;
    run(world, 1e-6);
    if (2 * widest < count)
    {
      ++held_count;
      EXPECT_NEAR(world.state(0).velocity.norm() + std::abs(world.state(0).omega), 0.0, 1e-12);
    }
    else if (2 * widest > count)
    {
      ++free_count;
      EXPECT_NEAR(world.energy().total / before, 1.0, 1e-12);
    }
    EXPECT_LE(world.energy().total, before * (1.0 + 1e-13));
    EXPECT_LT(world.statistics().events, 100);
  }
  EXPECT_GT(held_count, 20);
  EXPECT_GT(free_count, 20);
}

// B11: the normal is the bisector of the corners' faces, so the mirror's symmetry stays.
TEST(Simultaneous, CornerOnCorner)
{
  for (const double e : { 1.0, 0.5, 0.0 })
  {
    World world(makeCornerOnCorner(e));
    run(world, 2.0);
    expectSpeeds(world, 0, { -e, e }, 1e-14);
    expectSpeeds(world, 1, { 0, 0 }, 1e-14);
    EXPECT_NEAR(world.state(0).omega, 0.0, 1e-14);
    EXPECT_NEAR(world.state(1).omega, 0.0, 1e-14);
    EXPECT_EQ(world.statistics().impacts, 1);
    expectExact(world, 1e-14);
  }
}

// B12: islands do not couple.
TEST(Simultaneous, HundredLandings)
{
  World many(makeLandings(100)), one(makeLandings(1));
  for (const double t : { 0.5, 0.9, 2.0 })
  {
    run(many, t);
    const MotionState alone = stateAt(one, t);
    for (int i = 0; i < 100; ++i)
    {
      EXPECT_EQ(many.state(i).position.y(), alone.position.y()) << i;
      EXPECT_EQ(many.state(i).velocity.y(), alone.velocity.y()) << i;
    }
  }
  EXPECT_EQ(many.statistics().impacts, 100 * one.statistics().impacts);
}

// B13: no unique outcome, but energy and horizontal momentum are kept, and nothing approaches.
TEST(Simultaneous, BrickWall)
{
  World world(makeBrickWall());
  run(world, 0.05);
  EXPECT_NEAR(world.energy().total / 4.5, 1.0, 1e-12);
  EXPECT_NEAR(world.energy().momentum_x, 3.0, 1e-12);
  EXPECT_GE(world.statistics().impacts, 1);
  expectExact(world, 1e-11);
}

}  // namespace
}  // namespace block_world
