#include "outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace campaign
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

double lowest(const std::vector<Vector2d>& corners, const Vector2d& direction)
{
  double least = infinity;
  for (const Vector2d& corner : corners)
    least = std::min(least, direction.dot(corner));
  return least;
}

/// How far b keeps clear of the best of a's sides.
double clearOf(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b)
{
  double best = -infinity;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const Vector2d side = a[(i + 1) % a.size()] - a[i];
    const Vector2d outward = Vector2d(side.y(), -side.x()) / side.norm();
    best = std::max(best, lowest(b, outward) - outward.dot(a[i]));
  }
  return best;
}
}  // namespace

Outline outlineOf(const block_world::Block& block, const Vector2d& position, double angle)
{
  Outline outline;
  outline.centre = position;
  const double c = std::cos(angle), s = std::sin(angle);
  for (const Vector2d& v : block.vertices)
  {
    outline.corners.emplace_back(position.x() + c * v.x() - s * v.y(), position.y() + s * v.x() + c * v.y());
    outline.radius = std::max(outline.radius, v.norm());
  }
  return outline;
}

std::vector<Outline> outlinesOf(const block_world::Walls& walls)
{
  std::vector<Outline> outlines;
  const auto add = [&](const std::optional<double>& at, const Vector2d& inward) {
    if (!at)
      return;
    Outline wall;
    wall.inward = inward;
    wall.offset = inward.x() + inward.y() > 0.0 ? *at : -*at;
    outlines.push_back(wall);
  };
  add(walls.left, Vector2d(1, 0));
  add(walls.right, Vector2d(-1, 0));
  add(walls.bottom, Vector2d(0, 1));
  add(walls.top, Vector2d(0, -1));
  return outlines;
}

double separation(const Outline& a, const Outline& b, double enough)
{
  if (b.corners.empty())
    return a.corners.empty() ? infinity : lowest(a.corners, b.inward) - b.offset;
  if (a.corners.empty())
    return separation(b, a);
  const double apart = (a.centre - b.centre).norm() - a.radius - b.radius;
  if (apart > enough)
    return apart;
  return std::max(clearOf(a.corners, b.corners), clearOf(b.corners, a.corners));
}

}  // namespace campaign
