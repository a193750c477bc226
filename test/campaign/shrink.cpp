#include "shrink.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "player.h"

namespace campaign
{
using namespace block_world;

namespace
{
double now()
{
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The case from a later state on; forces in force then are lost.
Case from(const Case& item, double time)
{
  Player player(item, 10.0);
  player.advance(Time::fromSeconds(time));
  const World& world = player.world();
  Case later = item;
  later.scene = world.scene();
  later.scene.inputs.clear();
  later.script.clear();
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const MotionState state = world.state(i);
    Block& block = later.scene.blocks[i];
    block.position = state.position;
    block.angle = state.angle;
    block.velocity = state.velocity;
    block.omega = state.omega;
  }
  later.duration = item.duration - time;
  return later;
}

Case without(const Case& item, const std::string& name)
{
  Case less = item;
  Scene& scene = less.scene;
  const auto erase = [](auto& list, const auto& goes) {
    list.erase(std::remove_if(list.begin(), list.end(), goes), list.end());
  };
  erase(scene.blocks, [&](const Block& b) { return b.name == name; });
  erase(scene.springs, [&](const Spring& s) { return s.from_block == name || s.to_block == name; });
  for (auto* commands : { &scene.inputs, &less.script })
    erase(*commands, [&](const TimedCommand& c) { return bodyOf(c.command) == name; });
  return less;
}
}  // namespace

Shrinker::Shrinker(const Case& item, const Failure& failure, Judge judge, double seconds)
  : case_(item), failure_(failure), judge_(std::move(judge)), end_(now() + seconds)
{
}

bool Shrinker::outOfTime() const
{
  return now() > end_;
}

bool Shrinker::tryOn(const Case& candidate)
{
  if (outOfTime() || candidate.scene.blocks.empty())
    return false;
  const Result result = judge_(candidate);
  for (const Failure& failure : result.failures)
    if (failure.check == failure_.check)
    {
      case_ = candidate;
      failure_ = failure;
      return true;
    }
  return false;
}

Case Shrinker::shrink()
{
  endEarlier();
  bool smaller = true;
  while (smaller && !outOfTime())
  {
    smaller = startLater();
    smaller = dropBlocks() || smaller;
    smaller = dropFrom([](Case& c) -> auto& { return c.script; }) || smaller;
    smaller = dropFrom([](Case& c) -> auto& { return c.scene.inputs; }) || smaller;
    smaller = dropFrom([](Case& c) -> auto& { return c.scene.springs; }) || smaller;
    smaller = simplify() || smaller;
    smaller = endEarlier() || smaller;
  }
  return case_;
}

/// From just before the failure, or from farther back where that is not enough.
bool Shrinker::startLater()
{
  for (const double share : { 0.98, 0.9, 0.7, 0.4 })
  {
    const double time = share * failure_.time;
    if (time < 0.01)
      return false;
    try
    {
      if (tryOn(throughFile(from(case_, time))))
        return true;
    }
    catch (const std::exception&)
    {
      // What does not get there cannot start there.
    }
  }
  return false;
}

bool Shrinker::endEarlier()
{
  Case shorter = case_;
  shorter.duration = std::ceil(1000.0 * failure_.time + 2.0) / 1000.0;
  const auto late = [&](const TimedCommand& c) { return c.time > Time::fromSeconds(shorter.duration); };
  for (auto* commands : { &shorter.scene.inputs, &shorter.script })
    commands->erase(std::remove_if(commands->begin(), commands->end(), late), commands->end());
  return shorter.duration < 0.999 * case_.duration && tryOn(shorter);
}

/// Tries to do without some of the items that count() gives the number of: `largest` at a time first, then half as many, down to single ones.
template <class Count, class Without>
bool Shrinker::dropSome(std::size_t largest, const Count& count, const Without& without)
{
  bool any = false;
  for (std::size_t size = largest; size > 0; size /= 2)
    for (std::size_t first = 0; first < count();)
    {
      if (tryOn(without(first, std::min(first + size, count()))))
        any = true;
      else
        first += size;
    }
  return any;
}

/// Each with all that needs it.
bool Shrinker::dropBlocks()
{
  const auto count = [&] { return case_.scene.blocks.size(); };
  return dropSome(count() / 2, count, [&](std::size_t first, std::size_t last) {
    Case less = case_;
    for (std::size_t i = first; i < last; ++i)
      less = without(less, case_.scene.blocks[i].name);
    return less;
  });
}

/// list: gives a case's list of what nothing else needs.
template <class List>
bool Shrinker::dropFrom(const List& list)
{
  const auto count = [&] { return list(case_).size(); };
  return dropSome(count(), count, [&](std::size_t first, std::size_t last) {
    Case less = case_;
    const auto begin = list(less).begin();
    list(less).erase(begin + static_cast<long>(first), begin + static_cast<long>(last));
    return less;
  });
}

bool Shrinker::simplify()
{
  bool any = false;
  const auto attempt = [&](const auto& change) {
    Case simpler = case_;
    if (change(simpler.scene))
      any = tryOn(simpler) || any;
  };
  for (auto wall : { &Walls::left, &Walls::right, &Walls::top, &Walls::bottom })
    attempt([&](Scene& s) {
      const bool had = (s.walls.*wall).has_value();
      (s.walls.*wall).reset();
      return had;
    });
  attempt([](Scene& s) {
    const bool had = s.damping != 0.0;
    s.damping = 0.0;
    return had;
  });
  for (std::size_t i = 0; i < case_.scene.blocks.size(); ++i)
  {
    attempt([&](Scene& s) {
      const bool had = s.blocks[i].elasticity.has_value();
      s.blocks[i].elasticity.reset();
      return had;
    });
    attempt([&](Scene& s) {
      const bool had = s.blocks[i].mass != 1.0;
      s.blocks[i].mass = 1.0;
      return had;
    });
    attempt([&](Scene& s) {
      const bool had = !s.blocks[i].velocity.isZero(0.0) || s.blocks[i].omega != 0.0;
      s.blocks[i].velocity.setZero();
      s.blocks[i].omega = 0.0;
      return had;
    });
  }
  return any;
}

}  // namespace campaign
