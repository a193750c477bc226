#include "cholesky.h"

#include <gtest/gtest.h>

#include "gram.h"

namespace block_world
{
namespace
{
TEST(Cholesky, SolvesWhatWasMultiplied)
{
  Random random(1);
  for (int n = 1; n <= 30; ++n)
  {
    SymmetricMatrix a = gramOf(randomRows(random, n, n));
    for (int i = 0; i < n; ++i)
      a(i, i) += 1.0;
    Cholesky factor;
    std::vector<double> x(n), b;
    for (double& value : x)
      value = random.in(-1.0, 1.0);
    b = product(a, all(n), x);
    for (int i = 0; i < n; ++i)
    {
      std::vector<double> row(i + 1);
      for (int j = 0; j <= i; ++j)
        row[j] = a(i, j);
      ASSERT_TRUE(factor.append(row.data()));
    }
    EXPECT_EQ(factor.size(), n);
    factor.solve(b.data());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(b[i], x[i], 1e-12);  // eps times a condition number below 1 + n^2 / 3 = 300
  }
}

TEST(Cholesky, RefusesADependentRowAndGoesOn)
{
  // Rows (1, 0), (1, 1), (2, 1) = their sum, in the plane.
  Cholesky factor;
  const double first[] = { 1.0 }, second[] = { 1.0, 2.0 }, third[] = { 2.0, 3.0, 5.0 };
  EXPECT_TRUE(factor.append(first));
  EXPECT_TRUE(factor.append(second));
  EXPECT_FALSE(factor.append(third));
  EXPECT_EQ(factor.size(), 2);
  double x[] = { 3.0, 4.0 };  // = A (2, 1)
  factor.solve(x);
  EXPECT_DOUBLE_EQ(x[0], 2.0);
  EXPECT_DOUBLE_EQ(x[1], 1.0);
  const double zero[] = { 0.0, 0.0, 0.0 };
  EXPECT_FALSE(factor.append(zero));
  factor.truncate(1);
  const double third_of_first[] = { 2.0, 5.0 };
  EXPECT_TRUE(factor.append(third_of_first));
  double y[] = { 5.0, 12.0 };  // = (1 2; 2 5) (1, 2)
  factor.solve(y);
  EXPECT_DOUBLE_EQ(y[0], 1.0);
  EXPECT_DOUBLE_EQ(y[1], 2.0);
}

TEST(Cholesky, RemovesRows)
{
  Random random(7);
  for (int i = 0; i < 300; ++i)
  {
    const int n = 1 + random.below(20);
    // Bodies in a row: a touch shares one with the next few only, so that the factor has zeros.
    Rows rows(n, std::vector<double>(n + 3, 0.0));
    for (int k = 0; k < n; ++k)
    {
      const int width = 1 + random.below(4);
      for (int c = 0; c < width; ++c)
        rows[k][k + c] = random.in(-1.0, 1.0) + (c == 0 ? 2.0 : 0.0);
    }
    const SymmetricMatrix a = gramOf(rows);
    Cholesky factor;
    std::vector<double> row;
    for (int k = 0; k < n; ++k)
    {
      row.assign(a.row(k), a.row(k) + k + 1);
      ASSERT_TRUE(factor.append(row.data()));
    }
    std::vector<int> left = all(n);
    while (!left.empty())
    {
      const int which = random.below(static_cast<int>(left.size()));
      factor.remove(which);
      left.erase(left.begin() + which);
      ASSERT_EQ(factor.size(), static_cast<int>(left.size()));
      std::vector<double> x = randomRows(random, 1, static_cast<int>(left.size())).front(), b = product(a, left, x);
      factor.solve(b.data());
      for (std::size_t k = 0; k < left.size(); ++k)
        EXPECT_NEAR(b[k], x[k], 1e-9) << i;  // eps times a condition number below 1e5
    }
  }
}
}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
