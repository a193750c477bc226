#include <cmath>

#include "engine.h"
#include "integrate.h"
#include "reference.h"

namespace block_world::speed
{
namespace
{
/// An angle and its rate.
using Swing = Vector;

/// An inclined block that falls flat has an impact: there a path ends.
constexpr Real flat = 0.02L;

/// Its centre falls straight down, at height R sin b, with R the distance of the corner and b the angle of the line
/// from it to the centre: (I/m + R^2 cos^2 b) b'' = R^2 cos b sin b b'^2 - g R cos b.
struct Rod
{
  Real gyration, distance, gravity;

  Swing operator()(const Swing& at) const
  {
    const Real c = distance * std::cos(at.x()), s = distance * std::sin(at.x());
    return { at.y(), (c * s * at.y() * at.y() - gravity * c) / (gyration + c * c) };
  }
};

/// Of half length p and half thickness h, at the angle a to the floor: its centre is at height y = p sin a + h cos a,
/// and at x = p cos a + h sin a while it touches the wall.
struct Ladder
{
  Real p, h, gyration, gravity;

  Real x(Real a) const
  {
    return p * std::cos(a) + h * std::sin(a);
  }
  Real dx(Real a) const
  {
    return -p * std::sin(a) + h * std::cos(a);
  }
  Real y(Real a) const
  {
    return p * std::sin(a) + h * std::cos(a);
  }
  Real dy(Real a) const
  {
    return p * std::cos(a) - h * std::sin(a);
  }
  /// On wall and floor: (I/m + p^2 + h^2 - 2 p h sin 2a) a'' = 2 p h cos 2a a'^2 - g dy/da.
  Swing onWall(const Swing& at) const
  {
    const Real a = at.x();
    const Real give = gyration + p * p + h * h - 2 * p * h * std::sin(2 * a);
    return { at.y(), (2 * p * h * std::cos(2 * a) * at.y() * at.y() - gravity * dy(a)) / give };
  }
  /// What the wall's force is to the mass.
  Real pushOfWall(const Swing& at) const
  {
    return dx(at.x()) * onWall(at).y() - x(at.x()) * at.y() * at.y();
  }
  /// On the floor alone: (I/m + (dy/da)^2) a'' = dy/da y a'^2 - g dy/da, as d2y/da2 = -y.
  Swing onFloor(const Swing& at) const
  {
    const Real a = at.x(), slope = dy(a);
    return { at.y(), (slope * y(a) * at.y() * at.y() - gravity * slope) / (gyration + slope * slope) };
  }
};

/// The longest span after which the wall still pushes.
Real spanOnWall(const Ladder& ladder, const Swing& from, Real longest, int steps)
{
  const auto slope = [&](const Swing& at) { return ladder.onWall(at); };
  Real pushed = 0, free = longest;
  for (int i = 0; i < 70; ++i)
  {
    const Real middle = (pushed + free) / 2;
    (ladder.pushOfWall(integrate(slope, from, middle, steps)) > 0 ? pushed : free) = middle;
  }
  return pushed;
}

/// x, y, angle and their rates.
using Free = Eigen::Matrix<Real, 6, 1>;

struct OnSpring
{
  Body body;
  Vector point, anchor;
  Real stiffness, rest, damping, gravity;

  Free operator()(const Free& at) const
  {
    const Real c = std::cos(at(2)), s = std::sin(at(2));
    const Vector arm(c * point.x() - s * point.y(), s * point.x() + c * point.y());
    const Vector d = at.head<2>() + arm - anchor;
    const Vector rate = at.segment<2>(3) + at(5) * Vector(-arm.y(), arm.x());
    const Vector along = d / d.norm();
    const Vector force = -(stiffness * (d.norm() - rest) + damping * along.dot(rate)) * along;
    Free slope;
    slope << at.tail<3>(), force / body.mass - Vector(0, gravity),
        (arm.x() * force.y() - arm.y() * force.x()) / body.inertia;
    return slope;
  }
};

}  // namespace

Path fallingRod(const Scene& scene, int frames, int steps)
{
  const Body at_start = start(scene).front();
  const Real lean = std::atan2(at_start.half.y(), at_start.half.x());
  const Rod rod{ at_start.inertia / at_start.mass, at_start.half.norm(), scene.gravity };
  Path path;
  Swing now(at_start.angle + lean, 0);
  for (int frame = 0; frame <= frames; ++frame)
  {
    if (frame > 0)
      now = integrate(rod, now, frameTime(1), steps);
    Body body = at_start;
    body.angle = now.x() - lean;
    if (body.angle < flat)
      break;
    body.omega = now.y();
    body.position.y() = static_cast<Real>(*scene.walls.bottom) + rod.distance * std::sin(now.x());
    body.velocity.y() = rod.distance * std::cos(now.x()) * now.y();
    path.push_back({ body });
  }
  return path;
}

Path ladder(const Scene& scene, int frames, int steps)
{
  const Body at_start = start(scene).front();
  const Ladder ladder{ at_start.half.x(), at_start.half.y(), at_start.inertia / at_start.mass, scene.gravity };
  const auto on_wall = [&](const Swing& at) { return ladder.onWall(at); };
  const auto on_floor = [&](const Swing& at) { return ladder.onFloor(at); };
  Path path;
  Swing now(-at_start.angle, 0);
  bool at_wall = true;
  Real x = ladder.x(now.x()), vx = 0;
  for (int frame = 0; frame <= frames; ++frame)
  {
    if (frame > 0)
    {
      Real left = frameTime(1);
      if (at_wall)
      {
        const Swing next = integrate(on_wall, now, left, steps);
        at_wall = ladder.pushOfWall(next) > 0;
        const Real span = at_wall ? left : spanOnWall(ladder, now, left, steps);
        now = integrate(on_wall, now, span, steps);
        left -= span;
        x = ladder.x(now.x());
        vx = ladder.dx(now.x()) * now.y();
      }
      now = integrate(on_floor, now, left, steps);
      x += vx * left;
    }
    if (now.x() < flat)
      break;
    Body body = at_start;
    body.angle = -now.x();
    body.omega = -now.y();
    body.position = { static_cast<Real>(*scene.walls.left) + x,
                      static_cast<Real>(*scene.walls.bottom) + ladder.y(now.x()) };
    body.velocity = { vx, ladder.dy(now.x()) * now.y() };
    path.push_back({ body });
  }
  return path;
}

Path springBlock(const Scene& scene, int frames, int steps)
{
  const Body at_start = start(scene).front();
  const Spring& spring = scene.springs.front();
  const OnSpring slope{ at_start,
                        spring.from_point.cast<Real>(),
                        spring.to_point.cast<Real>(),
                        spring.stiffness,
                        spring.rest_length,
                        spring.damping,
                        scene.gravity };
  Free now;
  now << at_start.position, at_start.angle, at_start.velocity, at_start.omega;
  Path path;
  for (int frame = 0; frame <= frames; ++frame)
  {
    if (frame > 0)
      now = integrate(slope, now, frameTime(1), steps);
    Body body = at_start;
    body.position = now.head<2>();
    body.angle = now(2);
    body.velocity = now.segment<2>(3);
    body.omega = now(5);
    path.push_back({ body });
  }
  return path;
}

}  // namespace block_world::speed
