#include "shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace checker
{
namespace
{
// Sums over the triangles from the first vertex: no cancellation for polygons far from the origin of their coordinates.
void moments(const std::vector<Vec2>& v, double& area, Vec2& centre)
{
  area = 0.0;
  centre.setZero();
  for (size_t i = 2; i < v.size(); ++i)
  {
    const double part = 0.5 * cross(v[i - 1] - v[0], v[i] - v[0]);
    area += part;
    centre += part * ((v[i - 1] - v[0]) + (v[i] - v[0])) / 3.0;
  }
  centre = v[0] + centre / area;
}

double largestFaceGap(const Outline& faces, const Outline& corners)
{
  double best = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < faces.size(); ++i)
  {
    const Vec2 edge = faces[(i + 1) % faces.size()] - faces[i];
    const Vec2 normal = Vec2(edge.y(), -edge.x()) / edge.norm();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2& corner : corners)
      nearest = std::min(nearest, normal.dot(corner - faces[i]));
    best = std::max(best, nearest);
  }
  return best;
}
}  // namespace

Shape makeShape(std::vector<Vec2> vertices)
{
  Shape shape;
  double area;
  Vec2 centre;
  moments(vertices, area, centre);
  if (area < 0.0)
    std::reverse(vertices.begin(), vertices.end());
  for (Vec2& vertex : vertices)
    vertex -= centre;
  double second_moment = 0.0;
  for (size_t i = 0; i < vertices.size(); ++i)
  {
    const Vec2 &p = vertices[i], &q = vertices[(i + 1) % vertices.size()];
    second_moment += cross(p, q) * (p.dot(p) + p.dot(q) + q.dot(q)) / 12.0;
    shape.radius = std::max(shape.radius, p.norm());
  }
  shape.gyration = second_moment / std::abs(area);
  shape.vertices = vertices;
  return shape;
}

Vec2 turned(const Vec2& v, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y());
}

Outline place(const Shape& shape, const Vec2& position, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  Outline outline;
  outline.reserve(shape.vertices.size());
  for (const Vec2& v : shape.vertices)
    outline.emplace_back(position.x() + c * v.x() - s * v.y(), position.y() + s * v.x() + c * v.y());
  return outline;
}

double separation(const Outline& a, const Outline& b)
{
  return std::max(largestFaceGap(a, b), largestFaceGap(b, a));
}

double boundaryDistance(const Outline& outline, const Vec2& point)
{
  double best = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < outline.size(); ++i)
  {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    const double along = std::clamp(edge.dot(point - outline[i]) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (outline[i] + along * edge - point).norm());
  }
  return best;
}

double lowest(const Outline& outline, const Vec2& direction)
{
  double value = std::numeric_limits<double>::infinity();
  for (const Vec2& vertex : outline)
    value = std::min(value, direction.dot(vertex));
  return value;
}

double highest(const Outline& outline, const Vec2& direction)
{
  return -lowest(outline, -direction);
}

}  // namespace checker
