#include "reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace block_world::speed
{
namespace
{
constexpr int wall = -1;

/// The nearest features of a pair: negative gap = overlap. The normal points from b to a.
struct Touch
{
  int a = 0, b = wall;
  Real gap = 0;
  Vector normal = Vector::Zero(), point = Vector::Zero();
};

Vector perpendicular(const Vector& v)
{
  return Vector(-v.y(), v.x());
}

Vector rotate(const Vector& v, Real angle)
{
  return std::cos(angle) * v + std::sin(angle) * perpendicular(v);
}

/// Deepest corner of a below the line normal . p = offset.
Touch deepest(const std::vector<Body>& bodies, int a, int b, const Vector& normal, Real offset)
{
  Touch touch;
  for (int i = 0; i < 4; ++i)
  {
    const Vector point = corner(bodies[a], i);
    const Real gap = normal.dot(point) - offset;
    if (i == 0 || gap < touch.gap)
      touch = { a, b, gap, normal, point };
  }
  return touch;
}

/// The face of b with the largest gap to a.
Touch bestFace(const std::vector<Body>& bodies, int a, int b)
{
  Touch best;
  for (int face = 0; face < 4; ++face)
  {
    const Vector axis = face % 2 == 0 ? Vector::UnitX() : Vector::UnitY();
    const Vector normal = rotate(face < 2 ? axis : Vector(-axis), bodies[b].angle);
    const Touch touch = deepest(bodies, a, b, normal, normal.dot(bodies[b].position) + bodies[b].half[face % 2]);
    if (face == 0 || touch.gap > best.gap)
      best = touch;
  }
  return best;
}

/// Separating axes of two rectangles are the normals of their faces.
Touch touchOf(const std::vector<Body>& bodies, int a, int b)
{
  const Touch first = bestFace(bodies, a, b), second = bestFace(bodies, b, a);
  return first.gap > second.gap ? first : second;
}

bool farApart(const Body& a, const Body& b)
{
  return (a.position - b.position).norm() > a.half.norm() + b.half.norm();
}

void addWalls(const std::vector<Body>& bodies, const Walls& walls, int body, std::vector<Touch>& touches)
{
  if (walls.left)
    touches.push_back(deepest(bodies, body, wall, Vector::UnitX(), *walls.left));
  if (walls.right)
    touches.push_back(deepest(bodies, body, wall, -Vector::UnitX(), -*walls.right));
  if (walls.bottom)
    touches.push_back(deepest(bodies, body, wall, Vector::UnitY(), *walls.bottom));
  if (walls.top)
    touches.push_back(deepest(bodies, body, wall, -Vector::UnitY(), -*walls.top));
}

/// All pairs that can touch, smallest gap first.
std::vector<Touch> touchesOf(const std::vector<Body>& bodies, const Walls& walls)
{
  std::vector<Touch> touches;
  const int count = static_cast<int>(bodies.size());
  for (int a = 0; a < count; ++a)
  {
    addWalls(bodies, walls, a, touches);
    for (int b = a + 1; b < count; ++b)
      if (!farApart(bodies[a], bodies[b]))
        touches.push_back(touchOf(bodies, a, b));
  }
  std::sort(touches.begin(), touches.end(), [](const Touch& s, const Touch& t) { return s.gap < t.gap; });
  return touches;
}

bool overlapping(const std::vector<Body>& bodies, const Walls& walls)
{
  const std::vector<Touch> touches = touchesOf(bodies, walls);
  return !touches.empty() && touches.front().gap < 0;
}

std::vector<Body> moved(std::vector<Body> bodies, Real span)
{
  for (Body& body : bodies)
  {
    body.position += span * body.velocity;
    body.angle += span * body.omega;
  }
  return bodies;
}

Vector velocityAt(const Body& body, const Vector& point)
{
  return body.velocity + body.omega * perpendicular(point - body.position);
}

/// 1 / effective mass of a body against an impulse along the normal at the point.
Real mobility(const Body& body, const Touch& touch)
{
  const Real arm = perpendicular(touch.point - body.position).dot(touch.normal);
  return 1 / body.mass + arm * arm / body.inertia;
}

void push(Body& body, const Touch& touch, Real impulse)
{
  body.velocity += impulse / body.mass * touch.normal;
  body.omega += impulse / body.inertia * perpendicular(touch.point - body.position).dot(touch.normal);
}

void collide(std::vector<Body>& bodies, const Scene& scene)
{
  const std::vector<Touch> touches = touchesOf(bodies, scene.walls);
  const Touch& touch = touches.front();
  if (touches.size() > 1 && touches[1].gap < 1e-12L)
    throw std::runtime_error("reference: two impacts at one instant");
  Real approach = velocityAt(bodies[touch.a], touch.point).dot(touch.normal);
  Real give = mobility(bodies[touch.a], touch);
  if (touch.b != wall)
  {
    approach -= velocityAt(bodies[touch.b], touch.point).dot(touch.normal);
    give += mobility(bodies[touch.b], touch);
  }
  if (approach >= 0)
    throw std::runtime_error("reference: an overlap that is not approaching");
  const Real impulse = -(1 + static_cast<Real>(scene.elasticity)) * approach / give;
  push(bodies[touch.a], touch, impulse);
  if (touch.b != wall)
    push(bodies[touch.b], touch, -impulse);
}

/// The longest span found free of overlap, between one that is free and one that overlaps.
Real spanToImpact(const std::vector<Body>& bodies, const Walls& walls, Real free, Real overlap)
{
  for (int i = 0; i < 80; ++i)
  {
    const Real middle = (free + overlap) / 2;
    (overlapping(moved(bodies, middle), walls) ? overlap : free) = middle;
  }
  return free;
}

/// Moves on by a span from the instant of the last impact on: samples are taken from there, so that rounding does not
/// add up.
struct Flight
{
  std::vector<Body> bodies;  ///< at the last impact
  Real flown = 0;
};

/// Until `span` after the last impact, in samples of at most scan_step; true where an impact came before, which is done
/// then.
bool flyTo(Flight& flight, Real span, const Scene& scene, Real scan_step)
{
  while (flight.flown < span)
  {
    const Real next = std::min(flight.flown + scan_step, span);
    if (overlapping(moved(flight.bodies, next), scene.walls))
    {
      flight.flown = spanToImpact(flight.bodies, scene.walls, flight.flown, next);
      flight.bodies = moved(std::move(flight.bodies), flight.flown);
      collide(flight.bodies, scene);
      return true;
    }
    flight.flown = next;
  }
  return false;
}

}  // namespace

Path collisions(const Scene& scene, int frames, Real scan_step)
{
  Path path;
  Flight flight{ start(scene) };
  Real last_impact = 0;
  for (int frame = 0; frame <= frames; ++frame)
  {
    const Real time = frameTime(frame);
    while (flyTo(flight, time - last_impact, scene, scan_step))
    {
      last_impact += flight.flown;
      flight.flown = 0;
    }
    path.push_back(moved(flight.bodies, time - last_impact));
  }
  return path;
}

Path trustedCollisions(const Scene& scene, int frames)
{
  const Path path = collisions(scene, frames, 1.0L / 1000), other = collisions(scene, frames, 1.0L / 1700);
  for (std::size_t frame = 0; frame < path.size(); ++frame)
    if (cornerDistance(path[frame], other[frame]) > 1e-13L)
      throw std::runtime_error(scene.name + ": the reference depends on its scan step");
  return path;
}

}  // namespace block_world::speed
