#include "complementarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace block_world
{
/// Memory for so many rows.
void Complementarity::provide(std::size_t rows)
{
  room_.provide(rows, passive_, state_, l_, x_, row_, before_, l_before_, support_);
}

void Complementarity::begin(const SymmetricMatrix& a)
{
  a_ = &a;
  const std::size_t n = a.size();
  provide(n);
  l_.assign(n, 0.0);
  state_.assign(n, State::Out);
  passive_.clear();
  support_.clear();
  factor_.clear();
}

void Complementarity::suppose(int row)
{
  if (state_[row] < State::Passive && factorRow(static_cast<int>(passive_.size()), row))
  {
    passive_.push_back(row);
    state_[row] = State::Passive;
  }
}

/// (A l + b)_i, and the sum of the absolute values of its terms, which its rounding error is proportional to.
double Complementarity::gradient(int i, double& magnitude) const
{
  double sum = (*b_)[i];
  magnitude = std::abs(sum);
  const double* a = a_->row(i);
  for (int j : passive_)
  {
    const double term = a[j] * l_[j];
    sum += term;
    magnitude += std::abs(term);
  }
  return sum;
}

/// Appends the row to the factor of the passive ones before that position.
bool Complementarity::factorRow(int position, int row, double share)
{
  row_.resize(position + 1);
  const double* a = a_->row(row);
  for (int k = 0; k < position; ++k)
    row_[k] = a[passive_[k]];
  row_[position] = a[row];
  return factor_.append(row_.data(), share);
}

void Complementarity::refactor(int from)
{
  factor_.truncate(from);
  for (std::size_t k = from; k < passive_.size();)
  {
    const int row = passive_[k];
    if (factorRow(static_cast<int>(k), row, state_[row] == State::Held ? kTrusted : kDependent))
    {
      ++k;
      continue;
    }
    // Dependent after all by rounding: it carries nothing.
    l_[row] = 0.0;
    state_[row] = State::Redundant;
    passive_.erase(passive_.begin() + k);
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
}

/// One step of iterative refinement, l - A_PP^-1 (A_PP l + b_P).
void Complementarity::refine()
{
  const std::size_t n = passive_.size();
  if (n < 2)
    return;
  x_.resize(n);
  double magnitude;
  for (std::size_t k = 0; k < n; ++k)
    x_[k] = gradient(passive_[k], magnitude);
  factor_.solve(x_.data());
  for (std::size_t k = 0; k < n; ++k)
    l_[passive_[k]] = std::max(0.0, l_[passive_[k]] - x_[k]);
}

/// The row at that position is passive no longer.
void Complementarity::leave(int position, State state)
{
  const int row = passive_[position];
  l_[row] = 0.0;
  state_[row] = state;
  passive_.erase(passive_.begin() + position);
  factor_.remove(position);
}

/// Moves l towards the minimum over the passive set until that minimum is positive, dropping what reaches zero.
void Complementarity::settle()
{
  while (!passive_.empty())
  {
    solvePassive(x_);
    double step = 1.0;
    int blocking = -1;
    for (std::size_t k = 0; k < passive_.size(); ++k)
    {
      if (x_[k] > 0.0 || state_[passive_[k]] == State::Held)
        continue;
      const double l = l_[passive_[k]], share = l == 0.0 ? 0.0 : l / (l - x_[k]);
      if (share < step)
      {
        step = share;
        blocking = static_cast<int>(k);
      }
    }
    if (blocking >= 0)
      keep();
    for (std::size_t k = 0; k < passive_.size(); ++k)
      l_[passive_[k]] += step * (x_[k] - l_[passive_[k]]);
    if (blocking < 0)
      return;
    leave(blocking, State::Zero);
  }
}

/// Takes row i into the passive set. A row that depends on the passive ones moves l along the null direction z (A z = 0, z_i = 1) until another
/// row reaches zero and leaves; where none does, the row is left out.
bool Complementarity::enter(int i)
{
  const int n = static_cast<int>(passive_.size());
  if (factorRow(n, i))
  {
    passive_.push_back(i);
    state_[i] = State::Passive;
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
  for (int k = 0; k < n; ++k)
    if (state_[passive_[k]] != State::Held && x_[k] > 1e-8 * largest && l_[passive_[k]] / x_[k] < step)
    {
      step = l_[passive_[k]] / x_[k];
      blocking = k;
    }
  if (blocking < 0)
  {
    state_[i] = State::Redundant;
    return false;
  }
  keep();
  for (int k = 0; k < n; ++k)
  {
    double& l = l_[passive_[k]];
    l -= step * x_[k];
    if (state_[passive_[k]] != State::Held)
      l = std::max(0.0, l);
  }
  leave(blocking, State::Redundant);
  l_[i] = step;
  state_[i] = State::Passive;
  passive_.push_back(i);
  refactor(n - 1);
  return true;
}

/// A held row becomes passive. Where it depends on the passive ones, that of the others leaves on which it depends most.
void Complementarity::hold(int row)
{
  if (!factorRow(static_cast<int>(passive_.size()), row))
  {
    x_.assign(row_.begin(), row_.end() - 1);
    factor_.solve(x_.data());
    int most = -1;
    for (std::size_t k = 0; k < passive_.size(); ++k)
      if (state_[passive_[k]] != State::Held && (most < 0 || std::abs(x_[k]) > std::abs(x_[most])))
        most = static_cast<int>(k);
    if (most >= 0)
      leave(most, State::Zero);
    if (!factorRow(static_cast<int>(passive_.size()), row, kTrusted))
      return;
  }
  passive_.push_back(row);
  state_[row] = State::Held;
}

/// Makes the rows the problem and the held ones passive.
void Complementarity::choose(const std::vector<int>& rows, const std::vector<int>& held)
{
  for (std::size_t i = 0; i < state_.size(); ++i)
    state_[i] = state_[i] >= State::Passive ? State::Redundant : State::Out;
  for (int i : rows)
    state_[i] = state_[i] == State::Redundant ? State::Passive : State::Zero;
  for (int k = static_cast<int>(passive_.size()) - 1; k >= 0; --k)
    if (state_[passive_[k]] != State::Passive)
      leave(k, State::Out);
  for (int i : held)
    if (state_[i] == State::Passive)
      state_[i] = State::Held;
  for (int i : held)
    if (state_[i] != State::Held)
      hold(i);
}

/// The minimum over the passive rows, without those that would carry a negative load there.
void Complementarity::takePositive()
{
  for (bool negative = true; negative && !passive_.empty();)
  {
    solvePassive(x_);
    negative = false;
    for (int k = static_cast<int>(passive_.size()) - 1; k >= 0; --k)
      if (x_[k] <= 0.0 && state_[passive_[k]] != State::Held)
      {
        leave(k, State::Zero);
        negative = true;
      }
  }
  for (std::size_t k = 0; k < passive_.size(); ++k)
    l_[passive_[k]] = x_[k];
}

void Complementarity::solve(const std::vector<int>& rows, const std::vector<double>& b, const std::vector<int>& held, double noise)
{
  b_ = &b;
  choose(rows, held);
  takePositive();
  search(rows, noise);
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
    if (state_[i] != State::Held)
      state_[i] = State::Passive;
  state_[entered] = State::Redundant;
  if (before_.back() == entered)
    before_.pop_back();
  l_ = l_before_;
  const auto from = std::mismatch(passive_.begin(), passive_.end(), before_.begin(), before_.end()).first - passive_.begin();
  passive_ = before_;
  refactor(static_cast<int>(from));
}

/// Takes in what is most negative until nothing is.
void Complementarity::search(const std::vector<int>& rows, double noise)
{
  const std::vector<double>& b = *b_;
  const int n = static_cast<int>(rows.size());
  double scale = 0.0;
  for (int i : rows)
    scale = std::max(scale, std::abs(b[i]));

  for (int pivots = 0; pivots < 10 * n + 20; ++pivots)
  {
    int best = -1;
    double lowest = 0.0;
    for (int i : rows)
    {
      if (state_[i] != State::Zero)
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
      if (state_[best] != State::Passive)
        undo(best);
      else
        for (int i : rows)
          if (state_[i] == State::Redundant)
            state_[i] = State::Zero;
    }
  }

  double largest = 0.0;
  for (int i : rows)
    largest = std::max(largest, l_[i]);
  support_.clear();
  for (int i = 0; i < static_cast<int>(l_.size()); ++i)
    if (l_[i] > 1e-10 * largest)
      support_.push_back(i);
}

}  // namespace block_world
