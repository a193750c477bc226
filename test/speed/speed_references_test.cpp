// What speed_against_error takes for the truth, against a second method: closed forms, quadratures, other steps.

#include "closed_forms.h"
#include "speed/engine.h"
#include "speed/reference.h"
#include "speed/scenes.h"

#include <gtest/gtest.h>

namespace block_world::speed
{
namespace
{
/// The second methods work in double: rounding of some thousand operations on numbers below 10.
constexpr double in_double = 1e-12;

Case caseOf(const std::string& name, unsigned seed = 0)
{
  for (const Family& family : families())
    if (family.name == name)
    {
      Variation vary(seed);
      return family.make(vary);
    }
  throw std::runtime_error("no family " + name);
}

double farthest(const Path& a, const Path& b)
{
  Real distance = 0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t frame = 0; frame < std::min(a.size(), b.size()); ++frame)
    distance = std::max(distance, cornerDistance(a[frame], b[frame]));
  return static_cast<double>(distance);
}

MotionState stateOf(const Body& body)
{
  MotionState state;
  state.position = body.position.cast<double>();
  state.angle = static_cast<double>(body.angle);
  state.velocity = body.velocity.cast<double>();
  state.omega = static_cast<double>(body.omega);
  return state;
}

double seconds(std::size_t frame)
{
  return static_cast<double>(frameTime(static_cast<int>(frame)));
}

TEST(SpeedReferences, Flight)
{
  const Case flying = caseOf("damped flight");
  const Scene& scene = flying.scenes[0];
  const Path path = flight(scene, flying.frames);
  const MotionState from = stateOf(path[0][0]);
  for (std::size_t frame = 0; frame < path.size(); frame += 60)
  {
    const MotionState wanted = closed_form::dampedFlight(from, 1.0, inertia(scene.blocks[0]), scene.damping,
                                                         scene.rotational_damping_ratio, scene.gravity, seconds(frame));
    EXPECT_NEAR((stateOf(path[frame][0]).position - wanted.position).norm(), 0.0, in_double);
    EXPECT_NEAR(stateOf(path[frame][0]).angle, wanted.angle, in_double);
  }
}

TEST(SpeedReferences, Bounces)
{
  const Case elastic = caseOf("elastic drop");
  const Path path = bounces(elastic.scenes[0], elastic.frames);
  for (std::size_t frame = 0; frame < path.size(); ++frame)
    EXPECT_NEAR(stateOf(path[frame][0]).position.y(), 0.125 + closed_form::elasticDrop(0.875, 9.8, seconds(frame)),
                in_double);

  // It rests from t0 (1 + e) / (1 - e) on, and has only just come down in the frames before.
  const Case lossy = caseOf("drop to rest");
  const Path to_rest = bounces(lossy.scenes[0], lossy.frames);
  const double rest_time = closed_form::BouncingDrop{ 0.875, 9.8, 0.5 }.restTime();
  for (std::size_t frame = 0; frame < to_rest.size(); ++frame)
  {
    const double height = stateOf(to_rest[frame][0]).position.y() - 0.125;
    EXPECT_EQ(height == 0.0, seconds(frame) > rest_time) << "at " << seconds(frame) << " s";
    // What is left of the time is a hop of 2 v / g and as much again for all that follow with e = 1/2: 4 v / g.
    const double left = std::max(0.0, rest_time - seconds(frame));
    EXPECT_LE(height, 9.8 * left * left / 2.0 + in_double);
  }
}

/// Exchange of momentum and energy at the one hit, worked out from the states before and after it.
TEST(SpeedReferences, Pair)
{
  for (const auto& [name, elasticity] : { std::pair("pair", 1.0), std::pair("lossy pair", 0.5) })
  {
    SCOPED_TRACE(name);
    const Case pair = caseOf(name);
    const Scene& scene = pair.scenes[0];
    const Path path = trustedCollisions(scene, pair.frames);
    const Bodies &before = path.front(), &after = path.back();
    Vector momentum = Vector::Zero();
    Real energy = 0, angular = 0;
    for (int i = 0; i < 2; ++i)
    {
      const auto add = [&](const Body& body, Real sign) {
        momentum += sign * body.mass * body.velocity;
        energy += sign * (body.mass * body.velocity.squaredNorm() + body.inertia * body.omega * body.omega) / 2;
        angular += sign * (body.inertia * body.omega +
                           body.mass * (body.position.x() * body.velocity.y() - body.position.y() * body.velocity.x()));
      };
      add(after[i], 1);
      add(before[i], -1);
    }
    EXPECT_GT((after[0].velocity - before[0].velocity).norm(), 0.1) << "no hit at all";
    EXPECT_NEAR(static_cast<double>(momentum.norm()), 0.0, 1e-15);
    EXPECT_NEAR(static_cast<double>(angular), 0.0, 1e-15);
    EXPECT_EQ(std::abs(static_cast<double>(energy)) < 1e-15, elasticity == 1.0);
  }
}

TEST(SpeedReferences, IntegratedWithOtherSteps)
{
  for (const unsigned seed : { 0u, 1u, 2u })
  {
    const auto compare = [&](const std::string& name, Path (*integrated)(const Scene&, int, int)) {
      const Case of = caseOf(name, seed);
      EXPECT_LT(farthest(integrated(of.scenes[0], of.frames, 4), integrated(of.scenes[0], of.frames, 7)), 1e-15)
          << name << ", seed " << seed;
    };
    compare("rod", fallingRod);
    compare("ladder", ladder);
    compare("spring", springBlock);
  }
}

/// By a quadrature.
TEST(SpeedReferences, Rod)
{
  const Case rod = caseOf("rod");
  const Path path = fallingRod(rod.scenes[0], rod.frames, 4);
  const Body& first = path[0][0];
  const double lean = static_cast<double>(std::atan2(first.half.y(), first.half.x()));
  const closed_form::SlidingFall fall{ 9.8, static_cast<double>(first.inertia), static_cast<double>(first.half.norm()),
                                       static_cast<double>(first.angle) + lean };
  for (std::size_t frame = 5; frame < path.size(); frame += 5)
    EXPECT_NEAR(stateOf(path[frame][0]).angle, fall.angleAt(seconds(frame)) - lean, in_double);
}

/// A ladder as thin as can be, to what the thickness of 1e-9 m does: the speed that it keeps when it has left the wall.
TEST(SpeedReferences, Ladder)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.walls.left = scene.walls.bottom = 0.0;
  const double angle = 1.1, thickness = 2e-9;
  scene.blocks = { box(2.0, thickness, std::cos(angle), std::sin(angle), -angle) };
  const Path path = ladder(scene, 2 * frame_rate, 4);
  const closed_form::Ladder thin{ 9.8, 1.0 / 3.0, angle };
  std::size_t frame = 0;
  while (seconds(frame) < thin.releaseTime())
    ++frame;
  ASSERT_LT(frame, path.size());
  for (; frame < path.size(); ++frame)
    EXPECT_NEAR(stateOf(path[frame][0]).velocity.x(), thin.releaseSpeed(), 10.0 * thickness);
}

/// By Runge and Kutta's method.
TEST(SpeedReferences, Spring)
{
  const Case hanging = caseOf("spring");
  const Scene& scene = hanging.scenes[0];
  const Spring& spring = scene.springs[0];
  const Path path = springBlock(scene, hanging.frames, 4);
  const closed_form::SpringBody body{ 1.0,
                                      inertia(scene.blocks[0]),
                                      scene.gravity,
                                      spring.from_point,
                                      spring.to_point,
                                      spring.stiffness,
                                      spring.rest_length,
                                      spring.damping };
  const MotionState wanted = body.after(stateOf(path.front()[0]), seconds(path.size() - 1));
  EXPECT_NEAR((stateOf(path.back()[0]).position - wanted.position).norm(), 0.0, 10.0 * in_double);
  EXPECT_NEAR(stateOf(path.back()[0]).angle, wanted.angle, 10.0 * in_double);
}

}  // namespace
}  // namespace block_world::speed
