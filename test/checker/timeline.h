#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "scene.h"

namespace checker
{
/// Force -k d - c d' on a point of a block, d from the anchor to the point.
struct MouseSpring
{
  Vec2 point, anchor;
  double stiffness = 0.0, damping = 0.0, until = std::numeric_limits<double>::infinity();
};

/// Everything outside the bodies that decides their motion, constant between two changes.
struct Drive
{
  struct Body
  {
    double mass = 1.0;
    std::vector<double> levels;  ///< empty: thrusters off
    double thrust_until = std::numeric_limits<double>::infinity();
    Vec2 force = Vec2::Zero();  ///< of the wrench, body axes
    double torque = 0.0;
    std::optional<MouseSpring> spring;
  };
  double gravity = 0.0, elasticity = 1.0, damping = 0.0, thrust = 0.0;
  std::vector<Body> bodies;
};

/// The drive from a time on.
struct Change
{
  double time = 0.0;
  Drive after;
};

/// The timed inputs of a scene worked out: what is in force when, durations that run out included.
class Timeline
{
public:
  explicit Timeline(const Scene& scene);

  /// The drive at a time, what changes at that very time included.
  const Drive& at(double time) const;

  /// In the order of their times. The first one is the start.
  const std::vector<Change>& changes() const
  {
    return changes_;
  }

  /// Index of the first change later than a time.
  size_t firstAfter(double time) const;

private:
  void expireUntil(double time);
  void record(double time);
  void apply(const Scene& scene, const Input& input);

  Drive now_;
  std::vector<Change> changes_;
};

/// Smaller of the two elasticities: a block's own, else the scene's of the moment.
double elasticity(const Scene& scene, const Drive& drive, int a, int b);

}  // namespace checker
