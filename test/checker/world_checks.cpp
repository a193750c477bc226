#include <algorithm>

#include "energy.h"
#include "limits.h"

// Checks that look at all blocks together.

namespace checker
{
namespace
{
/// Momentum, and what its change over an interval follows from.
struct Sums
{
  Vec2 momentum = Vec2::Zero(), damped = Vec2::Zero(), moment = Vec2::Zero();
  double angular = 0.0, mass = 0.0, size = 0.0, angular_size = 0.0;
};

Sums sumsOf(const Scene& scene, const Drive& drive, const Run& run, size_t sample)
{
  Sums sums;
  for (size_t i = 0; i < run.bodies; ++i)
  {
    if (scene.blocks[i].fixed)
      continue;
    const State& state = run.state(sample, static_cast<int>(i));
    const double mass = drive.bodies[i].mass, inertia = mass * scene.blocks[i].shape.gyration;
    sums.mass += mass;
    sums.momentum += mass * state.velocity;
    sums.damped += state.position;
    sums.moment += mass * state.position;
    sums.angular += mass * cross(state.position, state.velocity) + inertia * state.omega;
    sums.size += mass * state.velocity.norm();
    sums.angular_size += mass * state.position.norm() * state.velocity.norm() + inertia * std::abs(state.omega);
  }
  return sums;
}

/// Nothing but gravity and damping acts from outside.
bool closed(const Scene& scene, const Drive& drive)
{
  const auto driven = [](const Drive::Body& body) {
    return !body.levels.empty() || body.spring || body.torque != 0.0 || body.force != Vec2::Zero();
  };
  const auto anchored = [&](const Spring& spring) {
    return spring.from < 0 || spring.to < 0 || !scene.movable(spring.from) || !scene.movable(spring.to);
  };
  return std::none_of(drive.bodies.begin(), drive.bodies.end(), driven) &&
         std::none_of(scene.springs.begin(), scene.springs.end(), anchored);
}
/// The damper of a spring without length acts along the velocity, beside the line of its ends: it turns them.
bool dampersTurn(const Scene& scene)
{
  return std::any_of(scene.springs.begin(), scene.springs.end(),
                     [](const Spring& spring) { return spring.rest_length == 0.0 && spring.damping != 0.0; });
}
}  // namespace

void checkMomentum(const Scene& scene, const Run& run, const Timeline& timeline, Replay& replay, Report& report)
{
  Check& linear = report.check("momentum.linear", "momentum of all blocks between wall contacts, N s per interval");
  Check& angular = report.check("momentum.angular", "the same for angular momentum about the origin, N m s per "
                                                    "interval");
  for (size_t k = 1; k < run.times.size(); ++k)
  {
    const Drive& drive = timeline.at(run.times[k - 1]);
    if (timeline.firstAfter(run.times[k - 1]) != timeline.firstAfter(run.times[k]) || !closed(scene, drive))
      continue;
    bool outside = false, shifted = false;
    for (size_t i = k < 2 ? 0 : replay.rowsEnd(k - 2); i < replay.rowsEnd(k); ++i)
    {
      const ContactRow& row = run.contacts[i];
      outside = outside || ((!scene.movable(row.a) || !scene.movable(row.b)) && row.time >= run.times[k - 1]);
      shifted = shifted || row.kind == Kind::RestBegin || row.kind == Kind::RestEnd;
    }
    if (outside)
      continue;
    const double h = run.times[k] - run.times[k - 1];
    const Sums from = sumsOf(scene, drive, run, k - 1), to = sumsOf(scene, drive, run, k);
    const Vec2 weight(0.0, -drive.gravity * from.mass);
    const Vec2 change = to.momentum - from.momentum - h * weight + drive.damping * (to.damped - from.damped);
    linear.add(change.norm(), 10.0 * relative_error * std::max(1.0, from.size + to.size), run.times[k]);
    if (drive.damping != 0.0 || shifted || dampersTurn(scene))
      continue;
    // The common centre of mass is on a parabola, whose integral Hermite's rule gives exactly.
    const Vec2 moment = 0.5 * h * (from.moment + to.moment) + h * h / 12.0 * (from.momentum - to.momentum);
    angular.add(std::abs(to.angular - from.angular + drive.gravity * moment.x()),
                10.0 * relative_error * std::max(1.0, from.angular_size + to.angular_size), run.times[k]);
  }
}

void checkOverlap(const Scene& scene, const Run& run, Report& report)
{
  Check& check = report.check("overlap.samples", "depth of overlap at the samples, m");
  const double limit = scene.tolerance * (1.0 + 1e-6) + relative_error;
  std::vector<Outline> outlines(run.bodies);
  for (size_t k = 0; k < run.times.size(); ++k)
  {
    const auto at = [&](size_t body) -> const State& { return run.state(k, static_cast<int>(body)); };
    for (size_t i = 0; i < run.bodies; ++i)
      outlines[i] = place(scene.blocks[i].shape, at(i).position, at(i).angle);
    for (size_t i = 0; i < run.bodies; ++i)
    {
      const double radius = scene.blocks[i].shape.radius;
      for (size_t w = 0; w < scene.walls.size() && !scene.blocks[i].fixed; ++w)
      {
        const Wall& wall = scene.walls[w];
        const double depth = wall.offset - lowest(outlines[i], wall.normal);
        check.add(std::max(0.0, depth), limit, run.times[k], static_cast<int>(i), static_cast<int>(run.bodies + w));
      }
      for (size_t j = 0; j < i; ++j)
      {
        if (scene.blocks[i].fixed && scene.blocks[j].fixed)
          continue;
        const bool near = !((at(i).position - at(j).position).norm() > radius + scene.blocks[j].shape.radius);
        const double depth = near ? std::max(0.0, -separation(outlines[i], outlines[j])) : 0.0;
        check.add(depth, limit, run.times[k], static_cast<int>(j), static_cast<int>(i));
      }
    }
  }
}

}  // namespace checker
