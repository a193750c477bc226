#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "case.h"

namespace campaign
{
/// A run that does not get on: out of CPU time, or the engine says so itself.
class Stuck : public std::runtime_error
{
public:
  Stuck(const std::string& why, double time) : std::runtime_error(why), time_(time)
  {
  }
  double time() const
  {
    return time_;
  }

private:
  double time_;
};

/// CPU time of this thread, s.
double cpuSeconds();

/// Plays a case: a world, and the script at its times.
class Player
{
public:
  /// limit: of CPU time until the end, s.
  Player(const Case& item, double limit);

  block_world::World& world()
  {
    return world_;
  }

  /// Goes on to a time. With `each`, one promise at a time, calling it after every one and after every command. Throws
  /// Stuck.
  void advance(const block_world::Time& target, const std::function<void()>& each = {});
  void finish(const std::function<void()>& each = {})
  {
    advance(block_world::Time::fromSeconds(case_.duration), each);
  }

  /// What a refused command changed, or empty.
  const std::string& complaint() const
  {
    return complaint_;
  }

private:
  void fly(const block_world::Time& target, const std::function<void()>& each);
  void apply(const block_world::Command& command);
  void checkProgress();

  const Case& case_;
  block_world::World world_;
  double end_of_cpu_;
  std::size_t next_ = 0;
  std::string complaint_;
};

}  // namespace campaign
