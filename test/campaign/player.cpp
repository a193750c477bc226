#include "player.h"

#include <time.h>

#include <algorithm>

namespace campaign
{
using namespace block_world;

double cpuSeconds()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Player::Player(const Case& item, double limit) : case_(item), world_(item.scene), end_of_cpu_(cpuSeconds() + limit)
{
}

void Player::advance(const Time& target, const std::function<void()>& each)
{
  for (; next_ < case_.script.size() && case_.script[next_].time <= target; ++next_)
  {
    fly(case_.script[next_].time, each);
    apply(case_.script[next_].command);
    if (each)
      each();
  }
  fly(target, each);
}

void Player::fly(const Time& target, const std::function<void()>& each)
{
  // Without an observer in portions, so that the limit of CPU time is noticed.
  while (world_.now() < target)
  {
    world_.advance(target, each ? 1 : 1000);
    checkProgress();
    if (each)
      each();
  }
  // The limit may have been met between promises of one instant.
  world_.advance(target);
  checkProgress();
  if (each)
    each();
}

void Player::checkProgress()
{
  const double now = world_.now().seconds();
  if (world_.statistics().mode != "exact")
    throw Stuck(world_.statistics().mode, now);
  if (cpuSeconds() > end_of_cpu_)
    throw Stuck("out of CPU time", now);
}

void Player::apply(const Command& command)
{
  const std::uint64_t before = world_.stateHash();
  const bool promised = world_.check(command).ok;
  const Applied applied = world_.apply(command);
  if (applied.ok != promised)
    complaint_ = "check and apply disagree: " + applied.reason;
  if (!applied.ok && world_.stateHash() != before)
    complaint_ = "a refused command changed the state: " + applied.reason;
}

}  // namespace campaign
