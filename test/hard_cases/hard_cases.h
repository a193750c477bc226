#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

#include "closed_forms.h"
#include "random.h"
#include "world_testing.h"

// What the hard cases ask of a world besides its states.

namespace block_world
{
/// Half a unit in the last place of numbers near 1, relative.
const double rounding = 1.1e-16;

/// Bounces below this speed rise less than four tolerances; what is pressed and slower rests.
inline double captureSpeed(const Scene& scene)
{
  return std::sqrt(8.0 * scene.tolerance * scene.gravity);
}

inline void expectMomentumAndEnergy(const EnergyAccount& found, const EnergyAccount& wanted, double momentum,
                                    double angular_momentum, double energy)
{
  EXPECT_NEAR(found.momentum_x, wanted.momentum_x, momentum);
  EXPECT_NEAR(found.momentum_y, wanted.momentum_y, momentum);
  EXPECT_NEAR(found.angular_momentum, wanted.angular_momentum, angular_momentum);
  EXPECT_NEAR(found.total, wanted.total, energy);
}

/// Deepest overlap of two blocks: what is left of it along the best of all their faces' normals. Worked out here, from
/// the states.
inline double deepestOverlap(const World& world)
{
  std::vector<std::vector<Vector2d>> corners(world.bodyCount());
  std::vector<double> radius(world.bodyCount(), 0.0);
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const Eigen::Rotation2Dd turn(world.state(i).angle);
    for (const Vector2d& vertex : world.block(i).vertices)
    {
      corners[i].push_back(world.state(i).position + turn * vertex);
      radius[i] = std::max(radius[i], vertex.norm());
    }
  }
  // The widest gap between i and j that a face of i shows.
  const auto gap = [&](int i, int j) {
    double widest = -1e300;
    for (std::size_t k = 0; k < corners[i].size(); ++k)
    {
      const Vector2d &from = corners[i][k], side = (corners[i][(k + 1) % corners[i].size()] - from).normalized();
      double nearest = 1e300;
      for (const Vector2d& corner : corners[j])
        nearest = std::min(nearest, -closed_form::cross(side, corner - from));
      widest = std::max(widest, nearest);
    }
    return widest;
  };
  double deepest = 0.0;
  for (int i = 0; i < world.bodyCount(); ++i)
    for (int j = i + 1; j < world.bodyCount(); ++j)
      if (!(world.isFixed(i) && world.isFixed(j)) &&
          (world.state(i).position - world.state(j).position).norm() < radius[i] + radius[j])
        deepest = std::max(deepest, -std::max(gap(i, j), gap(j, i)));
  return deepest;
}

/// Runs on to `seconds` and looks at the energy without the work done: it never grows, and where nothing can be lost it
/// never falls, and nothing overlaps. To 1e-12 of the largest energy at work unless told otherwise: each event rounds
/// by some 1e-16, up or down.
inline void expectEnergyNeverGrows(World& world, double seconds, bool lossless, int looks = 200, double share = 1e-12)
{
  const auto free = [](const EnergyAccount& now) {
    return now.total - now.thrust_work - now.spring_work - now.command_work;
  };
  const auto sizeOf = [](const EnergyAccount& now) {
    return now.translational + now.rotational + now.spring + std::abs(now.gravity);
  };
  const double start = world.now().seconds(), first = free(world.energy());
  double lowest = first, size = sizeOf(world.energy());
  for (int i = 1; i <= looks; ++i)
  {
    run(world, start + (seconds - start) * i / looks);
    const EnergyAccount now = world.energy();
    const double energy = free(now);
    size = std::max(size, sizeOf(now));
    ASSERT_LE(deepestOverlap(world), world.scene().tolerance) << "at " << world.now().seconds() << " s";
    ASSERT_LE(energy, lowest + share * size) << "at " << world.now().seconds() << " s";
    if (lossless)
    {
      ASSERT_GE(energy, first - share * size) << "at " << world.now().seconds() << " s";
    }
    lowest = std::min(lowest, energy);
  }
}

/// No event, and no bit changed, until `seconds`.
inline void expectNothingHappens(World& world, double seconds)
{
  const std::uint64_t hash = world.stateHash();
  const std::int64_t events = world.statistics().events;
  run(world, seconds);
  EXPECT_EQ(world.stateHash(), hash);
  EXPECT_EQ(world.statistics().events, events);
}

/// Sum of the resting forces between two bodies.
inline double forceBetween(const World& world, const std::string& a, const std::string& b)
{
  double sum = 0.0;
  for (const ContactEvent& contact : world.restingContacts())
    if ((world.name(contact.a) == a && world.name(contact.b) == b) ||
        (world.name(contact.a) == b && world.name(contact.b) == a))
      sum += contact.impulse;
  return sum;
}

/// Unit squares on one another on the floor, with these masses.
inline Scene makeStack(const std::vector<double>& masses, double elasticity = 0.3)
{
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < masses.size(); ++i)
    blocks.push_back(withMass(makeBox("b" + std::to_string(i + 1), { 1, 1 }, { 0, i + 0.5 }), masses[i]));
  return makeScene(9.8, elasticity, blocks, onFloor());
}

}  // namespace block_world
