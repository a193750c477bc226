#include "cholesky.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
/// Share of the diagonal below which a pivot is looked at closely.
constexpr double kDoubtful = 1e-4;
}  // namespace

/// With z = -A^-1 a the combination of rows that comes nearest to the new one, the largest z_k^2 A_kk: the new pivot p adds z_k^2 / p to entry k of the
/// inverse, so that p against this is what the new row does to the condition of the others.
double Cholesky::heaviest(const double* l)
{
  z_.assign(l, l + size_);
  for (int i = size_ - 1; i >= 0; --i)
  {
    const double* other = row(i);
    z_[i] /= other[i];
    for (int k = first_[i]; k < i; ++k)
      z_[k] -= other[k] * z_[i];
  }
  double most = 0.0;
  for (int i = 0; i < size_; ++i)
  {
    double diagonal = 0.0;
    for (int k = first_[i]; k <= i; ++k)
      diagonal += row(i)[k] * row(i)[k];
    most = std::max(most, z_[i] * z_[i] * diagonal);
  }
  return most;
}

/// Memory for so many rows.
void Cholesky::provide(int size)
{
  if (first_.size() >= static_cast<std::size_t>(size))
    return;
  const std::size_t most = 2 * size + 14;
  lower_.resize(most * (most + 1) / 2);
  first_.resize(most);
  z_.reserve(most);
  rotations_.reserve(most);
}

bool Cholesky::append(const double* entries, double share)
{
  const int n = size_;
  provide(n + 1);
  double* l = row(n);
  int start = 0;
  while (start < n && entries[start] == 0.0)
    l[start++] = 0.0;
  double pivot = entries[n];
  for (int j = start; j < n; ++j)
  {
    const double* other = row(j);
    const int from = std::max(start, first_[j]);
    double rest = entries[j];
    for (int k = from; k < j; ++k)
      rest -= l[k] * other[k];
    l[j] = rest / other[j];
    pivot -= l[j] * l[j];
  }
  const bool doubtful = pivot < kDoubtful * entries[n];
  if (!(pivot > share * std::max(entries[n], doubtful ? heaviest(l) : 0.0)))
    return false;
  doubtful_ = doubtful_ || doubtful;
  l[n] = std::sqrt(pivot);
  first_[n] = start;
  ++size_;
  return true;
}

/// Without row r, L L^T of the rows below lacks what their column r gave: with v that column, L' L'^T = L L^T + v v^T, which rotations of v with one
/// column of L after the other make (Golub & Van Loan, sec. 6.5.4). No row gets entries before its first one.
void Cholesky::remove(int which)
{
  rotations_.clear();
  for (int i = which; i + 1 < size_; ++i)
  {
    const double* from = row(i + 1);
    double* to = row(i);
    const int first = first_[i + 1];
    const int start = std::max(which, first - 1);  // where the first entry moves by one
    double v = from[which];
    std::copy_n(from, which, to);
    std::fill(to + which, to + start, 0.0);
    first_[i] = first > which ? start : first;
    for (int j = start; j < i; ++j)
    {
      const Rotation& r = rotations_[j - which];
      const double l = from[j + 1];
      to[j] = r.cosine * l + r.sine * v;
      v = r.cosine * v - r.sine * l;
    }
    const double length = std::sqrt(from[i + 1] * from[i + 1] + v * v);
    rotations_.push_back({ from[i + 1] / length, v / length });
    to[i] = length;
  }
  --size_;
}

void Cholesky::solve(double* x) const
{
  for (int i = 0; i < size_; ++i)
  {
    const double* l = row(i);
    double rest = x[i];
    for (int k = first_[i]; k < i; ++k)
      rest -= l[k] * x[k];
    x[i] = rest / l[i];
  }
  for (int i = size_ - 1; i >= 0; --i)
  {
    const double* l = row(i);
    x[i] /= l[i];
    for (int k = first_[i]; k < i; ++k)
      x[k] -= l[k] * x[i];
  }
}

}  // namespace block_world
