#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace checker
{
/// Solves y' = slope(y) over a span by Gragg's modified midpoint rule, extrapolated to step zero (Bulirsch and Stoer)
/// until two orders agree to rounding; spans that do not converge are halved. Computes the increment of y, so that
/// adding it to y is the only rounding of the size of y.
template <class Slope>
void integrate(const Slope& slope, double span, Eigen::VectorXd& y, int depth = 0)
{
  constexpr int columns = 8;
  std::array<Eigen::VectorXd, columns> table;
  const Eigen::VectorXd scale = y.cwiseAbs().cwiseMax(1.0);
  const Eigen::VectorXd start_slope = slope(y);
  for (int k = 0; k < columns; ++k)
  {
    const int steps = 2 * (k + 1);
    const double h = span / steps;
    Eigen::VectorXd before = Eigen::VectorXd::Zero(y.size());
    Eigen::VectorXd now = h * start_slope;
    for (int i = 1; i < steps; ++i)
    {
      Eigen::VectorXd next = before + 2.0 * h * slope(y + now);
      before.swap(now);
      now.swap(next);
    }
    table[k] = 0.5 * (before + now + h * slope(y + now));
    // Neville's scheme in the square of the step; table[0] becomes the extrapolated value.
    const Eigen::VectorXd old = table[0];
    for (int j = k - 1; j >= 0; --j)
    {
      const double ratio = static_cast<double>(steps) / (2 * (j + 1));
      table[j] = table[j + 1] + (table[j + 1] - table[j]) / (ratio * ratio - 1.0);
    }
    // Agreed to rounding: of the result, or of the sums that make the increment.
    const double rounding = 4e-15 * table[0].cwiseAbs().maxCoeff();
    if (k > 0 && ((table[0] - old).array().abs() <= 1e-16 * scale.array() + rounding).all())
    {
      y += table[0];
      return;
    }
  }
  // Ten halvings mean a span too stiff to be worth judging.
  if (depth >= 10)
  {
    y += table[0];
    return;
  }
  integrate(slope, 0.5 * span, y, depth + 1);
  integrate(slope, 0.5 * span, y, depth + 1);
}

}  // namespace checker
