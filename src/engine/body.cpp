#include "body.h"

namespace block_world
{
namespace
{
/// A polynomial of every second order, in u = s^2, and its derivatives, by Horner's scheme: value, first derivative, half of the second one. The even
/// orders E and the odd ones O make E(u) + s O(u); neither waits for the other.
struct Half
{
  Vec2 value = Vec2::Zero(), slope = Vec2::Zero(), bend = Vec2::Zero();

  void take(const Vec2& next, double u)
  {
    bend = bend * u + slope;
    slope = slope * u + value;
    value = value * u + next;
  }
};

/// The first derivative by s, with d/ds = 2 s d/du.
template <class T>
T rate(const T& odd_value, const T& even_slope, const T& odd_slope, double s)
{
  return odd_value + 2.0 * s * (even_slope + s * odd_slope);
}

/// Half of the second one.
template <class T>
T curvature(const T& even_slope, const T& odd_slope, const T& even_bend, const T& odd_bend, double s)
{
  return even_slope + s * (3.0 * odd_slope + 4.0 * s * (even_bend + s * odd_bend));
}

/// Values, first derivatives and halves of the second ones of an arc, order by order from above.
struct Motion
{
  Vec2 place = Vec2::Zero(), velocity = Vec2::Zero(), bend = Vec2::Zero();
  double angle = 0.0, spin = 0.0, twist = 0.0;

  void take(const Coefficients& next, double s)
  {
    bend = bend * s + velocity;
    twist = twist * s + spin;
    velocity = velocity * s + place;
    spin = spin * s + angle;
    place = place * s + next.place();
    angle = angle * s + next.angle;
  }
};

/// Of the orders from 2 on, two at a time, both of the angle side by side.
[[gnu::always_inline]] inline Motion higherOrders(const Arc& arc, double s)
{
  const double u = s * s;
  Half even, odd, turn;
  for (int n = arc.degree & ~1; n >= 2; n -= 2)
  {
    const Coefficients &c = arc.order[n], &d = arc.order[n + 1];
    even.take(c.place(), u);
    odd.take(d.place(), u);
    turn.take(Vec2(c.angle, d.angle), u);
  }
  Motion m;
  m.place = even.value + s * odd.value;
  m.velocity = rate<Vec2>(odd.value, even.slope, odd.slope, s);
  m.bend = curvature<Vec2>(even.slope, odd.slope, even.bend, odd.bend, s);
  m.angle = turn.value.x() + s * turn.value.y();
  m.spin = rate(turn.value.y(), turn.slope.x(), turn.slope.y(), s);
  m.twist = curvature(turn.slope.x(), turn.slope.y(), turn.bend.x(), turn.bend.y(), s);
  return m;
}

/// The first two orders each on its own, so that their sums are rounded once; where they are all, what follows is zero. What of it is not asked for is
/// not computed, as this is inlined.
[[gnu::always_inline]] inline Snapshot motion(const Arc& arc, const Time& time)
{
  const double s = arc.degree > 0 ? time - arc.start : 0.0;
  Motion m;
  if (arc.degree > 2)
    m = higherOrders(arc, s);
  else
  {
    m.place = arc.order[2].place();
    m.angle = arc.order[2].angle;
  }
  m.take(arc.order[1], s);
  m.take(arc.order[0], s);
  Snapshot now;
  now.position = m.place;
  now.angle = m.angle;
  now.velocity = m.velocity;
  now.omega = m.spin;
  now.acceleration = 2.0 * m.bend;
  now.alpha = 2.0 * m.twist;
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
