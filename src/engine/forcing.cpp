// What pushes and pulls the bodies from outside: thrusters, wrenches and the mouse spring, for how long, and the scene's timed inputs.

#include "engine.h"

namespace block_world
{
/// Force and torque of the thrusters at their levels and of the wrench, in body axes.
void World::Engine::refreshPush(Body& body)
{
  body.push = body.wrench_force;
  body.twist = body.wrench_torque;
  for (std::size_t i = 0; i < body.thrusters.size(); ++i)
  {
    const Thruster& thruster = body.thrusters[i];
    const Vec2 force = body.levels[i] * thruster.strength * thruster.direction;
    body.push += force;
    body.twist += cross(thruster.point, force);
  }
}

/// Whether anything takes energy between impacts.
void World::Engine::refreshDissipative()
{
  dissipative_ = scene.damping > 0.0;
  for (const SpringLink& link : links_)
    dissipative_ = dissipative_ || link.damping > 0.0;
  for (const Body& body : bodies)
    dissipative_ = dissipative_ || (body.mouse.active && body.mouse.damping > 0.0);
}

void World::Engine::expiryPromise(int body)
{
  const Body& b = bodies[body];
  promises_.set(expirySlot(body), std::min(b.thrust_until, b.mouse.active ? b.mouse.until : Time::infinity()));
}

/// The forces on a body changed: new arcs for its island.
void World::Engine::wake(int body, const Time& time)
{
  expiryPromise(body);
  seeds_.assign(1, body);
  resolve(time);
}

void World::Engine::release(Body& body, const Time& time)
{
  spring_work_ -= mouseEnergy(body, time);
  body.mouse = MouseSpring();
  refreshDissipative();
}

/// A timed command of a body ends.
void World::Engine::expire(int body, const Time& time)
{
  kind_ = CostKind::Command;
  // The work done until now belongs to the forces that did it.
  Body& b = bodies[body];
  closeIsland(body, time);
  if (b.thrust_until <= time)
  {
    b.levels.assign(b.thrusters.size(), 0.0);
    b.thrust_until = Time::infinity();
    refreshPush(b);
  }
  if (b.mouse.active && b.mouse.until <= time)
    release(b, time);
  wake(body, time);
}

Time World::Engine::nextInputTime() const
{
  return next_input_ < scene.inputs.size() ? scene.inputs[next_input_].time.after(input_start_) : Time::infinity();
}

void World::Engine::applyInputs(const Time& time)
{
  while (nextInputTime() <= time)
  {
    const Applied applied = applyAt(scene.inputs[next_input_].command, time);
    if (applied.ok)
      inputs_done.push_back({ time, applied.command });
    else
      notes.push_back("inputs[" + std::to_string(next_input_) + "] refused: " + applied.reason);
    ++next_input_;
  }
  promises_.set(0, nextInputTime());
}

}  // namespace block_world
