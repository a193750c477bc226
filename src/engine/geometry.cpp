#include "geometry.h"

#include <algorithm>
#include <limits>

namespace block_world
{
AreaMoments areaMoments(const std::vector<Vec2>& vertices)
{
  // Triangles over the first vertex, so that a polygon far from the origin loses no digits.
  AreaMoments moments;
  if (vertices.size() < 3)
    return moments;
  const Vec2 origin = vertices.front();
  double doubled = 0.0, second = 0.0;
  Vec2 first = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
  {
    const Vec2 p = vertices[i] - origin, q = vertices[i + 1] - origin;
    const double c = cross(p, q);
    doubled += c;
    first += c * (p + q) / 3.0;
    second += c * (p.dot(p) + p.dot(q) + q.dot(q)) / 6.0;
  }
  moments.area = doubled / 2.0;
  if (doubled == 0.0)
    return moments;
  const Vec2 shift = first / doubled;
  moments.centroid = origin + shift;
  moments.gyration = second / doubled - shift.squaredNorm();
  return moments;
}

Polygon makePolygon(const std::vector<Vec2>& vertices)
{
  Polygon polygon;
  polygon.vertices = vertices;
  polygon.faces.reserve(vertices.size());
  polygon.gyration = areaMoments(vertices).gyration;
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const Vec2& p = vertices[i];
    const Vec2& q = vertices[(i + 1) % vertices.size()];
    Face face;
    face.length = (q - p).norm();
    face.normal = -perp(q - p) / face.length;
    face.offset = face.normal.dot(p);
    polygon.faces.push_back(face);
    polygon.radius = std::max(polygon.radius, p.norm());
  }
  return polygon;
}

Polygon makeHalfPlane(const Vec2& normal, double offset)
{
  Polygon polygon;
  Face face;
  face.normal = normal;
  face.offset = offset;
  face.length = std::numeric_limits<double>::infinity();
  polygon.faces.push_back(face);
  polygon.radius = std::numeric_limits<double>::infinity();
  return polygon;
}

double faceGap(const Face& face, const Frame& frame_a, const Polygon& b, const Frame& frame_b)
{
  // g = n.(x_b + R_b p - x_a) - o, smallest over b's vertices; n.R_b p is found in b's frame.
  const Vec2 normal = frame_a.rotate(face.normal);
  const Vec2 normal_b = frame_b.unrotate(normal);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2& p : b.vertices)
    lowest = std::min(lowest, normal_b.dot(p));
  return normal.dot(frame_b.position - frame_a.position) + lowest - face.offset;
}

double separation(const Polygon& a, const Frame& frame_a, const Polygon& b, const Frame& frame_b)
{
  double best = -std::numeric_limits<double>::infinity();
  if (!b.vertices.empty())
    for (const Face& face : a.faces)
      best = std::max(best, faceGap(face, frame_a, b, frame_b));
  if (!a.vertices.empty())
    for (const Face& face : b.faces)
      best = std::max(best, faceGap(face, frame_b, a, frame_a));
  return best;
}

Vec2 nearestPoint(const Polygon& polygon, const Vec2& point)
{
  bool inside = true;
  Vec2 nearest = point;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.faces.size(); ++i)
  {
    const Face& face = polygon.faces[i];
    if (face.normal.dot(point) <= face.offset)
      continue;
    inside = false;
    const Vec2 start = polygon.vertices[i], tangent = perp(face.normal);
    const double along = std::min(std::max(tangent.dot(point - start), 0.0), face.length);
    const Vec2 candidate = start + along * tangent;
    const double distance = (point - candidate).squaredNorm();
    if (distance < least)
    {
      least = distance;
      nearest = candidate;
    }
  }
  return inside ? point : nearest;
}

}  // namespace block_world
