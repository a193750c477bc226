#pragma once

#include <array>
#include <memory>
#include <vector>

#include "block_world/block.h"
#include "block_world/time.h"
#include "block_world/world.h"
#include "geometry.h"
#include "room.h"
#include "series.h"

namespace block_world
{
/// Coefficients of one power of time.
struct Coefficients
{
  double x = 0.0, y = 0.0, angle = 0.0;

  Vec2 place() const
  {
    return Vec2(x, y);
  }
  bool isZero() const
  {
    return x == 0.0 && y == 0.0 && angle == 0.0;
  }
};

/// Exact motion of one body from `start` on: three polynomials in s = t - start, as true as rounding up to `horizon`. Order by order in memory, of
/// which parabolas take the first three.
struct Arc
{
  Time start;
  Time end = Time::infinity();                               ///< start + horizon
  double horizon = std::numeric_limits<double>::infinity();  ///< s
  /// Bounds of the third derivatives over the horizon (m/s^3, rad/s^3); 0 for parabolas.
  double jerk = 0.0, angular_jerk = 0.0;
  int degree = 0;
  std::array<Coefficients, kOrder + 1> order;

  /// One of the three polynomials.
  Series series(double Coefficients::*which) const
  {
    Series c;
    for (int n = 0; n <= kOrder; ++n)
      c[n] = order[n].*which;
    return c;
  }
};

/// A body's motion at one instant, with its accelerations.
struct Snapshot : MotionState
{
  Vec2 acceleration = Vec2::Zero();
  double alpha = 0.0;
};

/// A zero-length spring held by the user: force -k d - c d', d from the anchor to the attachment.
struct MouseSpring
{
  bool active = false;
  Vec2 attach = Vec2::Zero(), anchor = Vec2::Zero();
  double stiffness = 0.0, damping = 0.0;
  Time until = Time::infinity();
};

/// A block, or a wall (a half-plane without vertices), with everything that acts on it. First what any look at it needs, after its arc what an event
/// does: in a crowd, memory takes longer than arithmetic.
struct alignas(kCacheLine) Body
{
  std::shared_ptr<const Polygon> shape;  ///< of all bodies that look alike
  bool fixed = true;
  int island = -1;      ///< lowest index among the bodies that move as one with this one
  int first_pair = -1;  ///< of the list of pairs that this body is one of
  int crowd = 0;        ///< to notice time standing still: events since crowd_start
  Cost cost;
  Arc arc;
  double inverse_mass = 0.0, inverse_inertia = 0.0;  ///< 0 for what cannot move
  Vec2 push = Vec2::Zero();                          ///< thrusters and wrench together, body axes
  double twist = 0.0;                                ///< and their torque
  std::vector<int> springs;                          ///< scene springs with an end on this body
  double elasticity = 1.0;
  MouseSpring mouse;

  std::string name;
  double mass = 0.0, inertia = 0.0;
  Time crowd_start;
  Cost crowd_cost;  ///< then

  std::vector<Thruster> thrusters;
  std::vector<double> levels;
  Time thrust_until = Time::infinity();
  Vec2 wrench_force = Vec2::Zero();  ///< body axes
  double wrench_torque = 0.0;

  bool pushed() const
  {
    return push.x() != 0.0 || push.y() != 0.0 || twist != 0.0;
  }
  bool sprung() const
  {
    return mouse.active || !springs.empty();
  }
  Snapshot at(const Time& time) const;
  MotionState stateAt(const Time& time) const;
};

/// A scene spring between two bodies by index; second < 0: to_point is a world point.
struct SpringLink
{
  int first = 0, second = -1;
  Vec2 first_point = Vec2::Zero(), second_point = Vec2::Zero();
  double stiffness = 0.0, rest_length = 0.0, damping = 0.0;
};

/// What acts on every body alike.
struct Field
{
  double gravity = 0.0;             ///< m/s^2 along -y
  double damping = 0.0;             ///< N s/m
  double rotational_damping = 0.0;  ///< N m s: damping times its rotational ratio
};

}  // namespace block_world
