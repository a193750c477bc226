#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene.h"

namespace checker
{
// Where the limits come from. The files carry 17 digits, which is every bit of a double, so a number read is the number
// meant; what remains is the rounding of one sample interval: a few dozen additions and the integrator's 1e-16 here,
// the same there, and the 1e-14 of the position scale to which motion is worth expanding. Two orders above that stay
// out of the way of chance and still four to nine orders below any error in the physics.
constexpr double relative_error = 1e-12;

/// Event times are doubles: nothing is known between two neighbours.
inline double timeResolution(double time)
{
  return 2.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(time));
}

/// How far a body's state may be from what it should be.
struct Limits
{
  double position = 0.0, angle = 0.0, velocity = 0.0, omega = 0.0;
};

inline Limits stateLimits(const State& state, double radius, double time)
{
  const double late = timeResolution(time);
  const double speed = state.velocity.norm() + radius * std::abs(state.omega);
  Limits limits;
  limits.position = relative_error * std::max(1.0, state.position.norm()) + late * speed;
  limits.angle = relative_error * std::max(1.0, std::abs(state.angle)) + late * std::abs(state.omega);
  limits.velocity = relative_error * std::max(1.0, speed);
  limits.omega = relative_error * std::max({ 1.0, std::abs(state.omega), speed / radius });
  return limits;
}

}  // namespace checker
