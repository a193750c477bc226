#pragma once

#include <Eigen/Core>

#include <vector>

#include "block_world/scene.h"

/// Where blocks truly are: mathematics in long double that shares no code with any engine.
namespace reference
{
using Real = long double;
using Vector = Eigen::Matrix<Real, 2, 1>;

struct Body
{
  Real mass = 1, inertia = 1;
  Vector half = Vector::Zero();  ///< half width, half height
  Vector position = Vector::Zero(), velocity = Vector::Zero();
  Real angle = 0, omega = 0;
};

/// The movable blocks of a completed scene, as they start. Rectangles only.
std::vector<Body> start(const block_world::Scene& scene);

/// World position of corner 0..3 (counter-clockwise from the lower left).
Vector corner(const Body& body, int index);

/// Flight under gravity and damping, without contacts: closed form.
std::vector<Body> flight(const block_world::Scene& scene, Real time);

/// Undamped force-free flight between the walls with single elastic impacts: samples every scan_step, bisects to the
/// impact. Throws std::runtime_error where two impacts coincide.
std::vector<Body> collisions(const block_world::Scene& scene, Real time, Real scan_step);

}  // namespace reference
