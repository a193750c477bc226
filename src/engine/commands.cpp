// What is asked of the world while it runs: checked as a whole, then done.

#include <algorithm>
#include <cmath>

#include "engine.h"

namespace block_world
{
namespace
{
bool finite(const Vec2& v)
{
  return std::isfinite(v.x()) && std::isfinite(v.y());
}

bool negativeOrNotFinite(double value)
{
  return !(value >= 0.0) || std::isinf(value);
}
}  // namespace

void World::Engine::pickNearest(SpringCommand& command, const Time& time) const
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < block_count; ++i)
  {
    if (bodies[i].fixed)
      continue;
    const Snapshot now_i = bodies[i].at(time);
    const Frame frame_i(now_i.position, now_i.angle);
    const Vec2 target = frame_i.toBody(command.anchor);
    const Vec2 point = nearestPoint(*bodies[i].shape, target);
    const double distance = (point - target).norm();
    if (distance < least)
    {
      least = distance;
      command.body = bodies[i].name;
      command.attach = point;
    }
  }
}

/// Whether a body at a frame would overlap any other by the tolerance or more.
bool World::Engine::overlaps(int body, const Frame& at, const Time& time, std::string& with) const
{
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    if (static_cast<int>(i) == body)
      continue;
    const Snapshot other = bodies[i].at(time);
    if (separation(*bodies[body].shape, at, *bodies[i].shape, Frame(other.position, other.angle)) <= -scene.tolerance)
    {
      with = bodies[i].name;
      return true;
    }
  }
  return false;
}

Applied World::Engine::apply(const Command& command)
{
  return applyAt(command, now);
}

Applied World::Engine::check(const Command& command)
{
  return applyAt(command, now, true);
}

/// One overload a command; each checks everything before it changes anything.
struct World::Engine::Handler
{
  Engine& engine;
  Time time;
  bool check_only;
  Applied result;

  void refuse(const std::string& reason)
  {
    result.reason = reason;
  }

  /// Every check passed; whether to go on and do it.
  bool accept()
  {
    result.ok = true;
    return !check_only;
  }

  /// Index of a movable block; -1 after a refusal.
  int movable(const std::string& name)
  {
    for (int i = 0; i < engine.block_count; ++i)
      if (engine.bodies[i].name == name)
      {
        if (!engine.bodies[i].fixed)
          return i;
        refuse("body: '" + name + "' is fixed");
        return -1;
      }
    refuse("body: there is no block '" + name + "'");
    return -1;
  }

  void operator()(const ThrustCommand& c)
  {
    const int i = movable(c.body);
    if (i < 0)
      return;
    Body& body = engine.bodies[i];
    if (c.levels.size() != body.thrusters.size())
      return refuse("levels: '" + c.body + "' has " + std::to_string(body.thrusters.size()) + " thrusters, not " +
                    std::to_string(c.levels.size()));
    for (std::size_t k = 0; k < c.levels.size(); ++k)
      if (!(c.levels[k] >= 0.0 && c.levels[k] <= 1.0))
        return refuse("levels[" + std::to_string(k) + "]: not within 0..1");
    if (negativeOrNotFinite(c.duration))
      return refuse("duration: negative or not finite");
    if (!accept())
      return;
    engine.closeIsland(i, time);
    body.levels = c.levels;
    if (c.duration == 0.0)
      body.levels.assign(body.thrusters.size(), 0.0);
    const bool any = std::any_of(body.levels.begin(), body.levels.end(), [](double level) { return level > 0.0; });
    body.thrust_until = any ? time + c.duration : Time::infinity();
    engine.refreshPush(body);
    engine.wake(i, time);
  }

  void operator()(SpringCommand c)
  {
    if (!c.active)
    {
      if (!c.body.empty() && movable(c.body) < 0)
        return;
      if (!accept())
        return;
      for (int i = 0; i < engine.block_count; ++i)
      {
        Body& body = engine.bodies[i];
        if (!body.mouse.active || !(c.body.empty() || c.body == body.name))
          continue;
        engine.closeIsland(i, time);
        engine.release(body, time);
        engine.wake(i, time);
      }
      return;
    }
    if (!finite(c.anchor))
      return refuse("anchor: not finite");
    if (!finite(c.attach))
      return refuse("attach: not finite");
    if (negativeOrNotFinite(c.stiffness))
      return refuse("stiffness: negative or not finite");
    if (negativeOrNotFinite(c.damping))
      return refuse("damping: negative or not finite");
    if (negativeOrNotFinite(c.duration))
      return refuse("duration: negative or not finite");
    if (c.body.empty())
    {
      engine.pickNearest(c, time);
      if (c.body.empty())
        return refuse("body: the scene has no movable block");
      result.command = c;
    }
    const int i = movable(c.body);
    if (i < 0)
      return;
    if (!accept())
      return;
    Body& body = engine.bodies[i];
    engine.closeIsland(i, time);
    engine.release(body, time);
    body.mouse.active = true;
    body.mouse.attach = c.attach;
    body.mouse.anchor = c.anchor;
    body.mouse.stiffness = c.stiffness;
    body.mouse.damping = c.damping;
    body.mouse.until = c.duration > 0.0 ? time + c.duration : Time::infinity();
    engine.refreshDissipative();
    engine.spring_work_ += engine.mouseEnergy(body, time);
    engine.wake(i, time);
  }

  void operator()(const WrenchCommand& c)
  {
    const int i = movable(c.body);
    if (i < 0)
      return;
    if (!finite(c.force))
      return refuse("force: not finite");
    if (!std::isfinite(c.torque))
      return refuse("torque: not finite");
    if (!accept())
      return;
    Body& body = engine.bodies[i];
    engine.closeIsland(i, time);
    body.wrench_force = c.force;
    body.wrench_torque = c.torque;
    engine.refreshPush(body);
    engine.wake(i, time);
  }

  void operator()(const SetCommand& c)
  {
    if (c.gravity && negativeOrNotFinite(*c.gravity))
      return refuse("gravity: negative or not finite");
    if (c.damping && negativeOrNotFinite(*c.damping))
      return refuse("damping: negative or not finite");
    if (c.thrust && negativeOrNotFinite(*c.thrust))
      return refuse("thrust: negative or not finite");
    if (c.elasticity && !(*c.elasticity >= 0.0 && *c.elasticity <= 1.0))
      return refuse("elasticity: not within 0..1");
    if (c.mass && (!(*c.mass > 0.0) || std::isinf(*c.mass)))
      return refuse("mass: not positive or not finite");
    if (c.mass && (engine.block_count == 0 || engine.bodies[0].fixed))
      return refuse("mass: the first block does not move");
    if (!accept())
      return;
    for (int i = 0; i < engine.block_count; ++i)
      if (!engine.bodies[i].fixed && engine.bodies[i].island == i)
        engine.closeIsland(i, time);
    const double before = engine.storedTotal(time);
    engine.set(c);
    engine.command_work_ += engine.storedTotal(time) - before;
    engine.resolveAll(time);
  }

  void operator()(const SetStateCommand& c)
  {
    const int i = movable(c.body);
    if (i < 0)
      return;
    if (!finite(c.position) || !std::isfinite(c.angle))
      return refuse("pose: not finite");
    if (!finite(c.velocity) || !std::isfinite(c.omega))
      return refuse("velocity: not finite");
    std::string with;
    if (engine.overlaps(i, Frame(c.position, c.angle), time, with))
      return refuse("pose: '" + c.body + "' would overlap '" + with + "'");
    if (!accept())
      return;
    const double before = engine.storedTotal(time);
    engine.dissolve(i, time);
    MotionState state;
    state.position = c.position;
    state.angle = c.angle;
    state.velocity = c.velocity;
    state.omega = c.omega;
    engine.putAt(i, state, time);
    engine.lookAtCell(i, time);
    engine.command_work_ += engine.storedTotal(time) - before;
    const std::vector<int> seeds = engine.seeds_;
    for (int body : seeds)
    {
      engine.seeds_.assign(1, body);
      engine.resolve(time);
    }
  }

  void operator()(const SpawnCommand& c)
  {
    Scene with = engine.scene;
    with.blocks.push_back(c.block);
    // The new block must fit among the others where they are now.
    for (int i = 0; i < engine.block_count; ++i)
    {
      const Snapshot at = engine.bodies[i].at(time);
      with.blocks[i].position = at.position;
      with.blocks[i].angle = at.angle;
    }
    try
    {
      with.inputs.clear();
      completeScene(with);
    }
    catch (const SceneError& error)
    {
      return refuse(error.what());
    }
    if (!accept())
      return;
    engine.scene.blocks.push_back(with.blocks.back());
    engine.rebuild(time);
  }

  void operator()(const DeleteCommand& c)
  {
    Scene& scene = engine.scene;
    const auto block = std::find_if(scene.blocks.begin(), scene.blocks.end(), [&](const Block& b) { return b.name == c.body; });
    if (block == scene.blocks.end())
      return refuse("body: there is no block '" + c.body + "'");
    if (!accept())
      return;
    scene.blocks.erase(block);
    scene.springs.erase(std::remove_if(scene.springs.begin(), scene.springs.end(),
                                       [&](const Spring& s) { return s.from_block == c.body || s.to_block == c.body; }),
                        scene.springs.end());
    engine.rebuild(time);
  }

  void operator()(const ResetCommand&)
  {
    if (!accept())
      return;
    engine.scene = engine.loaded_;
    engine.build();
    engine.start();
  }
};

/// Values were checked.
void World::Engine::set(const SetCommand& c)
{
  scene.gravity = field_.gravity = c.gravity.value_or(scene.gravity);
  scene.damping = field_.damping = c.damping.value_or(scene.damping);
  field_.rotational_damping = scene.damping * scene.rotational_damping_ratio;
  refreshDissipative();
  if (c.mass)
  {
    scene.blocks[0].mass = *c.mass;
    Body& body = bodies[0];
    body.mass = *c.mass;
    body.inertia = body.mass * body.shape->gyration;
    body.inverse_mass = 1.0 / body.mass;
    body.inverse_inertia = 1.0 / body.inertia;
  }
  if (c.elasticity)
  {
    scene.elasticity = *c.elasticity;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (static_cast<int>(i) >= block_count || !scene.blocks[i].elasticity)
        bodies[i].elasticity = scene.elasticity;
  }
  if (c.thrust)
  {
    scene.thrust = *c.thrust;
    for (int i = 0; i < block_count; ++i)
      if (!bodies[i].fixed && !scene.blocks[i].thrusters)
      {
        bodies[i].thrusters = defaultThrusters(scene.blocks[i].vertices, scene.thrust);
        refreshPush(bodies[i]);
      }
  }
}

Applied World::Engine::applyAt(const Command& command, const Time& time, bool check_only)
{
  Handler handler{ *this, time, check_only, {} };
  handler.result.command = command;
  kind_ = CostKind::Command;
  std::visit(handler, command);
  if (handler.result.ok && !check_only)
    tryAgain();
  return handler.result;
}

}  // namespace block_world
