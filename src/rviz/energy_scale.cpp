#include "energy_scale.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
constexpr double ROOM = 1.25;      // of what is shown: some is left beyond the largest value
constexpr double WASTED = 2.0;     // as many times what is needed begins to shrink
constexpr double SHRINK_TIME = 1;  // s, time constant
}  // namespace

void EnergyScale::End::adapt(double needed, double dt)
{
  needed = std::max(needed, 0.0);
  if (needed > reach)
    reach = ROOM * needed;
  shrinks = reach > (shrinks ? 1.02 * ROOM : WASTED * ROOM) * needed;
  if (shrinks)
    reach += (ROOM * needed - reach) * (1.0 - std::exp(-dt / SHRINK_TIME));
}

void EnergyScale::adapt(double low, double high, double dt)
{
  low_.adapt(-low, dt);
  high_.adapt(high, dt);
}

double EnergyScale::low() const
{
  return -low_.reach;
}

double EnergyScale::high() const
{
  return high_.reach;
}

std::vector<double> EnergyScale::ticks(int most) const
{
  const double span = high() - low();
  if (!(span > 0.0) || most < 1)
    return { 0.0 };
  // The least of 1, 2 and 5 times a power of ten that does not give too many.
  const double least = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * power;
  for (const double factor : { 5.0, 2.0, 1.0 })
    if (factor * power >= least)
      step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low() / step); k <= std::floor(high() / step); ++k)
    ticks.push_back(k * step);
  return ticks;
}

}  // namespace block_world
