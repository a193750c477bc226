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

struct Binomials
{
  double of[kOrder + 1][kOrder + 1] = {};

  Binomials()
  {
    for (int i = 0; i <= kOrder; ++i)
    {
      of[i][0] = 1.0;
      for (int j = 1; j <= i; ++j)
        of[i][j] = of[i - 1][j - 1] + (j < i ? of[i - 1][j] : 0.0);
    }
  }
};

/// Bernstein coefficients on [0, 1] of a power series of that degree n: the i-th is the sum over j <= i of a_j binomial(i, j) / binomial(n, j).
Series bernsteinOf(const Series& a, int degree)
{
  static const Binomials binomial;
  Series shares, result;
  for (int j = 0; j <= degree; ++j)
    shares[j] = a[j] / binomial.of[degree][j];
  for (int i = 0; i <= degree; ++i)
  {
    result[i] = 0.0;
    for (int j = 0; j <= i; ++j)
      result[i] += binomial.of[i][j] * shares[j];
  }
  return result;
}

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
  for (int i = 0; i <= degree; ++i)
    if ((bernstein[i] > floor) != above)
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
  for (int k = 1; k <= degree; ++k)
  {
    for (int i = 0; i <= degree - k; ++i)
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
  if (shift == 0.0)
    return result;
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
  Series scaled{};
  double power = 1.0, spread = 0.0;
  for (int n = 0; n <= degree; ++n)
  {
    scaled[n] = c[n] * power;
    if (n > 0)
      spread += std::abs(scaled[n]);
    power *= horizon;
  }
  if (scaled[0] - spread > floor)
    return kNever;
  // Orders that all together are less than the rounding of the sum; none where they overflow.
  constexpr double kUnseen = 0x1p-56;
  double unseen = 0.0;
  for (; degree > 0; --degree)
  {
    unseen += std::abs(scaled[degree]);
    if (!(unseen < kUnseen * (std::abs(scaled[0]) + spread)))
      break;
  }
  const Series bernstein = bernsteinOf(scaled, degree);
  const double found = search(c, degree, floor, bernstein, 0.0, horizon, kHalvings);
  if (found > 0.0 || c[0] <= floor)
    return found;
  // Undecided next to the start, where so long a horizon resolves nothing: look there again, with a horizon of that size.
  const double near = std::ldexp(horizon, -kHalvings);
  return std::min(firstBelow(c, degree, near, floor), near);
}

}  // namespace block_world
