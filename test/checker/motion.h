#pragma once

#include <vector>

#include "scene.h"
#include "timeline.h"

namespace checker
{
/// Force at the centre of mass and torque about it, world frame.
struct Load
{
  Vec2 force = Vec2::Zero();
  double torque = 0.0;
};

/// Power of what changes the energy between events, in W; or work, in J.
struct Power
{
  double thrust = 0.0;   ///< put in by thrusters and wrenches
  double damping = 0.0;  ///< taken by damping and the dampers of springs
};

/// Of a body: its centre of mass and its turning.
struct Acceleration
{
  Vec2 linear = Vec2::Zero();
  double angular = 0.0;

  /// Acceleration of the point of the body that is now at a world point.
  Vec2 at(const Vec2& point, const State& state) const
  {
    const Vec2 arm = point - state.position;
    return linear + angular * Vec2(-arm.y(), arm.x()) - state.omega * state.omega * arm;
  }
};

/// Blocks that move together because scene springs tie them.
using Cluster = std::vector<int>;

/// The equations of motion of rigid bodies without contact, and their numerical solution.
class Motion
{
public:
  explicit Motion(const Scene& scene);

  /// Every movable block is in exactly one cluster.
  const std::vector<Cluster>& clusters() const
  {
    return clusters_;
  }
  /// -1 for a fixed block.
  int clusterOf(int body) const
  {
    return cluster_of_[body];
  }

  /// Applied loads of the bodies of a cluster, and their power. `states` holds all blocks.
  Power loads(int cluster, const Drive& drive, const std::vector<State>& states, std::vector<Load>& out) const;

  /// How fast that power changes where contact forces act as well: `total` holds all that acts on every block.
  Power powerRates(int cluster, const Drive& drive, const std::vector<State>& states, const std::vector<Load>& total) const;

  /// Moves a cluster on (or back) by a span without events. `held` (one per block) is added to the applied loads.
  Power advance(int cluster, const Drive& drive, const std::vector<Load>& held, double span,
                std::vector<State>& states) const;

  double inertia(const Drive& drive, int body) const
  {
    return drive.bodies[body].mass * scene_.blocks[body].shape.gyration;
  }

  /// Energies of all movable blocks as the energy file counts them; only the first five columns are set.
  double kinetic(const Drive& drive, int body, const State& state) const;
  double gravityEnergy(const Drive& drive, int body, const State& state) const;
  double sceneSpringEnergy(const std::vector<State>& states) const;
  double mouseSpringEnergy(const Drive& drive, const std::vector<State>& states) const;

private:
  bool onParabola(int cluster, const Drive& drive) const;
  void addSpring(const Spring& spring, const std::vector<State>& states, std::vector<Load>& out, Power& power) const;
  void addDrive(const Drive& drive, int body, const State& state, Load& load, Power& power) const;
  double driveRate(const Drive& drive, int body, const State& state, const Acceleration& acceleration) const;

  const Scene& scene_;
  std::vector<Cluster> clusters_;
  std::vector<int> cluster_of_;
  std::vector<std::vector<const Spring*>> springs_of_;  ///< of each cluster
};

}  // namespace checker
