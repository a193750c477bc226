#include "body.h"

namespace block_world
{
namespace
{
/// Value, first and half the second derivative of x, y and the angle in one pass of Horner's scheme; x and y side by side.
struct Horner
{
  Vec2 place = Vec2::Zero(), rate = Vec2::Zero(), bend = Vec2::Zero();
  double angle = 0.0, spin = 0.0, twist = 0.0;

  /// What of it is not asked for is not computed: this is inlined.
  Horner(const Arc& arc, double s)
  {
    for (int n = arc.degree; n >= 0; --n)
    {
      bend = bend * s + rate;
      twist = twist * s + spin;
      rate = rate * s + place;
      spin = spin * s + angle;
      place = place * s + Vec2(arc.x[n], arc.y[n]);
      angle = angle * s + arc.angle[n];
    }
  }
};
}  // namespace

Snapshot Body::at(const Time& time) const
{
  const Horner now(arc, arc.degree > 0 ? time - arc.start : 0.0);
  Snapshot snapshot;
  snapshot.position = now.place;
  snapshot.angle = now.angle;
  snapshot.velocity = now.rate;
  snapshot.omega = now.spin;
  snapshot.acceleration = 2.0 * now.bend;
  snapshot.alpha = 2.0 * now.twist;
  return snapshot;
}

MotionState Body::stateAt(const Time& time) const
{
  const Horner now(arc, arc.degree > 0 ? time - arc.start : 0.0);
  MotionState state;
  state.position = now.place;
  state.angle = now.angle;
  state.velocity = now.rate;
  state.omega = now.spin;
  return state;
}

}  // namespace block_world
