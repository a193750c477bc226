#include "body.h"

namespace block_world
{
namespace
{
/// Values, first derivatives and halves of the second ones in one pass of Horner's scheme; x and y side by side. What of it is not asked for is not
/// computed, as this is inlined.
inline Snapshot motion(const Arc& arc, const Time& time)
{
  const double s = arc.degree > 0 ? time - arc.start : 0.0;
  Vec2 place = Vec2::Zero(), rate = Vec2::Zero(), bend = Vec2::Zero();
  double angle = 0.0, spin = 0.0, twist = 0.0;
  for (int n = arc.degree; n >= 0; --n)
  {
    bend = bend * s + rate;
    twist = twist * s + spin;
    rate = rate * s + place;
    spin = spin * s + angle;
    place = place * s + arc.order[n].place();
    angle = angle * s + arc.order[n].angle;
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
