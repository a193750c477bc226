#pragma once

#include <cstdint>

namespace block_world
{
/// Relates simulated time to a clock that runs by itself (the computer's, or /clock of another simulator). All in ns.
class Pacer
{
public:
  /// Simulated ns per ns of the clock, > 0.
  explicit Pacer(double factor);

  /// From here on simulated is due at clock.
  void anchor(std::int64_t simulated, std::int64_t clock);

  /// Another factor from this reading of the clock on; what is due then does not jump.
  void setFactor(double factor, std::int64_t clock);

  /// Simulated time that is due when the clock shows this.
  std::int64_t due(std::int64_t clock) const;

  /// The clock's reading at which a simulated time is due.
  std::int64_t clockAt(std::int64_t simulated) const;

  /// Lets simulated time fall behind for good where it is more than limit of the clock's ns late; returns by how much
  /// of the clock's time it was late then, else 0.
  std::int64_t forgive(std::int64_t simulated, std::int64_t clock, std::int64_t limit);

private:
  double factor_;
  std::int64_t simulated_ = 0;
  std::int64_t clock_ = 0;
};

/// The instants k / rate, in whole ns.
class Schedule
{
public:
  explicit Schedule(double rate);

  /// The first instant later than a time.
  std::int64_t after(std::int64_t time) const;

  bool isDue(std::int64_t time) const;

private:
  std::int64_t instant(std::int64_t k) const;

  double rate_;
};

}  // namespace block_world
