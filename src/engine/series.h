#pragma once

#include <array>

#include "geometry.h"

namespace block_world
{
/// Relative rounding; in s also what instants differ by (Time), whose fractions of a second are below 1.
constexpr double kRounding = 2.220446049250313e-16;

/// A sum that cancels to less than this share of its terms is zero: what is left is rounding, and would otherwise grow.
constexpr double kCancelled = 64 * kRounding;

/// Highest power of time in an arc. Jorba & Zou (2005): where the products of series are all the work, the cheapest order for a relative error eps is
/// about 1 - ln(eps)/2 = 18. An order costs as much beside its products, and so does an arc beside its orders: with more of them arcs last longer.
/// Odd, as coefficients are read two at a time.
constexpr int kOrder = 25;

/// Of arcs that are cut off early: a quarter of the work for a quarter of the horizon.
constexpr int kLowOrder = kOrder / 2;

/// Coefficients of 1, s, s^2, ... with s the time since the start of an arc.
using Series = std::array<double, kOrder + 1>;
using VectorSeries = std::array<Vec2, kOrder + 1>;

/// Of a product of two, which falls half as fast as they do where they are exponentials.
using ProductSeries = std::array<double, 2 * kOrder + 1>;

/// sum_n c_n s^n up to the degree.
template <std::size_t N>
double evaluate(const std::array<double, N>& c, int degree, double s)
{
  double value = c[degree];
  for (int n = degree - 1; n >= 0; --n)
    value = value * s + c[n];
  return value;
}

/// First derivative of the same sum.
inline double evaluateDerivative(const Series& c, int degree, double s)
{
  double value = 0.0;
  for (int n = degree; n >= 1; --n)
    value = value * s + n * c[n];
  return value;
}

/// Second derivative of the same sum.
inline double evaluateSecondDerivative(const Series& c, int degree, double s)
{
  double value = 0.0;
  for (int n = degree; n >= 2; --n)
    value = value * s + n * (n - 1) * c[n];
  return value;
}

/// Coefficient n of the product a b.
inline double cauchy(const Series& a, const Series& b, int n)
{
  double sum = 0.0;
  for (int j = 0; j <= n; ++j)
    sum += a[j] * b[n - j];
  return sum;
}

/// Terms j = first ... last of coefficient n of the products of two series each, side by side; a scalar's with a vector's where the first holds it
/// twice. Two sums, so that none waits for the other.
inline Vec2 products(const VectorSeries& a, const VectorSeries& b, int n, int first, int last)
{
  Vec2 even = Vec2::Zero(), odd = Vec2::Zero();
  int j = first;
  for (; j < last; j += 2)
  {
    even += a[j].cwiseProduct(b[n - j]);
    odd += a[j + 1].cwiseProduct(b[n - j - 1]);
  }
  if (j == last)
    even += a[j].cwiseProduct(b[n - j]);
  return even + odd;
}

/// The same of a scalar product.
inline double cauchy(const VectorSeries& a, const VectorSeries& b, int n, int first, int last)
{
  return products(a, b, n, first, last).sum();
}

/// Two sums with the sums of the absolute values of their terms, which rounding is proportional to.
struct SizedSum
{
  Vec2 sum = Vec2::Zero(), size = Vec2::Zero();

  void add(const Vec2& term)
  {
    sum += term;
    size += term.cwiseAbs();
  }
};

/// The products with their sizes, in two sums again.
inline SizedSum sizedProducts(const VectorSeries& a, const VectorSeries& b, int n, int first, int last)
{
  SizedSum even, odd;
  int j = first;
  for (; j < last; j += 2)
  {
    even.add(a[j].cwiseProduct(b[n - j]));
    odd.add(a[j + 1].cwiseProduct(b[n - j - 1]));
  }
  if (j == last)
    even.add(a[j].cwiseProduct(b[n - j]));
  return { even.sum + odd.sum, even.size + odd.size };
}

/// First zero after 0 of g + v s + a s^2 / 2 for g >= 0, without cancellation; infinity if there is none.
double firstZero(double g, double v, double a);

/// The same polynomial about s = shift (Horner's scheme repeated).
Series shifted(const Series& c, int degree, double shift);

/// Coefficients of cos and sin of an angle series, from those of order 0, which the caller sets:
/// C' = -S w, S' = C w with w the derivative of the angle.
void trigonometricSeries(const Series& angle, int degree, int order, Series& cosine, Series& sine);

/// First s in [0, horizon] at which the polynomial goes below the floor; infinity if it provably stays above. The horizon may be infinite for
/// parabolas.
/// Rigorous: a polynomial lies within the hull of its Bernstein coefficients; where the hull does not decide, the interval is halved (de Casteljau).
double firstBelow(const Series& c, int degree, double horizon, double floor);

}  // namespace block_world
