#include "body.h"

namespace block_world
{
Snapshot Body::at(const Time& time) const
{
  Snapshot now;
  const double s = arc.degree > 0 ? time - arc.start : 0.0;
  if (arc.degree <= 2)
  {
    now.position = Vec2(arc.x[0] + s * (arc.x[1] + s * arc.x[2]), arc.y[0] + s * (arc.y[1] + s * arc.y[2]));
    now.angle = arc.angle[0] + s * (arc.angle[1] + s * arc.angle[2]);
    now.velocity = Vec2(arc.x[1] + 2.0 * s * arc.x[2], arc.y[1] + 2.0 * s * arc.y[2]);
    now.omega = arc.angle[1] + 2.0 * s * arc.angle[2];
    now.acceleration = Vec2(2.0 * arc.x[2], 2.0 * arc.y[2]);
    now.alpha = 2.0 * arc.angle[2];
    return now;
  }
  const int n = arc.degree;
  now.position = Vec2(evaluate(arc.x, n, s), evaluate(arc.y, n, s));
  now.angle = evaluate(arc.angle, n, s);
  now.velocity = Vec2(evaluateDerivative(arc.x, n, s), evaluateDerivative(arc.y, n, s));
  now.omega = evaluateDerivative(arc.angle, n, s);
  now.acceleration = Vec2(evaluateSecondDerivative(arc.x, n, s), evaluateSecondDerivative(arc.y, n, s));
  now.alpha = evaluateSecondDerivative(arc.angle, n, s);
  return now;
}

MotionState Body::stateAt(const Time& time) const
{
  const double s = arc.degree > 0 ? time - arc.start : 0.0;
  const int n = arc.degree;
  MotionState state;
  state.position = Vec2(evaluate(arc.x, n, s), evaluate(arc.y, n, s));
  state.angle = evaluate(arc.angle, n, s);
  state.velocity = Vec2(evaluateDerivative(arc.x, n, s), evaluateDerivative(arc.y, n, s));
  state.omega = evaluateDerivative(arc.angle, n, s);
  return state;
}

}  // namespace block_world
