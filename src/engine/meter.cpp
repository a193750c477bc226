// What the run costs, counted by block, and how time standing still is noticed. Nothing here acts on the motion.

#include <algorithm>

#include "engine.h"

namespace block_world
{
/// Units of what is being done now.
void World::Engine::charge(int body, std::int64_t units)
{
  if (!bodies[body].fixed)
    bodies[body].cost[kind_].units += units;
}

/// The body takes part in an event.
void World::Engine::chargeEvent(int body, const Time& time)
{
  Body& b = bodies[body];
  if (b.fixed)
    return;
  Cost::Part& part = b.cost[kind_];
  ++part.units;
  if (kind_ != CostKind::Impact)  // these are counted by hits
    ++part.count;
  if (kind_ != CostKind::Command && ++b.crowd >= stall_after)
    noticeStall(body, time);
}

/// The last hit or release decided on all touches at once: each is a row as long as there are touches.
void World::Engine::chargeTouches()
{
  const auto row = static_cast<std::int64_t>(group_.touches.size());
  for (const Touch& touch : group_.touches)
    for (int body : { touch.a, touch.b })
      charge(body, row);
}

/// A pair hit each other.
void World::Engine::chargeHit(const Touch& touch)
{
  ++statistics.impacts;
  kind_ = CostKind::Impact;
  for (int body : { touch.a, touch.b })
    if (!bodies[body].fixed)
      ++bodies[body].cost[kind_].count;
}

/// The body has taken part in the most events that time may stand still for: has it? If not, they are counted anew.
void World::Engine::noticeStall(int body, const Time& time)
{
  constexpr double kSpan = 1e-12;  // s
  Body& b = bodies[body];
  if (time - b.crowd_start <= kSpan)
  {
    Cost why = b.cost;
    why -= b.crowd_cost;
    std::string names;
    for (int other : islandOf(body))
      names += (names.empty() ? "'" : ", '") + bodies[other].name + "'";
    statistics.stalled = true;
    statistics.mode = "stalled at " + names + ": " + std::to_string(b.crowd) + " events within 1e-12 s, " + mainKind(why);
  }
  b.crowd = 0;
  b.crowd_start = time;
  b.crowd_cost = b.cost;
}

/// The course was changed: time may go on.
void World::Engine::tryAgain()
{
  statistics.stalled = false;
  statistics.mode = "exact";
}

std::vector<int> World::Engine::islandOf(int body) const
{
  if (bodies[body].fixed)
    return { body };
  std::vector<int> members = islands_[bodies[body].island].bodies;
  std::sort(members.begin(), members.end());
  return members;
}

}  // namespace block_world
