#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "block_world/command.h"
#include "block_world/cost.h"
#include "block_world/scene.h"
#include "block_world/time.h"

namespace block_world
{
/// Pose of a body's centre of mass and its twist, world frame, SI. The angle is not wrapped.
struct MotionState
{
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double angle = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double omega = 0.0;
};

/// Energies in J and what changed them since the start of the account (load or reset).
/// The gravity energy is zero at the bottom wall if there is one, else at y = 0, measured at the centre of mass.
struct EnergyAccount
{
  double gravity = 0.0;
  double spring = 0.0;  ///< stored in all springs, the mouse's included
  double translational = 0.0;
  double rotational = 0.0;
  double total = 0.0;
  double thrust_work = 0.0;    ///< work of thrusters and wrenches
  double spring_work = 0.0;    ///< put in by adding, moving or removing a mouse spring
  double command_work = 0.0;   ///< jump by a set, set_state, spawn or delete
  double damping_loss = 0.0;   ///< taken by damping, dampers of springs included
  double impact_loss = 0.0;    ///< -1/2 sum j (w- + w+) over all impulses
  double balance_error = 0.0;  ///< total - initial total - thrust_work - spring_work - command_work + damping_loss + impact_loss
  double momentum_x = 0.0, momentum_y = 0.0;  ///< N s
  double angular_momentum = 0.0;              ///< N m s, about the world origin
};

enum class ContactKind
{
  Impact,
  RestBegin,
  RestEnd,
  Rest
};

/// One contact point at one instant. Bodies are indices of World; walls come after the blocks.
struct ContactEvent
{
  Time time;
  ContactKind kind = ContactKind::Impact;
  int a = 0, b = 0;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, from b to a
  double normal_velocity = 0.0;                      ///< m/s, (v_a - v_b).n before the impact; negative = approaching
  double impulse = 0.0;                              ///< N s; for Rest the force in N
};

/// A mouse or scene spring as it is now, for drawing.
struct SpringState
{
  int body = 0;
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  ///< world points
  bool mouse = false;
};

/// What the run has cost and shown so far.
struct Statistics
{
  std::int64_t events = 0;       ///< promises of the heap that came due
  std::int64_t impacts = 0;      ///< pairs hit
  double worst_overlap = 0.0;    ///< m, deepest overlap met at any event
  std::string mode = "exact";    ///< anything else says which island was not simulated exactly, and why
  bool stalled = false;          ///< time stands still: see World::stallAfter
};

/// Rigid convex blocks in the plane, simulated without a time step.
///
/// State is a set of exact arcs plus a heap of promises about when the arcs stop being true. advance() keeps the promises that come due; reading
/// states never changes the trajectory. Same scene and commands, same bits.
class World
{
public:
  /// The scene, set in motion at an instant: its timed inputs and its account count from there. Throws SceneError; the scene is
  /// completed first (completeScene).
  explicit World(Scene scene, const Time& start = Time());
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Simulated time that all reading functions refer to.
  Time now() const;

  /// Advances to target (not before now()), or until max_events promises have been kept (negative: no limit).
  /// Returns now(), which is earlier than target only where the limit was reached, or where the world stalled.
  Time advance(Time target, std::int64_t max_events = -1);

  /// A world stalls where a block takes part in as many events as this within 1e-12 s of simulated time, 100000 unless told otherwise: hits
  /// come at least a rounding of time apart, some 1e-16 s, so that no true course has as many. Then time stands still, statistics().mode tells
  /// where and why, and nothing is left out; a command that changes the course lets the world try again.
  void stallAfter(std::int64_t events);

  /// Applies a command at now(). A refused command changes nothing.
  Applied apply(const Command& command);
  /// What apply would answer, without doing it.
  Applied check(const Command& command) const;

  /// The scene with every set, spawn and delete merged, block states as at load.
  const Scene& scene() const;
  /// The scene that a reset brings back.
  const Scene& loaded() const;

  /// Blocks, movable and fixed, in scene order; spawned ones at the end.
  int bodyCount() const;
  const Block& block(int body) const;
  bool isFixed(int body) const;
  /// Name of a block or, from bodyCount() on, of a wall: wall_left, wall_right, wall_bottom, wall_top.
  const std::string& name(int body) const;
  /// Index of a block by name, -1 if there is none.
  int find(const std::string& name) const;

  MotionState state(int body) const;
  EnergyAccount energy() const;
  /// Impacts, rest begins and rest ends since last asked, in the order in which they happened.
  std::vector<ContactEvent> takeContacts();
  /// Whether contacts wait to be taken, as they do at first. Who never takes them lets them go, or else they pile up.
  void keepContacts(bool keep);
  /// Commands that the scene's timed inputs applied since last asked, with their times.
  std::vector<TimedCommand> takeInputs();
  /// The resting contacts that carry force now, with their forces.
  std::vector<ContactEvent> restingContacts() const;
  /// Deepest overlap of any two bodies now, in m; 0 where none overlap.
  double overlap() const;
  std::vector<SpringState> springs() const;
  /// Thrusters of a body and the level each has now.
  const std::vector<Thruster>& thrusters(int body) const;
  std::vector<double> thrustLevels(int body) const;
  /// FNV-1a over the raw bits of all states, of the forces in force, of the timed inputs to come and of all parameters that act on the motion.
  std::uint64_t stateHash() const;
  const Statistics& statistics() const;
  /// What was done with a block since the world was made; resets do not set it back. CostMeter tells where most of it is done.
  const Cost& cost(int body) const;
  /// The blocks that move as one with a block now, itself included: joined by touches that carry force or by springs. Ascending.
  std::vector<int> island(int body) const;

  /// The whole state as bytes, with a version and a checksum: what restore makes of it goes on bit for bit as this one does. Left out is what
  /// waits to be taken (takeContacts, takeInputs).
  std::string save() const;
  /// Later by whole seconds (which changes no bit of the motion) or, where negative, earlier. Throws std::runtime_error with the reason where
  /// the bytes are not what save gave.
  static World restore(const std::string& saved, std::int64_t seconds_later = 0);
  /// Notes from loading (completeScene).
  const std::vector<std::string>& notes() const;

private:
  class Engine;
  explicit World(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

}  // namespace block_world
