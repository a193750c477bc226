#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "case.h"
#include "engine.h"

namespace block_world::speed
{
namespace
{
double errorAt(const Recording& recording, const Path& path, int frame)
{
  Bodies found = path[frame];
  for (int block = 0; block < recording.blocks; ++block)
  {
    found[block].position = recording.at(frame, block).position.cast<Real>();
    found[block].angle = recording.at(frame, block).angle;
  }
  return static_cast<double>(cornerDistance(found, path[frame]));
}

double energyAt(const Recording& recording, const Scene& scene, int frame)
{
  const double floor = scene.walls.bottom.value_or(0.0);
  double energy = 0.0;
  for (int i = 0; i < recording.blocks; ++i)
  {
    const Block& block = scene.blocks[i];
    const MotionState& state = recording.at(frame, i);
    if (!block.fixed)
      energy += block.mass * (0.5 * state.velocity.squaredNorm() + scene.gravity * (state.position.y() - floor)) +
                0.5 * inertia(block) * state.omega * state.omega;
  }
  return energy;
}

using Corners = std::array<Eigen::Vector2d, 4>;

Corners cornersOf(const MotionState& state, const Block& block)
{
  const Eigen::Rotation2Dd turn(state.angle);
  const double x = block.size->x() / 2, y = block.size->y() / 2;
  Corners corners = { Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y), Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y) };
  for (Eigen::Vector2d& corner : corners)
    corner = state.position + turn * corner;
  return corners;
}

/// The widest gap that a side of `a` shows between both; negative: they overlap by that much along its normal.
double widestGap(const Corners& a, const Corners& b)
{
  double widest = -HUGE_VAL;
  for (int i = 0; i < 4; ++i)
  {
    const Eigen::Vector2d side = (a[(i + 1) % 4] - a[i]).normalized(), normal(side.y(), -side.x());
    double nearest = HUGE_VAL;
    for (const Eigen::Vector2d& corner : b)
      nearest = std::min(nearest, normal.dot(corner - a[i]));
    widest = std::max(widest, nearest);
  }
  return widest;
}

double overlapWithWalls(const Corners& corners, const Walls& walls)
{
  double deepest = 0.0;
  for (const Eigen::Vector2d& corner : corners)
  {
    if (walls.left)
      deepest = std::max(deepest, *walls.left - corner.x());
    if (walls.right)
      deepest = std::max(deepest, corner.x() - *walls.right);
    if (walls.bottom)
      deepest = std::max(deepest, *walls.bottom - corner.y());
    if (walls.top)
      deepest = std::max(deepest, corner.y() - *walls.top);
  }
  return deepest;
}

double overlapAt(const Recording& recording, const Scene& scene, int frame)
{
  std::vector<Corners> corners;
  double deepest = 0.0;
  for (int i = 0; i < recording.blocks; ++i)
  {
    const MotionState& state = recording.at(frame, i);
    corners.push_back(cornersOf(state, scene.blocks[i]));
    deepest = std::max(deepest, overlapWithWalls(corners.back(), scene.walls));
    for (int j = 0; j < i; ++j)
    {
      const double reach = (scene.blocks[i].size->norm() + scene.blocks[j].size->norm()) / 2;
      if ((state.position - recording.at(frame, j).position).norm() < reach)
        deepest = std::max(deepest, -std::max(widestGap(corners[i], corners[j]), widestGap(corners[j], corners[i])));
    }
  }
  return deepest;
}

}  // namespace

Measure cornerError(const Path& path, int first)
{
  return { "largest corner error",
           "m",
           [path, first](const Run& run) {
             double error = 0.0;
             for (int frame = first; frame < static_cast<int>(path.size()); ++frame)
               error = std::max(error, errorAt(run.recordings.front(), path, frame));
             return error;
           },
           {} };
}

Measure cornerErrorAt(const Path& path, int frame)
{
  return { "corner error at " + std::to_string(frame / frame_rate) + " s",
           "m",
           [path, frame](const Run& run) { return errorAt(run.recordings.front(), path, frame); },
           {} };
}

Measure energyChange(const Scene& scene)
{
  return { "energy change",
           "relative",
           [scene](const Run& run) {
             const Recording& recording = run.recordings.front();
             const double first = energyAt(recording, scene, 0);
             return std::abs(energyAt(recording, scene, recording.frames() - 1) / first - 1.0);
           },
           {} };
}

Measure energyGain(const Scene& scene)
{
  return { "energy gained",
           "relative",
           [scene](const Run& run) {
             const Recording& recording = run.recordings.front();
             const double first = energyAt(recording, scene, 0);
             double lowest = first, gain = 0.0;
             for (int frame = 1; frame < recording.frames(); ++frame)
             {
               const double energy = energyAt(recording, scene, frame);
               gain = std::max(gain, energy - lowest);
               lowest = std::min(lowest, energy);
             }
             return gain / first;
           },
           {} };
}

Measure overlap(const Scene& scene)
{
  return { "deepest overlap",
           "m",
           [scene](const Run& run) {
             const Recording& recording = run.recordings.front();
             double deepest = 0.0;
             for (int frame = 0; frame < recording.frames(); ++frame)
               deepest = std::max(deepest, overlapAt(recording, scene, frame));
             return deepest;
           },
           {} };
}

}  // namespace block_world::speed
