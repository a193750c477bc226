#pragma once

#include <numeric>
#include <vector>

#include "cholesky.h"
#include "random.h"

// Gram matrices A = J J^T of rows that are given or random.

namespace block_world
{
using Rows = std::vector<std::vector<double>>;

inline Rows randomRows(Random& random, int count, int rank)
{
  Rows rows(count, std::vector<double>(rank));
  for (auto& row : rows)
    for (double& entry : row)
      entry = random.in(-1.0, 1.0);
  return rows;
}

inline double dot(const std::vector<double>& p, const std::vector<double>& q)
{
  return std::inner_product(p.begin(), p.end(), q.begin(), 0.0);
}

inline SymmetricMatrix gramOf(const Rows& rows)
{
  SymmetricMatrix a;
  a.resize(static_cast<int>(rows.size()));
  for (int i = 0; i < a.size(); ++i)
    for (int j = 0; j < a.size(); ++j)
      a(i, j) = dot(rows[i], rows[j]);
  return a;
}

inline std::vector<int> all(int count)
{
  std::vector<int> rows(count);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

inline std::vector<double> product(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& l)
{
  std::vector<double> result(rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      result[i] += a(rows[i], rows[j]) * l[j];
  return result;
}

}  // namespace block_world
