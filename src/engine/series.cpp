#include "series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace block_world
{
namespace
{
/// As many halvings of the horizon as a double has digits, nearly.
constexpr int kHalvings = 50;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// binomial(i, j) / binomial(kOrder, j): Bernstein coefficient i of a power series on [0, 1] is the sum over j <= i of this times a_j.
struct BernsteinTable
{
  double weight[kOrder + 1][kOrder + 1];

  BernsteinTable()
  {
    double binomial[kOrder + 1][kOrder + 1] = {};
    for (int i = 0; i <= kOrder; ++i)
    {
      binomial[i][0] = 1.0;
      for (int j = 1; j <= i; ++j)
        binomial[i][j] = binomial[i - 1][j - 1] + (j < i ? binomial[i - 1][j] : 0.0);
    }
    for (int i = 0; i <= kOrder; ++i)
      for (int j = 0; j <= kOrder; ++j)
        weight[i][j] = j <= i ? binomial[i][j] / binomial[kOrder][j] : 0.0;
  }
};

/// The only root of a decreasing sign change in [low, high]: Newton's method, kept inside a shrinking bracket, from where the first orders alone have
/// it.
double onlyRoot(const Series& c, int degree, double floor, double low, double high)
{
  double s = degree >= 2 ? firstZero(c[0] - floor, c[1], 2.0 * c[2]) : 0.5 * (low + high);
  if (!(s > low && s < high))
    s = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i)
  {
    const double value = evaluate(c, degree, s) - floor;
    (value > 0.0 ? low : high) = s;
    const double slope = evaluateDerivative(c, degree, s);
    double next = s - value / slope;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (next == s || !(low < high) || std::abs(next - s) <= 1e-17 * high)
      return next;
    s = next;
  }
  return low;
}

double search(const Series& c, int degree, double floor, const Series& bernstein, double low, double high, int depth)
{
  if (bernstein[0] <= floor)
    return low;
  int changes = 0;
  bool above = true;
  for (double b : bernstein)
    if ((b > floor) != above)
    {
      above = !above;
      ++changes;
    }
  if (changes == 0)
    return kNever;
  if (changes == 1)
    return onlyRoot(c, degree, floor, low, high);
  if (depth == 0)
    return low;

  Series left, right = bernstein;
  left[0] = right[0];
  for (int k = 1; k <= kOrder; ++k)
  {
    for (int i = 0; i <= kOrder - k; ++i)
      right[i] = 0.5 * (right[i] + right[i + 1]);
    left[k] = right[0];
  }
  const double middle = 0.5 * (low + high);
  const double found = search(c, degree, floor, left, low, middle, depth - 1);
  return found < kNever ? found : search(c, degree, floor, right, middle, high, depth - 1);
}
}  // namespace

double firstZero(double g, double v, double a)
{
  const double discriminant = v * v - 2.0 * a * g;
  if (discriminant < 0.0 || (v >= 0.0 && a >= 0.0))
    return kNever;
  const double root = std::sqrt(discriminant);
  return v < 0.0 ? 2.0 * g / (root - v) : (v + root) / -a;
}

Series shifted(const Series& c, int degree, double shift)
{
  Series result = c;
  for (int i = 0; i < degree; ++i)
    for (int n = degree - 1; n >= i; --n)
      result[n] += shift * result[n + 1];
  return result;
}

void trigonometricSeries(const Series& angle, int degree, int order, Series& cosine, Series& sine)
{
  for (int n = 0; n < order; ++n)
  {
    double c = 0.0, s = 0.0;
    for (int j = 1; j <= std::min(n + 1, degree); ++j)
    {
      c -= j * angle[j] * sine[n + 1 - j];
      s += j * angle[j] * cosine[n + 1 - j];
    }
    cosine[n + 1] = c / (n + 1);
    sine[n + 1] = s / (n + 1);
  }
}

double firstBelow(const Series& c, int degree, double horizon, double floor)
{
  if (std::isinf(horizon))
  {
    const double height = c[0] - floor, speed = degree >= 1 ? c[1] : 0.0, curvature = degree >= 2 ? 2.0 * c[2] : 0.0;
    return height <= 0.0 ? 0.0 : firstZero(height, speed, curvature);
  }
  static const BernsteinTable table;
  Series scaled;
  double power = 1.0, spread = 0.0;
  for (int n = 0; n <= kOrder; ++n)
  {
    scaled[n] = n <= degree ? c[n] * power : 0.0;
    if (n > 0)
      spread += std::abs(scaled[n]);
    power *= horizon;
  }
  if (scaled[0] - spread > floor)
    return kNever;
  Series bernstein;
  for (int i = 0; i <= kOrder; ++i)
  {
    bernstein[i] = 0.0;
    for (int j = 0; j <= std::min(i, degree); ++j)
      bernstein[i] += table.weight[i][j] * scaled[j];
  }
  const double found = search(c, degree, floor, bernstein, 0.0, horizon, kHalvings);
  if (found > 0.0 || c[0] <= floor)
    return found;
  // Undecided next to the start, where so long a horizon resolves nothing: look there again, with a horizon of that size.
  const double near = std::ldexp(horizon, -kHalvings);
  return std::min(firstBelow(c, degree, near, floor), near);
}

}  // namespace block_world
