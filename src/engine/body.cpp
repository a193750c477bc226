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

/// E(u) + s O(u) with u = s^2: values, first derivatives and halves of the second ones of E and O side by side, by Horner's scheme, which takes half
/// as long on each half of the orders.
struct Halves
{
  Vec2 value = Vec2::Zero(), slope = Vec2::Zero(), bend = Vec2::Zero();

  void take(const Vec2& next, double u)
  {
    bend = bend * u + slope;
    slope = slope * u + value;
    value = value * u + next;
  }
  double sum(double s) const
  {
    return value.x() + s * value.y();
  }
  /// Differentiated by s, with d/ds = 2 s d/du; and half of the second derivative.
  double rate(double s) const
  {
    return value.y() + 2.0 * s * (slope.x() + s * slope.y());
  }
  double curvature(double s) const
  {
    return slope.x() + s * (3.0 * slope.y() + 4.0 * s * (bend.x() + s * bend.y()));
  }
};

/// Values, first derivatives and halves of the second ones of an arc. Beyond parabolas, orders from 2 on are taken two at a time; the first two each
/// on its own, so that their sums are rounded once. What of it is not asked for is not computed, as this is inlined.
[[gnu::always_inline]] inline Snapshot motion(const Arc& arc, const Time& time)
{
  const double s = arc.degree > 0 ? time - arc.start : 0.0;
  Vec2 place = Vec2::Zero(), rate = Vec2::Zero(), bend = Vec2::Zero();
  double angle = 0.0, spin = 0.0, twist = 0.0;
  int n = arc.degree;
  if (n > 2)
  {
    const double u = s * s;
    Halves x, y, theta;
    for (n &= ~1; n >= 2; n -= 2)
    {
      x.take(two(arc.x, n), u);
      y.take(two(arc.y, n), u);
      theta.take(two(arc.angle, n), u);
    }
    place = Vec2(x.sum(s), y.sum(s));
    rate = Vec2(x.rate(s), y.rate(s));
    bend = Vec2(x.curvature(s), y.curvature(s));
    angle = theta.sum(s);
    spin = theta.rate(s);
    twist = theta.curvature(s);
    n = 1;
  }
  for (; n >= 0; --n)
  {
    bend = bend * s + rate;
    twist = twist * s + spin;
    rate = rate * s + place;
    spin = spin * s + angle;
    place = place * s + Vec2(arc.x[n], arc.y[n]);
    angle = angle * s + arc.angle[n];
  }
  Snapshot now;
  now.position = place;
  now.angle = angle;
  now.velocity = rate;
  now.omega = spin;
  now.acceleration = 2.0 * bend;
  now.alpha = 2.0 * twist;
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
