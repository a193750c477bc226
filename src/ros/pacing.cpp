#include "pacing.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
Pacer::Pacer(double factor) : factor_(factor)
{
}

void Pacer::anchor(std::int64_t simulated, std::int64_t clock)
{
  simulated_ = simulated;
  clock_ = clock;
}

void Pacer::setFactor(double factor, std::int64_t clock)
{
  anchor(due(clock), clock);
  factor_ = factor;
}

std::int64_t Pacer::due(std::int64_t clock) const
{
  return simulated_ + std::llround(factor_ * static_cast<double>(clock - clock_));
}

std::int64_t Pacer::clockAt(std::int64_t simulated) const
{
  const double span = static_cast<double>(simulated - simulated_) / factor_;
  return clock_ + std::llround(std::min(span, 1e18));
}

std::int64_t Pacer::forgive(std::int64_t simulated, std::int64_t clock, std::int64_t limit)
{
  const std::int64_t late = clock - clockAt(simulated);
  if (late <= limit)
    return 0;
  anchor(simulated, clock - limit);
  return late;
}

Schedule::Schedule(double rate) : rate_(rate)
{
}

std::int64_t Schedule::instant(std::int64_t k) const
{
  return std::llround(static_cast<long double>(k) * 1e9L / static_cast<long double>(rate_));
}

std::int64_t Schedule::after(std::int64_t time) const
{
  auto k = static_cast<std::int64_t>(static_cast<long double>(time) * static_cast<long double>(rate_) / 1e9L);
  while (k > 0 && instant(k - 1) > time)
    --k;
  while (instant(k) <= time)
    ++k;
  return instant(k);
}

bool Schedule::isDue(std::int64_t time) const
{
  return after(time - 1) == time;
}

}  // namespace block_world
