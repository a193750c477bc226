#include "complementarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  doubtful_.reserve(most);
}

void Cholesky::copy(const Cholesky& other)
{
  provide(other.size_);
  size_ = other.size_;
  std::copy_n(other.lower_.begin(), size_ * (size_ + 1) / 2, lower_.begin());
  std::copy_n(other.first_.begin(), size_, first_.begin());
  doubtful_ = other.doubtful_;
}

bool Cholesky::append(const double* entries, double share)
{
  const int n = size_;
  provide(n + 1);
  double* l = lower_.data() + n * (n + 1) / 2;
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
  if (doubtful)
    doubtful_.push_back(n);
  l[n] = std::sqrt(pivot);
  first_[n] = start;
  ++size_;
  return true;
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

/// (A l + b)_i, and the sum of the absolute values of its terms, which its rounding error is proportional to.
double Complementarity::gradient(int i, double& magnitude) const
{
  double sum = (*b_)[i];
  magnitude = std::abs(sum);
  for (int j : passive_)
  {
    const double term = (*a_)((*rows_)[i], (*rows_)[j]) * l_[j];
    sum += term;
    magnitude += std::abs(term);
  }
  return sum;
}

/// Row of the passive matrix at a position, in the order of entry.
bool Complementarity::rowOf(int position, int candidate)
{
  row_.resize(position + 1);
  for (int k = 0; k < position; ++k)
    row_[k] = (*a_)((*rows_)[candidate], (*rows_)[passive_[k]]);
  row_[position] = (*a_)((*rows_)[candidate], (*rows_)[candidate]);
  return factor_.append(row_.data());
}

void Complementarity::refactor(int from)
{
  factor_.truncate(from);
  for (std::size_t k = from; k < passive_.size();)
  {
    if (rowOf(static_cast<int>(k), passive_[k]))
      ++k;
    else
    {
      // Dependent after all by rounding: it carries nothing.
      l_[passive_[k]] = 0.0;
      state_[passive_[k]] = 2;
      passive_.erase(passive_.begin() + k);
    }
  }
}

/// x = -A_PP^-1 b_P.
void Complementarity::solvePassive(std::vector<double>& x)
{
  const std::size_t n = passive_.size();
  x.resize(n);
  for (std::size_t k = 0; k < n; ++k)
    x[k] = -(*b_)[passive_[k]];
  factor_.solve(x.data());
  if (factor_.doubtful())
    improve(x);
}

/// One step of iterative refinement, x - A_PP^-1 (A_PP x + b_P).
void Complementarity::improve(std::vector<double>& x)
{
  const std::size_t n = passive_.size();
  residual_.resize(n);
  for (std::size_t k = 0; k < n; ++k)
  {
    double sum = -(*b_)[passive_[k]];
    for (std::size_t j = 0; j < n; ++j)
      sum -= (*a_)((*rows_)[passive_[k]], (*rows_)[passive_[j]]) * x[j];
    residual_[k] = sum;
  }
  factor_.solve(residual_.data());
  for (std::size_t k = 0; k < n; ++k)
    x[k] += residual_[k];
}

void Complementarity::refine()
{
  if (passive_.size() < 2)
    return;
  x_.resize(passive_.size());
  for (std::size_t k = 0; k < passive_.size(); ++k)
    x_[k] = l_[passive_[k]];
  improve(x_);
  for (std::size_t k = 0; k < passive_.size(); ++k)
    l_[passive_[k]] = std::max(0.0, x_[k]);
}

/// Moves l towards the minimum over the passive set until that minimum is positive, dropping what reaches zero.
void Complementarity::settle()
{
  while (!passive_.empty())
  {
    solvePassive(x_);
    double step = 1.0;
    int blocking = -1;
    for (std::size_t k = held_; k < passive_.size(); ++k)
    {
      const double l = l_[passive_[k]];
      if (x_[k] <= 0.0 && l / (l - x_[k]) < step)
      {
        step = l / (l - x_[k]);
        blocking = static_cast<int>(k);
      }
      else if (x_[k] <= 0.0 && l == 0.0)
      {
        step = 0.0;
        blocking = static_cast<int>(k);
      }
    }
    if (blocking >= 0)
      keep();
    for (std::size_t k = 0; k < passive_.size(); ++k)
      l_[passive_[k]] += step * (x_[k] - l_[passive_[k]]);
    if (blocking < 0)
      return;
    l_[passive_[blocking]] = 0.0;
    state_[passive_[blocking]] = 0;
    passive_.erase(passive_.begin() + blocking);
    refactor(blocking);
  }
}

/// Takes row i into the passive set. A row that depends on the passive ones moves l along the null direction z (A z = 0, z_i = 1) until another
/// row reaches zero and leaves; where none does, the row is left out.
bool Complementarity::enter(int i)
{
  const int n = static_cast<int>(passive_.size());
  if (rowOf(n, i))
  {
    passive_.push_back(i);
    state_[i] = 1;
    return true;
  }
  x_.assign(row_.begin(), row_.begin() + n);
  factor_.solve(x_.data());  // z_P = -A_PP^-1 A_Pi
  // What is small against the others is zero but for rounding: in a jam, whose loads may grow together without end, it would stop them far out.
  double largest = 1.0;
  for (int k = 0; k < n; ++k)
    largest = std::max(largest, std::abs(x_[k]));
  double step = std::numeric_limits<double>::infinity();
  int blocking = -1;
  for (int k = held_; k < n; ++k)
    if (x_[k] > 1e-8 * largest && l_[passive_[k]] / x_[k] < step)
    {
      step = l_[passive_[k]] / x_[k];
      blocking = k;
    }
  if (blocking < 0)
  {
    state_[i] = 2;
    return false;
  }
  keep();
  for (int k = 0; k < n; ++k)
    l_[passive_[k]] = k < held_ ? l_[passive_[k]] - step * x_[k] : std::max(0.0, l_[passive_[k]] - step * x_[k]);
  l_[passive_[blocking]] = 0.0;
  state_[passive_[blocking]] = 2;
  passive_.erase(passive_.begin() + blocking);
  l_[i] = step;
  passive_.push_back(i);
  state_[i] = 1;
  refactor(blocking);
  return true;
}

/// Memory for so many rows.
void Complementarity::provide(std::size_t rows)
{
  room_.provide(rows, passive_, state_, l_, x_, residual_, row_, support_);
}

void Complementarity::start(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b)
{
  a_ = &a;
  rows_ = &rows;
  b_ = &b;
  const std::size_t n = rows.size();
  provide(n);
  l_.assign(n, 0.0);
  state_.assign(n, 0);
  passive_.clear();
  held_ = 0;
  support_.clear();
  factor_.clear();
}

void Complementarity::solve(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b,
                            const std::vector<int>& guess)
{
  start(a, rows, b);
  for (int i : guess)
    if (rowOf(static_cast<int>(passive_.size()), i))
    {
      passive_.push_back(i);
      state_[i] = 1;
    }
  // What would carry a negative load starts at zero.
  for (bool negative = true; negative && !passive_.empty();)
  {
    solvePassive(x_);
    int from = -1;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < passive_.size(); ++k)
    {
      if (x_[k] > 0.0)
      {
        passive_[kept] = passive_[k];
        x_[kept++] = x_[k];
        continue;
      }
      state_[passive_[k]] = 0;
      from = from < 0 ? static_cast<int>(k) : from;
    }
    negative = from >= 0;
    passive_.resize(kept);
    if (negative)
      refactor(from);
  }
  for (std::size_t k = 0; k < passive_.size(); ++k)
    l_[passive_[k]] = x_[k];
  search(0.0);
}

void Complementarity::solveHeld(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b, const Cholesky& held,
                                double noise)
{
  start(a, rows, b);
  factor_.copy(held);
  held_ = held.size();
  for (int i = 0; i < held_; ++i)
  {
    passive_.push_back(i);
    state_[i] = 1;
  }
  settle();
  search(noise);
}

/// Before a row leaves: what is passive, the one that just entered last, and its loads.
void Complementarity::keep()
{
  if (kept_)
    return;
  kept_ = true;
  before_ = passive_;
  l_before_ = l_;
}

/// A row that entered and left at once did so by rounding. Whatever it drove out on its way is taken back, or it would come again without end.
void Complementarity::undo(int entered)
{
  for (int i : before_)
    state_[i] = 1;
  state_[entered] = 2;
  if (before_.back() == entered)
    before_.pop_back();
  l_ = l_before_;
  const auto from = std::mismatch(passive_.begin(), passive_.end(), before_.begin(), before_.end()).first - passive_.begin();
  passive_ = before_;
  refactor(static_cast<int>(from));
}

/// Takes in what is most negative until nothing is.
void Complementarity::search(double noise)
{
  const std::vector<double>& b = *b_;
  const int n = static_cast<int>(rows_->size());
  double scale = 0.0;
  for (double value : b)
    scale = std::max(scale, std::abs(value));

  for (int pivots = 0; pivots < 10 * n + 20; ++pivots)
  {
    int best = -1;
    double lowest = 0.0;
    for (int i = 0; i < n; ++i)
    {
      if (state_[i] != 0)
        continue;
      double magnitude;
      const double g = gradient(i, magnitude);
      if (g < lowest && g < -std::max(noise, 1e-13 * scale) - 1e-14 * magnitude)
      {
        lowest = g;
        best = i;
      }
    }
    if (best < 0)
      break;
    kept_ = false;
    if (enter(best))
    {
      settle();
      if (state_[best] != 1)
        undo(best);
      else
        for (int i = held_; i < n; ++i)
          if (state_[i] == 2)
            state_[i] = 0;
    }
  }

  double largest = 0.0;
  for (double value : l_)
    largest = std::max(largest, value);
  for (int i = 0; i < n; ++i)
    if (l_[i] > 1e-10 * largest)
      support_.push_back(i);
}

}  // namespace block_world
