#include "timeline.h"

#include <algorithm>

namespace checker
{
Timeline::Timeline(const Scene& scene)
{
  now_.gravity = scene.gravity;
  now_.elasticity = scene.elasticity;
  now_.damping = scene.damping;
  now_.thrust = scene.thrust;
  now_.bodies.resize(scene.blocks.size());
  for (size_t i = 0; i < scene.blocks.size(); ++i)
    now_.bodies[i].mass = scene.blocks[i].mass;
  changes_.push_back({ -std::numeric_limits<double>::infinity(), now_ });
  for (const Input& input : scene.inputs)
  {
    expireUntil(input.time);
    apply(scene, input);
    record(input.time);
  }
  expireUntil(std::numeric_limits<double>::max());
}

void Timeline::record(double time)
{
  if (changes_.back().time == time)
    changes_.back().after = now_;
  else
    changes_.push_back({ time, now_ });
}

void Timeline::expireUntil(double time)
{
  for (;;)
  {
    double next = std::numeric_limits<double>::infinity();
    for (const Drive::Body& body : now_.bodies)
      next = std::min({ next, body.thrust_until, body.spring ? body.spring->until : next });
    if (next > time)
      return;
    for (Drive::Body& body : now_.bodies)
    {
      if (body.thrust_until <= next)
      {
        body.levels.clear();
        body.thrust_until = std::numeric_limits<double>::infinity();
      }
      if (body.spring && body.spring->until <= next)
        body.spring.reset();
    }
    record(next);
  }
}

void Timeline::apply(const Scene& scene, const Input& input)
{
  Drive::Body* body = input.body >= 0 ? &now_.bodies[input.body] : nullptr;
  switch (input.kind)
  {
    case Input::Thrust:
      body->levels = input.duration > 0.0 ? input.levels : std::vector<double>();
      body->thrust_until = input.duration > 0.0 ? input.time + input.duration : std::numeric_limits<double>::infinity();
      break;
    case Input::MouseSpring:
      body->spring = MouseSpring{ input.point, input.anchor, input.stiffness, input.spring_damping };
      if (input.duration > 0.0)
        body->spring->until = input.time + input.duration;
      break;
    case Input::Release:
      for (Drive::Body& any : now_.bodies)
      {
        if (!body || &any == body)
          any.spring.reset();
      }
      break;
    case Input::Wrench:
      body->force = input.force;
      body->torque = input.torque;
      break;
    case Input::Set:
      now_.gravity = input.gravity.value_or(now_.gravity);
      now_.elasticity = input.elasticity.value_or(now_.elasticity);
      now_.damping = input.damping.value_or(now_.damping);
      now_.thrust = input.thrust.value_or(now_.thrust);
      if (input.mass && !scene.blocks.empty())
        now_.bodies[0].mass = *input.mass;
      break;
  }
}

size_t Timeline::firstAfter(double time) const
{
  const auto later = [](double value, const Change& change) { return value < change.time; };
  return std::upper_bound(changes_.begin(), changes_.end(), time, later) - changes_.begin();
}

const Drive& Timeline::at(double time) const
{
  return changes_[firstAfter(time) - 1].after;
}

double elasticity(const Scene& scene, const Drive& drive, int a, int b)
{
  const auto own = [&](int body) {
    return scene.isWall(body) ? drive.elasticity : scene.blocks[body].elasticity.value_or(drive.elasticity);
  };
  return std::min(own(a), own(b));
}

}  // namespace checker
