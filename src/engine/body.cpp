#include "body.h"

namespace block_world
{
namespace
{
/// Coefficients n and n + 1.
inline Vec2 two(const Series& c, int n)
{
  return Vec2(c[n], c[n + 1]);
}

/// A polynomial as E(u) + s O(u) with u = s^2: value, first derivative and half of the second one of E and O side by side, by Horner's scheme, which
/// takes half as long on each half of the orders.
struct Halves
{
  Vec2 value = Vec2::Zero(), slope = Vec2::Zero(), bend = Vec2::Zero();

  void take(const Vec2& next, double u)
  {
    bend = bend * u + slope;
    slope = slope * u + value;
    value = value * u + next;
  }
  double at(double s) const
  {
    return value.x() + s * value.y();
  }
  /// E + s O differentiated once and twice by s, with d/ds = 2 s d/du.
  double rate(double s) const
  {
    return value.y() + 2.0 * s * (slope.x() + s * slope.y());
  }
  double acceleration(double s) const
  {
    return 2.0 * slope.x() + s * (6.0 * slope.y() + 8.0 * s * (bend.x() + s * bend.y()));
  }
};

/// What of it is not asked for is not computed, as this is inlined.
inline Snapshot motion(const Arc& arc, const Time& time)
{
  const double s = arc.degree > 0 ? time - arc.start : 0.0, u = s * s;
  Halves x, y, angle;
  for (int n = arc.degree & ~1; n >= 0; n -= 2)
  {
    x.take(two(arc.x, n), u);
    y.take(two(arc.y, n), u);
    angle.take(two(arc.angle, n), u);
  }
  Snapshot now;
  now.position = Vec2(x.at(s), y.at(s));
  now.angle = angle.at(s);
  now.velocity = Vec2(x.rate(s), y.rate(s));
  now.omega = angle.rate(s);
  now.acceleration = Vec2(x.acceleration(s), y.acceleration(s));
  now.alpha = angle.acceleration(s);
  return now;
}
}  // namespace

Snapshot Body::at(const Time& time) const
{
  return motion(arc, time);
}

MotionState Body::stateAt(const Time& time) const
{
  return motion(arc, time);
}

}  // namespace block_world
