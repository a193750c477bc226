#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "block_world/world.h"

namespace block_world
{
/// A line on the terminal that says how far the run is, renewed a few times per second.
class Progress
{
public:
  Progress() = default;
  Progress(const Progress&) = delete;
  ~Progress()
  {
    if (is_shown_)
      std::fputs("\r\033[K", stderr);
  }
  void show(const World& world)
  {
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    if (!is_terminal_ || elapsed.count() < next_)
      return;
    next_ = elapsed.count() + 0.2;
    const double simulated = world.now().seconds();
    std::fprintf(stderr, "\r%.3f s simulated, %lld events, %.3g x real time%s\033[K", simulated,
                 static_cast<long long>(world.statistics().events), simulated / elapsed.count(),
                 simulated < elapsed.count() ? busiest(world).c_str() : "");
    is_shown_ = true;
  }

private:
  /// Where it is slow: why, since the line before.
  std::string busiest(const World& world)
  {
    const std::vector<IslandCost> islands = meter_.read(world);
    const double seconds = world.now() - told_;
    told_ = world.now();
    return islands.empty() ? std::string() : "; " + islands.front().describe(seconds);
  }

  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  double next_ = 0.2;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  CostMeter meter_;
  Time told_;
};

}  // namespace block_world
