#pragma once

#include <array>

namespace block_world::speed
{
/// One step of Gragg's midpoint rule, extrapolated from 2, 4 ... 10 parts (Bulirsch & Stoer 1966): order 10; more
/// would only add rounding.
template <class State, class Slope>
State extrapolatedStep(const Slope& slope, const State& y, long double step)
{
  constexpr int rows = 5;
  std::array<State, rows> row;
  for (int k = 0; k < rows; ++k)
  {
    const int parts = 2 * (k + 1);
    const long double h = step / parts;
    State last = y, now = y + h * slope(y);
    for (int i = 1; i < parts; ++i)
    {
      const State next = last + 2 * h * slope(now);
      last = now;
      now = next;
    }
    State value = (last + now + h * slope(now)) / 2;
    // Aitken and Neville, in the square of the parts' length; row[j] is the column j of the row before.
    for (int j = 0; j < k; ++j)
    {
      const long double ratio = static_cast<long double>(k + 1) / (k - j);
      const State better = value + (value - row[j]) / (ratio * ratio - 1);
      row[j] = value;
      value = better;
    }
    row[k] = value;
  }
  return row[rows - 1];
}

template <class State, class Slope>
State integrate(const Slope& slope, State y, long double span, int steps)
{
  for (int i = 0; i < steps; ++i)
    y = extrapolatedStep(slope, y, span / steps);
  return y;
}

}  // namespace block_world::speed
