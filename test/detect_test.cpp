#include "detect.h"

#include "bodies.h"
#include "random.h"

#include <algorithm>

namespace block_world
{
namespace
{
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-6, resolution = 1e-14;

double separationAt(const Body& a, const Body& b, const Time& time)
{
  const Snapshot now_a = a.at(time), now_b = b.at(time);
  return separation(*a.shape, Frame(now_a.position, now_a.angle), *b.shape, Frame(now_b.position, now_b.angle));
}

/// What became of a pair that was watched until it met or until a time.
struct Watch
{
  bool met = false;
  Time at;
  int looks = 0;
  double lowest = never;  ///< separation at any sample within the promised spans
};

/// Looks at a pair as the engine does; samples the true separation within every promise.
Watch watch(const Body& a, const Body& b, double until, int samples)
{
  Detector detector;
  detector.configure(tolerance, resolution);
  Pair pair;
  pair.a = 0;
  pair.b = 1;
  Watch result;
  Time now;
  const Time end = Time::fromSeconds(until);
  while (now < end && result.looks < 1000)
  {
    ++result.looks;
    const double horizon = end - now;
    const Snapshot now_a = a.at(now), now_b = b.at(now);
    double span = detector.apart(a, now_a, b, now_b, horizon);
    pair.contact_due = false;
    if (span < 0.0)
    {
      const View view_a{ &a, &now_a, Frame(now_a.position, now_a.angle) },
          view_b{ &b, &now_b, Frame(now_b.position, now_b.angle) };
      span = detector.certify(pair, view_a, view_b, now, horizon);
    }
    span = std::min(span, horizon);
    for (int k = 0; k <= samples; ++k)
      result.lowest = std::min(result.lowest, separationAt(a, b, now + span * k / samples));
    now = now + span;
    if (pair.contact_due)
    {
      result.met = true;
      result.at = now;
      break;
    }
  }
  return result;
}

/// First time at which the true separation is below the level, on a grid; infinity if none.
double firstOverlap(const Body& a, const Body& b, double until, double step, double level)
{
  for (int k = 0; k * step <= until; ++k)
    if (separationAt(a, b, Time::fromSeconds(k * step)) < level)
      return k * step;
  return never;
}

Body tumbling(Random& random, const Vec2& position, double speed, double turn)
{
  Body body = block(roundish(random, 3 + random.below(5), random.in(0.2, 1.0)), 1.0);
  const Vec2 velocity = random.vector(speed),
             acceleration = random.below(2) == 0 ? Vec2(0.0, -9.81) : random.vector(5.0);
  launch(body, position, random.in(-3.0, 3.0), velocity, random.in(-turn, turn), acceleration,
         random.below(2) == 0 ? 0.0 : random.in(-3.0, 3.0));
  return body;
}

/// Turns the parabola into an arc of higher degree with the bounds that flow.cpp gives it.
void wobble(Random& random, Body& body, double horizon)
{
  Arc& arc = body.arc;
  arc.degree = 6;
  arc.horizon = horizon;
  arc.end = arc.start + horizon;
  for (int n = 3; n <= 6; ++n)
  {
    arc.order[n].x = random.in(-1.0, 1.0);
    arc.order[n].y = random.in(-1.0, 1.0);
    arc.order[n].angle = random.in(-1.0, 1.0);
    arc.jerk += n * (n - 1) * (n - 2) * std::pow(horizon, n - 3) * std::hypot(arc.order[n].x, arc.order[n].y);
    arc.angular_jerk += n * (n - 1) * (n - 2) * std::pow(horizon, n - 3) * std::abs(arc.order[n].angle);
  }
}

// Positions stay below some 50 m, so the true separation rounds by 1e-14; turns of up to 1e3 rad move a corner by as
// much as 1e-13.
constexpr double rounding = 1e-12;

void expectWatched(const Body& a, const Body& b, double until, int most_looks)
{
  const Watch seen = watch(a, b, until, 40);
  EXPECT_GT(seen.lowest, -rounding);
  EXPECT_LE(seen.looks, most_looks);
  const double overlap = firstOverlap(a, b, until, until / 4000, -1e-9);
  if (seen.met)
  {
    EXPECT_NEAR(separationAt(a, b, seen.at), 0.0, rounding);
    EXPECT_LE(seen.at.seconds(), overlap);
  }
  else
  {
    EXPECT_EQ(overlap, never);
  }
}

TEST(Detector, RandomPairsNeverPassAContact)
{
  Random random(1);
  int met = 0, watched = 0;
  for (int i = 0; i < 400; ++i)
  {
    SCOPED_TRACE(i);
    const bool wobbling = i % 3 == 0;
    const double until = wobbling ? 1.0 : 2.0;
    Body a = tumbling(random, Vec2::Zero(), 2.0, i % 5 == 0 ? 30.0 : 3.0);
    Body b = tumbling(random, random.vector(3.0), 4.0, 3.0);
    if (i % 4 == 0)
      a = wall(Vec2(0.0, 1.0), -1.0);
    if (wobbling)
      wobble(random, b, until);
    if (separationAt(a, b, Time()) < 1e-3)
      continue;
    ++watched;
    expectWatched(a, b, until, 150);
    met += firstOverlap(a, b, until, until / 4000, -1e-9) < never;
  }
  EXPECT_GT(watched, 250);
  EXPECT_GT(met, 80);
}

TEST(Detector, ThinAndFast)
{
  // A sheet of .1 mm is crossed in a microsecond; met when the box's face reaches its own.
  Body sheet = block(rectangle(1e-4, 2.0), 1.0), box = block(rectangle(1.0, 1.0), 1.0);
  launch(sheet, Vec2::Zero());
  launch(box, Vec2(-30.0, 0.25), 0.0, Vec2(100.0, 0.0));
  const Watch seen = watch(sheet, box, 10.0, 10);
  ASSERT_TRUE(seen.met);
  EXPECT_NEAR(seen.at.seconds(), (29.5 - 0.5e-4) / 100.0, 1e-15);
  EXPECT_LE(seen.looks, 8);
}

TEST(Detector, FallOntoTheFloorByHand)
{
  Body floor = wall(Vec2(0.0, 1.0), 0.0), box = block(rectangle(1.0, 0.5), 1.0);
  launch(box, Vec2(0.0, 5.25), 0.0, Vec2(3.0, 0.0), 0.0, Vec2(0.0, -10.0));
  const Watch seen = watch(floor, box, 10.0, 100);
  ASSERT_TRUE(seen.met);
  EXPECT_NEAR(seen.at.seconds(), 1.0, 1e-15);  // sqrt(2 * 5 / 10)
  EXPECT_LE(seen.looks, 8);
}

TEST(Detector, SpinnerNeedsFewLooks)
{
  // 60 s of drift at a thousand rad/s: over 9000 turns, met by a corner.
  Body floor = wall(Vec2(0.0, 1.0), 0.0), box = block(rectangle(1.0, 0.5), 1.0);
  launch(box, Vec2(0.0, 10.0), 0.0, Vec2(0.0, -0.16), 1000.0);
  const Watch seen = watch(floor, box, 100.0, 1000);
  ASSERT_TRUE(seen.met);
  EXPECT_LE(seen.looks, 60);
  EXPECT_GT(seen.lowest, -1e-11);  // angles of 6e4 rad round by 7e-12
  EXPECT_NEAR(separationAt(floor, box, seen.at), 0.0, 1e-11);
  // Never before the farthest corner can reach, nor after one more turn.
  const double reach = (10.0 - std::hypot(0.5, 0.25)) / 0.16;
  EXPECT_GE(seen.at.seconds(), reach);
  EXPECT_LE(seen.at.seconds(), reach + 2.0 * pi / 1000.0);
}

TEST(Detector, GrazingTheCeiling)
{
  // Thrown up to peak a little below the ceiling, or a little above it.
  for (const double miss : { 1e-3, 1e-7, 1e-9, 1e-12, -1e-12, -1e-9, -1e-7, -1e-3 })
  {
    SCOPED_TRACE(miss);
    Body ceiling = wall(Vec2(0.0, -1.0), 0.0), box = block(rectangle(1.0, 0.5), 1.0);
    launch(box, Vec2(0.0, -5.25 - miss), 0.0, Vec2(1.0, 10.0), 0.0, Vec2(0.0, -10.0));
    const Watch seen = watch(ceiling, box, 3.0, 100);
    EXPECT_EQ(seen.met, miss < 0.0);
    EXPECT_GT(seen.lowest, -1e-14);
    EXPECT_LE(seen.looks, 40);
    if (seen.met)
    {
      // 1 - sqrt(2 |miss| / 10), where the speed of sqrt(20 |miss|) turns rounding of 4e-15 into time.
      EXPECT_NEAR(seen.at.seconds(), 1.0 - std::sqrt(-miss / 5.0), 4e-15 / std::sqrt(-20.0 * miss) + 1e-15);
    }
  }
}

TEST(Detector, CornersThatPass)
{
  // Squares that pass each other a little apart, or hook: a single corner decides, also within the tolerance.
  for (const double gap : { 1e-3, 1e-5, 1e-8, 1e-12, -1e-12, -1e-8, -3e-7, -1e-5 })
  {
    SCOPED_TRACE(gap);
    Body still = block(rectangle(1.0, 1.0), 1.0), passing = block(rectangle(1.0, 1.0), 1.0);
    launch(still, Vec2::Zero());
    launch(passing, Vec2(-3.0, 1.0 + gap), 0.0, Vec2(2.0, 0.0));
    const Watch seen = watch(still, passing, 5.0, 100);
    EXPECT_EQ(seen.met, gap < 0.0);
    EXPECT_LE(seen.looks, 60);
    EXPECT_GT(seen.lowest, -1e-14);
    if (seen.met)
    {
      EXPECT_NEAR(seen.at.seconds(), 1.0, 1e-14);
    }
  }
}

TEST(Detector, CirclesThatMissNeedOneLook)
{
  Body a = block(rectangle(1.0, 1.0), 1.0), b = a;
  launch(a, Vec2::Zero(), 0.0, Vec2(1.0, 0.0), 5.0, Vec2(0.0, -9.81));
  launch(b, Vec2(10.0, 4.0), 0.0, Vec2(-1.0, 0.0), -7.0, Vec2(0.0, -9.81));
  const Watch seen = watch(a, b, 1e6, 100);
  EXPECT_FALSE(seen.met);
  EXPECT_EQ(seen.looks, 1);
}

TEST(Detector, ApartPromisesNoMoreThanTheCirclesHold)
{
  Random random(2);
  Detector detector;
  detector.configure(tolerance, resolution);
  int promises = 0;
  for (int i = 0; i < 2000; ++i)
  {
    Body a = tumbling(random, Vec2::Zero(), 2.0, 10.0), b = tumbling(random, random.vector(6.0), 5.0, 10.0);
    if (i % 4 == 0)
      a = wall(Vec2(0.0, 1.0), 0.0);
    const double horizon = 1.5;
    if (i % 3 == 0)
      wobble(random, b, horizon);
    const double span = detector.apart(a, a.at(Time()), b, b.at(Time()), horizon);
    if (span < 0.0)
      continue;
    EXPECT_GT(span, 0.0) << i;
    EXPECT_LE(span, horizon) << i;
    ++promises;
    for (int k = 0; k <= 40; ++k)
    {
      const Time time = Time::fromSeconds(span * k / 40);
      const Vec2 at_a = a.at(time).position, at_b = b.at(time).position;
      const double gap =
          a.shape->vertices.empty() ? at_b.y() - b.shape->radius : (at_b - at_a).norm() - a.shape->radius - b.shape->radius;
      ASSERT_GT(gap, -rounding) << i;
    }
  }
  EXPECT_GT(promises, 1000);
}

// A box that rests on the floor: its vertices are left out, so nothing is ever due; without them known, neither while
// it just lies there.
TEST(Detector, RestingVerticesAreNotGuarded)
{
  Body floor = wall(Vec2(0.0, 1.0), 0.0), box = block(rectangle(1.0, 0.5), 1.0);
  launch(box, Vec2(0.0, 0.25));
  Detector detector;
  detector.configure(tolerance, resolution);
  const Snapshot now_a = floor.at(Time()), now_b = box.at(Time());
  for (const bool resting : { false, true })
  {
    Pair pair;
    if (resting)
      for (const int vertex : { 0, 1 })
        pair.resting.add({ true, 0, vertex });
    const View view_a{ &floor, &now_a, Frame(now_a.position, 0.0) }, view_b{ &box, &now_b, Frame(now_b.position, 0.0) };
    EXPECT_EQ(detector.certify(pair, view_a, view_b, Time(), never), never);
    EXPECT_FALSE(pair.contact_due);
  }
}

// Of rectangles, whose face k goes from vertex k to the next one.
TEST(Detector, WhatRestsFlatCannotTurn)
{
  const Polygon a = makePolygon(rectangle(1.0, 0.5)), b = makePolygon(rectangle(0.6, 0.3)), floor = makeHalfPlane(Vec2(0.0, 1.0), 0.0);
  const struct
  {
    const char* what;
    std::vector<Resting> rests;
    bool flat;
  } cases[] = {
    { "nothing", {}, false },
    { "a corner", { { true, 2, 0 } }, false },
    { "two on one face", { { true, 2, 0 }, { true, 2, 1 } }, true },
    { "one on the end of each other's face", { { true, 2, 0 }, { false, 0, 3 } }, true },
    { "the other end", { { false, 0, 2 }, { true, 2, 1 } }, true },
    { "one on two faces, of an edge that is nearly straight", { { true, 2, 0 }, { true, 1, 0 } }, false },
    { "the face does not end at the vertex", { { true, 2, 0 }, { false, 0, 1 } }, false },
    { "nor does the other one", { { true, 2, 2 }, { false, 0, 3 } }, false },
    { "a third one", { { true, 2, 0 }, { true, 1, 0 }, { false, 0, 3 } }, true },
  };
  for (const auto& c : cases)
  {
    Pair pair;
    for (const Resting& one : c.rests)
      pair.resting.add(one);
    EXPECT_EQ(restsFlat(pair, a, b), c.flat) << c.what;
  }
  Pair pair;
  pair.resting.add({ true, 0, 0 });
  EXPECT_FALSE(restsFlat(pair, floor, b));
  pair.resting.add({ true, 0, 1 });
  EXPECT_TRUE(restsFlat(pair, floor, b));
}

// What rests on one corner can only turn about it. Whatever turns, no corner comes down within a promise, and where only the body turns, at a constant
// speed, a few promises lead to where the next corner does, at an angle whose sine is its height over its distance.
TEST(Detector, OnACornerABodyTurnsAboutIt)
{
  Random random(5);
  Detector detector;
  detector.configure(tolerance, resolution);
  int fallen = 0;
  for (int i = 0; i < 400; ++i)
  {
    const bool constant = i % 2 == 0;
    Body under = block(roundish(random, 5, 1.0), 1.0), box = block(rectangle(1.0, 0.5), 1.0);
    const int corner = random.below(4), face = random.below(5);
    const Vec2 normal = under.shape->faces[face].normal;
    // The diagonals of the box are 0.46 from its longer sides: turned by less than that it stands on this corner.
    const double outward = std::atan2(normal.y(), normal.x()), down = std::atan2(box.shape->vertices[corner].y(), box.shape->vertices[corner].x());
    const double tilt = random.in(-0.3, 0.3), spin = random.in(-2.0, 2.0);
    launch(under, Vec2::Zero(), 0.0, Vec2::Zero(), constant ? 0.0 : random.in(-2.0, 2.0), Vec2::Zero(), constant ? 0.0 : random.in(-5.0, 5.0));
    launch(box, Vec2(0.0, 5.0), outward + pi - down + tilt, Vec2::Zero(), spin);
    if (!constant)
      wobble(random, box, 1.0);
    const auto height = [&](int k, const Time& time) {
      const Frame f(Vec2::Zero(), under.at(time).angle), v(Vec2::Zero(), box.at(time).angle);
      return f.rotate(normal).dot(v.rotate(box.shape->vertices[k] - box.shape->vertices[corner]));
    };
    const int former = (corner + 3) % 4, next = (corner + 1) % 4;
    const auto least = [&](const Time& time) { return std::min(height(former, time), height(next, time)); };
    Pair pair;
    pair.resting.add({ true, static_cast<unsigned>(face), corner });
    Time now;
    int looks = 0;
    while (now < Time::fromSeconds(1.0) && least(now) > 0.6 * tolerance)
    {
      ASSERT_LE(++looks, 20) << i;
      const Snapshot now_a = under.at(now), now_b = box.at(now);
      const View view_a{ &under, &now_a, Frame(now_a.position, now_a.angle) }, view_b{ &box, &now_b, Frame(now_b.position, now_b.angle) };
      const double horizon = Time::fromSeconds(1.0) - now, span = std::min(horizon, detector.certify(pair, view_a, view_b, now, horizon));
      EXPECT_FALSE(pair.contact_due) << i;
      for (int k = 0; k <= 20; ++k)
        EXPECT_GT(least(now + span * k / 20), 0.1 * tolerance) << i;
      now = now + span;
    }
    if (!constant)
      continue;
    const int falling = spin > 0.0 ? former : next;
    const double length = (box.shape->vertices[falling] - box.shape->vertices[corner]).norm();
    const double due = std::asin(height(falling, Time()) / length) / std::abs(spin);
    EXPECT_LE(looks, 6) << i;
    EXPECT_NEAR(now.seconds(), std::min(1.0, due), 2.0 * tolerance / std::abs(spin)) << i;  // 0.6 of it high, at a length of 0.5
    fallen += due < 1.0;
  }
  EXPECT_GT(fallen, 50);
}

// Nothing turns and both fall alike: one look (a second one where the circles were far apart) tells when they meet, to the rounding of their places,
// or that they never do. Corners that graze each other within the tolerance may take more.
TEST(Detector, StraightMotionIsForeseenAtOnce)
{
  Random random(11);
  int met = 0, missed = 0;
  for (int i = 0; i < 3000; ++i)
  {
    Body a = block(rectangle(random.in(0.2, 1.0), random.in(0.2, 1.0)), 1.0), b = block(rectangle(random.in(0.2, 1.0), 0.3), 1.0);
    const double heading = random.in(-M_PI, M_PI), at = heading + random.in(-0.5, 0.5);
    launch(a, Vec2::Zero(), random.in(-M_PI, M_PI), Vec2(0.3, 0.0), 0.0, Vec2(0.0, -9.8));
    launch(b, 1.6 * Vec2(std::cos(at), std::sin(at)), random.in(-M_PI, M_PI), Vec2(0.3, 0.0) - Vec2(std::cos(heading), std::sin(heading)), 0.0,
           Vec2(0.0, -9.8));
    const Watch found = watch(a, b, 4.0, 20);
    EXPECT_LE(found.looks, found.met ? 2 : 3) << i;  // one at the end, where the sum of spans rounds to less
    EXPECT_GE(found.lowest, -1e-13) << i;
    if (found.met)
      EXPECT_NEAR(separationAt(a, b, found.at), 0.0, 1e-13) << i;
    else
      EXPECT_EQ(firstOverlap(a, b, 4.0, 0.02, -1e-9), never) << i;
    ++(found.met ? met : missed);
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(missed, 400);
}

TEST(Detector, LeavingFromContactIsNoContact)
{
  const struct
  {
    const char* what;
    double speed, acceleration;
    double meets;  // by hand; infinity: never
  } cases[] = {
    { "bounced", 2.0, -10.0, 0.4 },  // 2 v / g
    { "bounced, weightless", 2.0, 0.0, never },
    { "lifted from rest", 0.0, 3.0, never },
    { "a small hop", 1e-3, -10.0, 2e-4 },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.what);
    Body floor = wall(Vec2(0.0, 1.0), 0.0), box = block(rectangle(1.0, 0.5), 1.0);
    launch(box, Vec2(0.0, 0.25), 0.0, Vec2(0.0, c.speed), 0.0, Vec2(0.0, c.acceleration));
    const Watch seen = watch(floor, box, 10.0, 100);
    EXPECT_EQ(seen.met, c.meets < never);
    EXPECT_LE(seen.looks, 12);
    if (seen.met)
    {
      EXPECT_NEAR(seen.at.seconds(), c.meets,
                  4e-16 / std::abs(c.speed));  // rounding of heights below .5 over the speed
    }
  }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
