#include "series.h"

#include "bodies.h"

namespace block_world
{
namespace
{
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

/// (1 + s)^kOrder: all coefficients are whole numbers.
Series binomials()
{
  Series c{};
  c[0] = 1.0;
  for (int n = 1; n <= kOrder; ++n)
    c[n] = c[n - 1] * (kOrder + 1 - n) / n;
  return c;
}

Series exponential(double rate)
{
  Series c{};
  c[0] = 1.0;
  for (int n = 1; n <= kOrder; ++n)
    c[n] = c[n - 1] * rate / n;
  return c;
}

/// sum |c_n| s^n, which the rounding of a polynomial is proportional to.
double magnitude(const Series& c, double s)
{
  double sum = 0.0;
  for (int n = kOrder; n >= 0; --n)
    sum = sum * s + std::abs(c[n]);
  return sum;
}

/// Multiplies by a + b s + q s^2.
void multiply(Series& c, int& degree, double a, double b, double q = 0.0)
{
  for (int n = degree + 2; n >= 0; --n)
    if (n <= kOrder)
      c[n] = a * c[n] + (n >= 1 ? b * c[n - 1] : 0.0) + (n >= 2 ? q * c[n - 2] : 0.0);
  degree += q != 0.0 ? 2 : 1;
}

TEST(Evaluate, PowerOfABinomialAndItsDerivatives)
{
  const Series c = binomials();
  for (const double s : { 0.0, 0.125, 0.5, 1.0, 3.0 })
  {
    // All terms are positive: Horner's scheme errs by less than 2 eps per order.
    EXPECT_NEAR(evaluate(c, kOrder, s) / std::pow(1.0 + s, kOrder), 1.0, 3 * kOrder * eps);
    EXPECT_NEAR(evaluateDerivative(c, kOrder, s) / (kOrder * std::pow(1.0 + s, kOrder - 1)), 1.0, 3 * kOrder * eps);
    EXPECT_NEAR(evaluateSecondDerivative(c, kOrder, s) / (kOrder * (kOrder - 1) * std::pow(1.0 + s, kOrder - 2)), 1.0, 3 * kOrder * eps);
  }
}

TEST(Evaluate, DegreeEndsTheSum)
{
  const Series c{ 1.0, 2.0, 3.0, 4.0 };
  EXPECT_EQ(evaluate(c, 0, 2.0), 1.0);
  EXPECT_EQ(evaluate(c, 2, 2.0), 17.0);
  EXPECT_EQ(evaluateDerivative(c, 0, 2.0), 0.0);
  EXPECT_EQ(evaluateDerivative(c, 2, 2.0), 14.0);
  EXPECT_EQ(evaluateSecondDerivative(c, 1, 2.0), 0.0);
  EXPECT_EQ(evaluateSecondDerivative(c, 3, 2.0), 54.0);
}

TEST(Cauchy, ProductOfExponentialsIsAnExponential)
{
  const Series a = exponential(0.7), b = exponential(0.4), product = exponential(1.1);
  // Positive terms, three coefficients of up to 16 products each.
  for (int n = 0; n <= kOrder; ++n)
    EXPECT_NEAR(cauchy(a, b, n) / product[n], 1.0, 80 * eps);
}

TEST(Shifted, BinomialMovesIntoItsBase)
{
  const Series moved = shifted(binomials(), kOrder, 0.5);
  // Positive terms, two schemes of kOrder orders.
  for (const double s : { 0.0, 0.25, 1.0 })
    EXPECT_NEAR(evaluate(moved, kOrder, s) / std::pow(1.5 + s, kOrder), 1.0, 5 * kOrder * eps);
}

TEST(Shifted, RandomPolynomials)
{
  Random random(1);
  for (int i = 0; i < 200; ++i)
  {
    Series c{};
    const int degree = random.below(kOrder + 1);
    for (int n = 0; n <= degree; ++n)
      c[n] = random.in(-1.0, 1.0);
    const double shift = random.in(-1.0, 1.0), s = random.in(-1.0, 1.0);
    // 2 eps per order on sums no larger than the absolute values at |shift| + |s|.
    const double error = 80 * eps * magnitude(c, std::abs(shift) + std::abs(s));
    EXPECT_NEAR(evaluate(shifted(c, degree, shift), degree, s), evaluate(c, degree, shift + s), error);
  }
}

TEST(TrigonometricSeries, CosineAndSineOfAPolynomialAngle)
{
  Random random(2);
  for (int i = 0; i < 100; ++i)
  {
    Series angle{}, cosine{}, sine{};
    const int degree = 1 + i % kOrder;
    for (int n = 0; n <= degree; ++n)
      angle[n] = random.in(-1.0, 1.0);
    cosine[0] = std::cos(angle[0]);
    sine[0] = std::sin(angle[0]);
    trigonometricSeries(angle, degree, kOrder, cosine, sine);
    for (const double s : { -0.05, 0.03, 0.05 })
    {
      // Coefficients stay below exp(1 / (1 - 2 s) ) 2^n or so: (2 s)^17 = 1e-17 is left out, and order 17 of the angle,
      // 1e-22.
      EXPECT_NEAR(evaluate(cosine, kOrder, s), std::cos(evaluate(angle, degree, s)), 16 * eps);
      EXPECT_NEAR(evaluate(sine, kOrder, s), std::sin(evaluate(angle, degree, s)), 16 * eps);
    }
  }
}

TEST(FirstZero, KnownRoots)
{
  const struct
  {
    double g, v, a, root;
  } cases[] = {
    { 1.0, -1.0, 0.0, 1.0 },                           // straight
    { 1.0, 0.0, -2.0, 1.0 },                           // dropped
    { 1.0, -2.0, 2.0, 1.0 },                           // double root
    { 1.0, -3.0, 4.0, 0.5 },                           // the first of 1/2 and 1
    { 1.0, 1.0, -2.0, (1.0 + std::sqrt(5.0)) / 2.0 },  // thrown up
    { 0.0, 1.0, -2.0, 1.0 },                           // from zero up and back
    { 0.0, -1.0, 0.0, 0.0 },                           // from zero down
    { 1.0, 1.0, 1.0, never },                          // opens
    { 1.0, 1.0, 0.0, never },
    { 1.0, 0.0, 0.0, never },
    { 1.0, -1.0, 0.51, never },  // turns back just above zero
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(testing::Message() << c.g << " " << c.v << " " << c.a);
    if (c.root == never)
    {
      EXPECT_EQ(firstZero(c.g, c.v, c.a), never);
    }
    else
    {
      EXPECT_NEAR(firstZero(c.g, c.v, c.a), c.root, 4 * eps);
    }
  }
}

TEST(FirstZero, NoCancellationAtAnyScale)
{
  Random random(3);
  for (int i = 0; i < 20000; ++i)
  {
    // a/2 (s - root)(s - other): the other root later, or negative.
    const double root = std::pow(10.0, random.in(-20.0, 20.0)), ratio = std::pow(10.0, random.in(0.31, 20.0));
    const bool later = random.below(2) == 0;
    const double other = later ? root * ratio : -root * std::pow(10.0, random.in(-20.0, 20.0));
    const double half = later ? 1.0 : -1.0;
    // Roots at least a factor of two apart: relative condition below 6, with four roundings of half an eps in the data
    // and five in the formula.
    EXPECT_NEAR(firstZero(half * root * other, -half * (root + other), 2.0 * half) / root, 1.0, 32 * eps);
  }
}

TEST(FirstBelow, Openings)
{
  const struct
  {
    Series c;
    double horizon, floor, expected;
  } cases[] = {
    { { 0.0, 0.0, 1.0 }, 10.0, -1e-13, never },       // opens like s^2 from zero, guarded below
    { { 0.0, 0.0, 0.0, 1.0 }, 10.0, -1e-13, never },  // like s^3, as a release does
    { { 0.0, 0.0, -1.0 }, 10.0, -1e-12, 1e-6 },       // sinks like s^2
    { { 0.0, 0.0, 0.0, -1.0 }, 10.0, -1e-12, 1e-4 },  // like s^3
    { { 0.0, 0.0, 1.0, -1.0 }, 10.0, -1e-300, 1.0 },  // opens like s^2, comes back at 1
    { { 1.0, -1.0 }, 2.0, 0.0, 1.0 },
    { { 1.0, -1.0 }, 0.999, 0.0, never },  // the horizon ends before
    { { 1.0, -1.0 }, 2.0, 0.25, 0.75 },
    { { 0.25, -1.0, 1.0 }, 2.0, -1e-9, never },  // (s - 1/2)^2 touches zero and stays above the floor
    { { 0.75, -2.0, 1.0 }, 2.0, 0.0, 0.5 },      // the first of 1/2 and 3/2
    { { 0.0, 1.0 }, 2.0, 0.0, 0.0 },             // on the floor already
    { { -1.0, 1.0 }, 2.0, 0.0, 0.0 },            // below it
    { { 1.0 }, 2.0, 0.0, never },
  };
  for (std::size_t i = 0; i < sizeof(cases) / sizeof(*cases); ++i)
  {
    const auto& c = cases[i];
    for (const int degree : { 3, kOrder })
    {
      const double found = firstBelow(c.c, degree, c.horizon, c.floor);
      if (c.expected == never)
      {
        EXPECT_EQ(found, never) << i;
      }
      else
      {
        EXPECT_NEAR(found, c.expected, 8 * eps) << i;  // simple roots, whose values round by a few eps
      }
    }
  }
}

TEST(FirstBelow, DoubleRootIsFoundToHalfTheDigits)
{
  // (s - 1/2)^2 does not go below zero, but no proof of that can survive rounding: the root, or nothing.
  const double found = firstBelow({ 0.25, -1.0, 1.0 }, 2, 2.0, 0.0);
  EXPECT_TRUE(found == never || std::abs(found - 0.5) < 1e-7) << found;
  // Two roots 2e-6 apart: the slope of 2e-6 turns a rounding of 4 eps into 5e-10.
  EXPECT_NEAR(firstBelow({ 0.25, -1.0, 1.0 }, 2, 2.0, 1e-12), 0.5 - 1e-6, 5e-10);
}

TEST(FirstBelow, InfiniteHorizonIsTheParabola)
{
  EXPECT_EQ(firstBelow({ 3.0, 1.0, -1.0 }, 2, never, 1.0), 2.0);
  EXPECT_EQ(firstBelow({ 3.0, 1.0, 1.0 }, 2, never, 1.0), never);
  EXPECT_EQ(firstBelow({ 3.0, -1.0 }, 1, never, 1.0), 2.0);
  EXPECT_EQ(firstBelow({ 3.0 }, 0, never, 1.0), never);
  EXPECT_EQ(firstBelow({ 1.0, 1.0 }, 1, never, 1.0), 0.0);
}

// A turn of 1e-22 rad/s makes a horizon of 1e22 s, over which a speed of 1 m/s turns into all directions; the zero is 1e-6 s away. The horizon's powers
// overflow: of one of 1e13 s only the last one, on a term that is not zero.
TEST(FirstBelow, RootFarNearerThanTheHorizon)
{
  for (const double turn : { 1e-22, 1e-13 })
  {
    Series g{};
    double term = 1.0;
    for (int n = 2; n <= kOrder; ++n)
    {
      term *= turn / (n - 1);
      g[n] = n % 4 < 2 ? -term : term;
    }
    g[0] = 2.5e-7;
    g[1] = -0.265;
    EXPECT_NEAR(firstBelow(g, kOrder, 1.0 / turn, 0.0), 2.5e-7 / 0.265, 1e-20);
  }
}

TEST(FirstBelow, RootsPlacedByConstruction)
{
  Random random(4);
  int found_roots = 0;
  for (int i = 0; i < 2000; ++i)
  {
    Series c{};
    c[0] = 1.0;
    int degree = 0;
    double first = never;
    const int roots = random.below(5), pairs = random.below(4);
    for (int k = 0; k < roots; ++k)
    {
      // 0.1 apart at least, in random order
      const double root = 0.2 * (1 + random.below(12)) + 0.1 * random.in(-0.5, 0.5);
      if (std::abs(root - first) < 0.1)
        continue;
      first = std::min(first, root);
      multiply(c, degree, 1.0, -1.0 / root);
    }
    for (int k = 0; k < pairs; ++k)
    {
      const double real = random.in(-1.0, 2.0), imaginary = random.in(0.1, 1.0);
      multiply(c, degree, real * real + imaginary * imaginary, -2.0 * real, 1.0);
    }
    const double horizon = 3.0;
    const double s = firstBelow(c, degree, horizon, 0.0);
    if (first == never)
    {
      EXPECT_EQ(s, never) << i;
      continue;
    }
    // A root of another factor may make this one double: no test of that here.
    const double slope = std::abs(evaluateDerivative(c, degree, first));
    // Coefficients (6 factors) and Bernstein's form round by 64 eps of the absolute values over the horizon.
    const double error = 64 * eps * magnitude(c, horizon) / slope;
    if (error > 1e-3)
      continue;
    ++found_roots;
    EXPECT_NEAR(s, first, error) << i;
  }
  EXPECT_GT(found_roots, 1000);
}

TEST(FirstBelow, NeverPassesASampleBelow)
{
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    Series c{};
    const int degree = 2 + random.below(kOrder - 1);
    for (int n = 0; n <= degree; ++n)
      c[n] = random.in(-1.0, 1.0) * std::pow(0.5, n);
    c[0] = std::abs(c[0]);
    const double horizon = 2.5, rounding = 64 * eps * magnitude(c, horizon);
    const double s = firstBelow(c, degree, horizon, 0.0);
    if (s < never)
    {
      EXPECT_NEAR(evaluate(c, degree, s), 0.0, rounding) << i;  // no false alarm either
    }
    for (int k = 0; k <= 500 && k / 200.0 < s; ++k)
      EXPECT_GT(evaluate(c, degree, k / 200.0), -rounding) << i << " at " << k / 200.0;
  }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
