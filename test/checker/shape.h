#pragma once

#include <Eigen/Core>

#include <vector>

namespace checker
{
using Vec2 = Eigen::Vector2d;

/// z component of a x b.
inline double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// A convex polygon about its centre of mass, counter-clockwise.
struct Shape
{
  std::vector<Vec2> vertices;
  double radius = 0.0;    ///< of the circle about the centre of mass through the farthest vertex
  double gyration = 0.0;  ///< moment of inertia per mass at uniform density
};

/// Orders the vertices counter-clockwise and moves the centre of mass to the origin.
Shape makeShape(std::vector<Vec2> vertices);

/// Vertices of a body in the world.
using Outline = std::vector<Vec2>;

Vec2 turned(const Vec2& v, double angle);
Outline place(const Shape& shape, const Vec2& position, double angle);

/// Separating axes: largest distance between the two along any face normal of either; negative is the depth of the
/// overlap.
double separation(const Outline& a, const Outline& b);

/// Distance from a point to the nearest point of the boundary.
double boundaryDistance(const Outline& outline, const Vec2& point);

/// Extent of the outline along a direction.
double lowest(const Outline& outline, const Vec2& direction);
double highest(const Outline& outline, const Vec2& direction);

}  // namespace checker
