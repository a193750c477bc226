#include "complementarity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bodies.h"
#include "gram.h"

namespace block_world
{
namespace
{
/// The conditions of Karush, Kuhn and Tucker, which hold at a minimum and only there, and an independent support.
void expectMinimum(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b,
                   const Complementarity& solver)
{
  const std::vector<double>& l = solver.value();
  ASSERT_EQ(l.size(), rows.size());
  const std::vector<double> al = product(a, rows, l);
  // A pivot may be 1e-11 of its diagonal, which amplifies rounding of the sums so far at worst; 1e-9 still sees any
  // wrong row.
  double scale = 1e-300, load = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    scale = std::max(scale, std::abs(b[i]));
    for (std::size_t j = 0; j < b.size(); ++j)
      scale = std::max(scale, std::abs(a(rows[i], rows[j]) * l[j]));
    load = std::max(load, l[i]);
  }
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    EXPECT_GE(l[i], 0.0);
    EXPECT_GE(al[i] + b[i], -1e-9 * scale);
    if (l[i] > 1e-12 * load)
    {
      EXPECT_NEAR(al[i] + b[i], 0.0, 1e-9 * scale);
    }
  }
  Cholesky factor;
  std::vector<int> expected;
  for (std::size_t i = 0; i < l.size(); ++i)
    if (l[i] > 1e-12 * load)
      expected.push_back(static_cast<int>(i));
  EXPECT_EQ(solver.support(), expected);
  std::vector<double> row;
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    row.clear();
    for (std::size_t j = 0; j <= k; ++j)
      row.push_back(a(rows[expected[k]], rows[expected[j]]));
    // The pivots depend on the order; far from dependent in one order is independent in all.
    EXPECT_TRUE(factor.append(row.data()));
  }
}

TEST(Complementarity, ByHand)
{
  const struct
  {
    double a00, a01, a11, b0, b1, l0, l1;
  } cases[] = {
    { 1.0, 0.0, 1.0, -1.0, -2.0, 1.0, 2.0 },                                           // apart
    { 1.0, 0.0, 1.0, 1.0, -2.0, 0.0, 2.0 },                                            // one opens
    { 1.0, 0.0, 1.0, 1.0, 2.0, 0.0, 0.0 },                                             // both open
    { 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0 },                                             // nothing happens
    { 2.0, 1.0, 2.0, -3.0, -3.0, 1.0, 1.0 }, { 2.0, 1.0, 2.0, -4.0, -1.0, 2.0, 0.0 },  // the first opens the second
    { 2.0, -1.0, 2.0, -3.0, 0.0, 2.0, 1.0 },                                           // the first closes the second
  };
  Complementarity solver;
  for (const auto& c : cases)
  {
    SymmetricMatrix a;
    a.resize(2);
    a(0, 0) = c.a00;
    a(0, 1) = a(1, 0) = c.a01;
    a(1, 1) = c.a11;
    const std::vector<int> rows = all(2);
    solver.begin(a);
    solver.solve(rows, { c.b0, c.b1 });
    EXPECT_DOUBLE_EQ(solver.value()[0], c.l0);
    EXPECT_DOUBLE_EQ(solver.value()[1], c.l1);
  }
  const SymmetricMatrix none;
  solver.begin(none);
  solver.solve({}, {});
  EXPECT_TRUE(solver.value().empty());
  EXPECT_TRUE(solver.support().empty());
}

TEST(Complementarity, RandomOfAnyRank)
{
  Random random(2);
  Complementarity solver;
  for (int i = 0; i < 3000; ++i)
  {
    const int count = 1 + random.below(24), rank = 1 + random.below(12);
    const Rows rows = randomRows(random, count, rank);
    const SymmetricMatrix a = gramOf(rows);
    // b = J u plus openings: bounded below however A is deficient.
    const std::vector<double> u = randomRows(random, 1, rank).front();
    std::vector<double> b;
    for (const auto& row : rows)
      b.push_back(dot(row, u) + (random.below(3) == 0 ? random.in(0.0, 1.0) : 0.0));
    const std::vector<int> names = all(count);
    solver.begin(a);
    solver.solve(names, b);
    SCOPED_TRACE(i);
    expectMinimum(a, names, b, solver);
  }
}

TEST(Complementarity, RedundantRowsShareOneLoad)
{
  for (const int copies : { 2, 3, 10 })
  {
    const SymmetricMatrix a = gramOf(Rows(copies, { 3.0, 4.0 }));
    const std::vector<int> names = all(copies);
    const std::vector<double> b(copies, -50.0);
    Complementarity solver;
    solver.begin(a);
    solver.solve(names, b);
    expectMinimum(a, names, b, solver);
    EXPECT_EQ(solver.support().size(), 1u);
    double sum = 0.0;
    for (double l : solver.value())
      sum += l;
    EXPECT_DOUBLE_EQ(sum, 2.0);  // 25 l = 50
  }
}

/// With (A l + b)_i = 0 at the held rows and the conditions at the others; loads at rows that are not named are zero.
void expectHeldMinimum(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b, const std::vector<int>& held,
                       const std::vector<double>& l)
{
  for (int i = 0; i < a.size(); ++i)
  {
    const auto in = [i](const std::vector<int>& list) { return std::find(list.begin(), list.end(), i) != list.end(); };
    if (!in(rows))
    {
      EXPECT_EQ(l[i], 0.0);
      continue;
    }
    double gradient = b[i], scale = std::abs(b[i]);
    for (int j = 0; j < a.size(); ++j)
    {
      gradient += a(i, j) * l[j];
      scale = std::max(scale, std::abs(a(i, j) * l[j]));
    }
    // As in expectMinimum.
    if (in(held))
    {
      EXPECT_NEAR(gradient, 0.0, 1e-9 * scale);
      continue;
    }
    EXPECT_GE(l[i], 0.0);
    EXPECT_GE(gradient, -1e-9 * scale);
    EXPECT_NEAR(l[i] * gradient, 0.0, 1e-9 * scale * std::max(1.0, l[i]));
  }
}

// One solve after the other, of other rows, with other rows held and other values: each starts from the last one, and ends where it would alone.
TEST(Complementarity, GoesOnFromTheLastSolve)
{
  Random random(8);
  for (int i = 0; i < 500; ++i)
  {
    const int count = 4 + random.below(20), rank = 3 + random.below(20);
    const Rows rows = randomRows(random, count, rank);
    const SymmetricMatrix a = gramOf(rows);
    Complementarity solver;
    solver.begin(a);
    for (int turn = 0; turn < 8; ++turn)
    {
      SCOPED_TRACE(testing::Message() << i << ", " << turn);
      std::vector<int> names, held;
      for (int k = 0; k < count; ++k)
        if (random.below(4) > 0)
        {
          names.push_back(k);
          // Up to the rank random rows are independent.
          if (static_cast<int>(held.size()) + 1 < rank && random.below(3) == 0)
            held.push_back(k);
        }
      const std::vector<double> u = randomRows(random, 1, rank).front();
      std::vector<double> b;
      for (const auto& row : rows)
        b.push_back(dot(row, u));
      solver.solve(names, b, held);
      expectHeldMinimum(a, names, b, held, solver.value());
    }
  }
}

// Many rows in few dimensions with whole numbers: every tie there is. The velocities after J^T l are unique, whatever
// the order of the rows.
TEST(Complementarity, OrderOfTheRowsDoesNotMatter)
{
  Random random(3);
  for (int i = 0; i < 300; ++i)
  {
    Rows rows(15, std::vector<double>(3));
    for (auto& row : rows)
      for (double& entry : row)
        entry = random.below(3) - 1;
    const SymmetricMatrix a = gramOf(rows);
    std::vector<int> names = all(15);
    const std::vector<double> u{ random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0) };
    std::vector<double> change[2];
    for (int turn = 0; turn < 2; ++turn)
    {
      std::vector<double> b;
      for (const auto& row : rows)
        b.push_back(dot(row, u));
      Complementarity solver;
      solver.begin(a);
      solver.solve(names, b);
      SCOPED_TRACE(i);
      expectMinimum(a, all(15), b, solver);
      change[turn].assign(3, 0.0);
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (int d = 0; d < 3; ++d)
          change[turn][d] += solver.value()[k] * rows[k][d];
      std::reverse(names.begin(), names.end());
    }
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(change[0][d], change[1][d], 1e-12);  // rows of whole numbers: condition below 100
  }
}

TEST(Complementarity, SomeRowsOfALargerMatrix)
{
  Random random(4);
  const Rows rows = randomRows(random, 20, 8);
  const SymmetricMatrix a = gramOf(rows);
  const std::vector<int> names{ 17, 3, 4, 11, 0 };
  std::vector<double> b(20), some_b;
  Rows chosen;
  for (int name : names)
  {
    b[name] = random.in(-1.0, 0.2);
    some_b.push_back(b[name]);
    chosen.push_back(rows[name]);
  }
  Complementarity some, alone;
  some.begin(a);
  some.solve(names, b);
  const SymmetricMatrix small = gramOf(chosen);
  alone.begin(small);
  alone.solve(all(5), some_b);
  std::vector<double> value(20, 0.0);
  std::vector<int> support;
  for (int k = 0; k < 5; ++k)
    value[names[k]] = alone.value()[k];
  for (int k : alone.support())
    support.push_back(names[k]);
  std::sort(support.begin(), support.end());
  EXPECT_EQ(some.value(), value);
  EXPECT_EQ(some.support(), support);
}

// Held from both sides: J u is undone, and no load can grow without end.
TEST(Complementarity, LockedRowsEnd)
{
  const Rows rows{ { 1.0, 0.0 }, { -1.0, 0.0 }, { 0.0, 1.0 }, { 0.0, -1.0 }, { 1.0, 1.0 }, { -1.0, -1.0 } };
  const SymmetricMatrix a = gramOf(rows);
  Random random(5);
  for (int i = 0; i < 200; ++i)
  {
    const std::vector<double> u{ random.in(-1.0, 1.0), random.in(-1.0, 1.0) };
    std::vector<double> b;
    for (const auto& row : rows)
      b.push_back(dot(row, u));
    Complementarity solver;
    const std::vector<int> names = all(6);
    solver.begin(a);
    solver.solve(names, b);
    expectMinimum(a, names, b, solver);
    const std::vector<double> al = product(a, names, solver.value());
    // The only velocity that enters no wall is zero; sums of six terms below 2.
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(al[k] + b[k], 0.0, 1e-14);
  }
}

// In a space without clearance touches depend on each other but for little. What enters there may leave by rounding; rows that are far from dependent
// on any other keep their load then.
TEST(Complementarity, NearlyDependentRowsDriveNoOthersOut)
{
  constexpr int kRank = 6, kExtra = 4;
  constexpr double kLittle = 1e-6;
  Random random(1);
  for (int i = 0; i < 500; ++i)
  {
    Rows rows = randomRows(random, kRank, kRank);
    for (int k = 0; k < kExtra; ++k)
    {
      const std::vector<double> p = rows[random.below(kRank + k)], q = rows[random.below(kRank + k)];
      rows.emplace_back();
      for (int c = 0; c < kRank; ++c)
        rows.back().push_back(-p[c] - q[c] + kLittle * random.in(-1.0, 1.0));
    }
    const std::vector<double> u = randomRows(random, 1, kRank).front();
    const SymmetricMatrix a = gramOf(rows);
    std::vector<double> b;
    for (const auto& row : rows)
      b.push_back(dot(row, u));
    Complementarity solver;
    const std::vector<int> names = all(kRank + kExtra);
    solver.begin(a);
    solver.solve(names, b);
    const std::vector<double> al = product(a, names, solver.value());
    // What the combination leaves of a row, little times u of size 2, counts as nothing; through four rows of twice the former ones' at worst 16 of it.
    for (std::size_t k = 0; k < b.size(); ++k)
      EXPECT_GE(al[k] + b[k], -16.0 * 2.0 * kLittle) << i;
  }
}

// Gordan: unit normals of the plane are locked exactly if no gap between neighbouring directions exceeds half a turn.
TEST(Complementarity, TestOfGordan)
{
  Random random(6);
  int locked_count = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const int count = 2 + random.below(5);
    std::vector<double> angles;
    Rows rows;
    for (int k = 0; k < count; ++k)
    {
      angles.push_back(random.in(0.0, 2.0 * pi));
      rows.push_back({ std::cos(angles.back()), std::sin(angles.back()) });
    }
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2.0 * pi - angles.back();
    for (int k = 1; k < count; ++k)
      widest = std::max(widest, angles[k] - angles[k - 1]);
    if (std::abs(widest - pi) < 1e-2)
      continue;
    SymmetricMatrix a = gramOf(rows);
    for (int p = 0; p < count; ++p)
      for (int q = 0; q < count; ++q)
        a(p, q) += 1.0;
    Complementarity solver;
    const std::vector<int> names = all(count);
    solver.begin(a);
    solver.solve(names, std::vector<double>(count, -1.0));
    double sum = 0.0;
    for (double l : solver.value())
      sum += l;
    const bool locked = widest < pi;
    locked_count += locked;
    // Unlocked by the angle x: some velocity of length 1 opens all by sin x/2 or more, so 1 - sum >= sin^2(x/2) / (1 +
    // sin^2(x/2)) > 2e-5.
    if (locked)
    {
      EXPECT_NEAR(sum, 1.0, 1e-12) << i;
    }
    else
    {
      EXPECT_LT(sum, 1.0 - 2e-5) << i;
    }
  }
  EXPECT_GT(locked_count, 100);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
