#pragma once

#include <Eigen/Core>

#include <vector>

#include "block_world/scene.h"

/// Where blocks truly are: mathematics in long double that shares no code with any engine. Rectangles only.
namespace block_world::speed
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
using Bodies = std::vector<Body>;

/// All blocks at every frame, the first at the start.
using Path = std::vector<Bodies>;

Real frameTime(int frame);

/// The blocks of a completed scene as they start.
Bodies start(const Scene& scene);

/// World position of corner 0..3 (counter-clockwise from the lower left).
Vector corner(const Body& body, int index);

/// Largest distance of a corner from the same corner.
Real cornerDistance(const Bodies& a, const Bodies& b);

// ---------------------------------------------------------------- closed forms

/// Under gravity and damping, without contacts.
Path flight(const Scene& scene, int frames);

/// Upright blocks that fall from rest on the floor and bounce, with less and less height, up to their rest.
Path bounces(const Scene& scene, int frames);

/// Nothing moves.
Path rest(const Scene& scene, int frames);

/// A row of equal blocks that touch, of which the first `strikers` move alike: as many at the other end take over at
/// once.
Path cradle(const Scene& scene, int frames, int strikers);

// ---------------------------------------------------------------- found by search

/// Undamped force-free flight between the walls with single impacts: samples every scan_step, bisects to the impact.
/// Throws std::runtime_error where two impacts coincide.
Path collisions(const Scene& scene, int frames, Real scan_step);
/// The same by two scan steps, which must agree to 1e-13 m.
Path trustedCollisions(const Scene& scene, int frames);

// ---------------------------------------------------------------- integrated, with so many steps a frame

/// A block that falls from rest, leaning on its lower left corner, which slides. Ends before it falls flat.
Path fallingRod(const Scene& scene, int frames, int steps);

/// A block that falls from rest, its lower long side's corners on the left wall and on the floor: slides down, leaves
/// the wall, slides on. Ends before it falls flat.
Path ladder(const Scene& scene, int frames, int steps);

/// A block on a spring to a point of the world.
Path springBlock(const Scene& scene, int frames, int steps);

}  // namespace block_world::speed
