#pragma once

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "room.h"

namespace block_world
{
using Vec2 = Eigen::Vector2d;

/// z component of a x b.
inline double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// z-axis x a: a turned by +90 degrees.
inline Vec2 perp(const Vec2& a)
{
  return Vec2(-a.y(), a.x());
}

/// v turned by a direction, the cosine and sine of an angle.
inline Vec2 turned(const Vec2& direction, const Vec2& v)
{
  return direction.x() * v + direction.y() * perp(v);
}

/// Position of a body's centre of mass with the cosine and sine of its angle.
struct Frame
{
  Vec2 position = Vec2::Zero();
  double cosine = 1.0, sine = 0.0;

  Frame() = default;
  Frame(const Vec2& position, double angle) : position(position), cosine(std::cos(angle)), sine(std::sin(angle))
  {
  }
  Vec2 rotate(const Vec2& v) const
  {
    return Vec2(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y());
  }
  Vec2 unrotate(const Vec2& v) const
  {
    return Vec2(cosine * v.x() + sine * v.y(), -sine * v.x() + cosine * v.y());
  }
  Vec2 toWorld(const Vec2& point) const
  {
    return position + rotate(point);
  }
  Vec2 toBody(const Vec2& point) const
  {
    return unrotate(point - position);
  }
};

/// One side of a polygon: the points p with normal.p = offset, over length along perp(normal).
struct Face
{
  Vec2 normal;  ///< outward, unit length
  double offset = 0.0;
  double length = 0.0;  ///< infinite for a wall
};

/// A convex polygon about its centre of mass, counter-clockwise; or a half-plane, which has one face and no vertices. A face begins at the vertex of
/// its index.
struct alignas(kCacheLine) Polygon
{
  std::vector<Vec2> vertices;
  std::vector<Face> faces;
  double radius = 0.0;   ///< m, of the circle about the centre of mass through the farthest vertex; infinite for a half-plane
  double gyration = 0.0;  ///< m^2, moment of inertia per mass at uniform density
};

/// Polygon of vertices that are counter-clockwise and already centred.
Polygon makePolygon(const std::vector<Vec2>& vertices);

/// The half-plane normal.p <= offset.
Polygon makeHalfPlane(const Vec2& normal, double offset);

/// Signed area (positive = counter-clockwise), centroid and second moment per area about the centroid of any simple polygon.
struct AreaMoments
{
  double area = 0.0;
  Vec2 centroid = Vec2::Zero();
  double gyration = 0.0;
};
AreaMoments areaMoments(const std::vector<Vec2>& vertices);

/// Gap of b's nearest vertex over a face of a: negative where a vertex lies behind the face.
double faceGap(const Face& face, const Frame& frame_a, const Polygon& b, const Frame& frame_b);

/// Largest face gap over the faces of both bodies: the pair is disjoint exactly where it is positive (separating axes in the plane).
double separation(const Polygon& a, const Frame& frame_a, const Polygon& b, const Frame& frame_b);

/// Point of a solid polygon nearest to a point, both in the body frame.
Vec2 nearestPoint(const Polygon& polygon, const Vec2& point);

}  // namespace block_world
