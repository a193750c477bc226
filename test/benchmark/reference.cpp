#include "reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reference
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

void addWalls(const std::vector<Body>& bodies, const block_world::Walls& walls, int body, std::vector<Touch>& touches)
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
std::vector<Touch> touchesOf(const std::vector<Body>& bodies, const block_world::Walls& walls)
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

bool overlapping(const std::vector<Body>& bodies, const block_world::Walls& walls)
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

void collide(std::vector<Body>& bodies, const block_world::Scene& scene)
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
Real spanToImpact(const std::vector<Body>& bodies, const block_world::Walls& walls, Real free, Real overlap)
{
  for (int i = 0; i < 80; ++i)
  {
    const Real middle = (free + overlap) / 2;
    (overlapping(moved(bodies, middle), walls) ? overlap : free) = middle;
  }
  return free;
}

}  // namespace

std::vector<Body> start(const block_world::Scene& scene)
{
  std::vector<Body> bodies;
  for (const block_world::Block& block : scene.blocks)
  {
    if (!block.size || block.fixed)
      throw std::runtime_error("reference: only movable rectangles");
    Body body;
    body.mass = block.mass;
    body.half = block.size->cast<Real>() / 2;
    body.inertia = body.mass * body.half.squaredNorm() / 3;
    body.position = block.position.cast<Real>();
    body.velocity = block.velocity.cast<Real>();
    body.angle = block.angle;
    body.omega = block.omega;
    bodies.push_back(body);
  }
  return bodies;
}

Vector corner(const Body& body, int index)
{
  const Real x = index == 0 || index == 3 ? -1 : 1, y = index < 2 ? -1 : 1;
  return body.position + rotate(body.half.cwiseProduct(Vector(x, y)), body.angle);
}

std::vector<Body> flight(const block_world::Scene& scene, Real time)
{
  std::vector<Body> bodies = start(scene);
  const Vector gravity(0, -static_cast<Real>(scene.gravity));
  for (Body& body : bodies)
  {
    // v' = gravity - k v and omega' = -l omega, with final velocity gravity / k
    const Real k = static_cast<Real>(scene.damping) / body.mass;
    const Real l = static_cast<Real>(scene.damping) * static_cast<Real>(scene.rotational_damping_ratio) / body.inertia;
    const Vector final_velocity = gravity / k;
    const Vector excess = body.velocity - final_velocity;
    body.position += final_velocity * time - excess * std::expm1(-k * time) / k;
    body.velocity = final_velocity + excess * std::exp(-k * time);
    body.angle -= body.omega * std::expm1(-l * time) / l;
    body.omega *= std::exp(-l * time);
  }
  return bodies;
}

std::vector<Body> collisions(const block_world::Scene& scene, Real time, Real scan_step)
{
  // Every sample is taken from the last impact, so that rounding does not add up.
  std::vector<Body> bodies = start(scene);
  Real left = time, flown = 0;
  while (flown < left)
  {
    const Real next = std::min(flown + scan_step, left);
    if (overlapping(moved(bodies, next), scene.walls))
    {
      const Real span = spanToImpact(bodies, scene.walls, flown, next);
      bodies = moved(std::move(bodies), span);
      collide(bodies, scene);
      left -= span;
      flown = 0;
    }
    else
      flown = next;
  }
  return moved(std::move(bodies), left);
}

}  // namespace reference
