// How slow bounces end: the part of ContactGroup that decides which touches come to rest.

#include <algorithm>
#include <cmath>

#include "contact_group.h"

namespace block_world
{
/// Which of the candidates the free accelerations press together: 0 <= f, A f + b >= 0, complementary. Fills in pressed_ and the forces; the
/// search starts from those that were pressed last.
void ContactGroup::solveRest(const std::vector<int>& candidates)
{
  guess_.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (touches[candidates[k]].force > 0.0)
      guess_.push_back(static_cast<int>(k));
  for (Touch& touch : touches)
    touch.force = 0.0;
  pressed_.clear();
  b_.clear();
  // A free acceleration below the rounding of the accelerations presses nothing.
  double strongest = 0.0;
  for (int i : candidates)
  {
    b_.push_back(normalAcceleration(touches[i], members[touches[i].member_a], members[touches[i].member_b]));
    strongest = std::max(strongest, -b_.back());
  }
  if (strongest <= 1e-14 * acceleration_scale_)
    return;
  solver_.solve(gram_, candidates, b_, guess_);
  for (int k : solver_.support())
  {
    pressed_.push_back(candidates[k]);
    touches[candidates[k]].force = solver_.value()[k];
  }
}

/// Cholesky factor of the pressed rows; those that depend on the former ones by rounding are dropped.
void ContactGroup::factorPressed()
{
  factor_.clear();
  for (std::size_t k = 0; k < pressed_.size();)
  {
    row_.resize(k + 1);
    for (std::size_t j = 0; j <= k; ++j)
      row_[j] = gram_(pressed_[k], pressed_[j]);
    if (factor_.append(row_.data()))
      ++k;
    else
      pressed_.erase(pressed_.begin() + k);
  }
}

/// The impulses at the pressed touches that make their velocities, and what the others' pushes change in them, vanish:
/// A_PP j = -(w_P + A_PO l).
void ContactGroup::solveHolds()
{
  holds_.resize(pressed_.size());
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    holds_[k] = -velocityOf(pressed_[k]);
    for (std::size_t o = 0; o < others_.size(); ++o)
      if (pushes_[o] != 0.0)
        holds_[k] -= gram_(pressed_[k], others_[o]) * pushes_[o];
  }
  factor_.solve(holds_.data());
}

/// With the pressed touches held, no other closed one may approach: l >= 0, w_O + A_OP j + A_OO l >= 0, complementary; with j from solveHolds a
/// problem in the Schur complement A_OO - A_OP A_PP^-1 A_PO.
void ContactGroup::solvePushes()
{
  others_.clear();
  b_.clear();
  bool approaches = false;
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
  {
    if (touches[i].gap > closed_ || std::find(pressed_.begin(), pressed_.end(), i) != pressed_.end())
      continue;
    double speed = velocityOf(i);
    for (std::size_t k = 0; k < pressed_.size(); ++k)
      speed += gram_(i, pressed_[k]) * holds_[k];
    others_.push_back(i);
    b_.push_back(std::abs(speed) <= noise_ ? 0.0 : speed);
    approaches = approaches || speed < -noise_;
  }
  pushes_.assign(others_.size(), 0.0);
  if (!approaches)
    return;
  const int n = static_cast<int>(others_.size()), p = static_cast<int>(pressed_.size());
  schur_.resize(n);
  schur_rows_.resize(n);
  for (int j = 0; j < n; ++j)
  {
    schur_rows_[j] = j;
    column_.resize(p);
    for (int k = 0; k < p; ++k)
      column_[k] = gram_(pressed_[k], others_[j]);
    factor_.solve(column_.data());
    for (int i = 0; i < n; ++i)
    {
      double entry = gram_(others_[i], others_[j]);
      for (int k = 0; k < p; ++k)
        entry -= gram_(others_[i], pressed_[k]) * column_[k];
      // What the held touches determine is a sum that cancels: zero, and not rounding, which might be negative.
      schur_(i, j) = i == j && entry < 1e-11 * gram_(others_[i], others_[i]) ? 0.0 : entry;
    }
  }
  solver_.solve(schur_, schur_rows_, b_);
  pushes_ = solver_.value();
  solveHolds();
}

/// Position of the pressed touch that can least be held, -1 if all can.
///
/// The impulses j = -A^-1 w take the kinetic energy 1/2 j'A j = -1/2 sum j_i w_i: touch i has the share 1/2 |j_i w_i| of it, and left alone would hop
/// that energy over its force f_i high. Hops lower than four tolerances are replaced by their limit, rest; so are arrivals that would end in such
/// hops. For a single touch, or flat on flat: w^2 <= 8 delta a.
int ContactGroup::leastHeld() const
{
  int least = -1;
  double most = 1.0;
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    const int i = pressed_[k];
    const double speed = std::abs(velocityOf(i));
    const double over = std::abs(holds_[k]) * speed / (8.0 * depth_[i] * touches[i].force);
    if (speed > noise_ && over > most)
    {
      most = over;
      least = static_cast<int>(k);
    }
  }
  return least;
}

/// Which closed touches come to rest together, and what it takes: impulses at those (holds_ at pressed_), pushes at the others that would approach
/// (pushes_ at others_).
void ContactGroup::planCapture()
{
  candidates_.clear();
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
  {
    Touch& t = touches[i];
    t.force = t.rested ? 1.0 : 0.0;  // whence the search starts
    if (!t.corner && t.gap <= closed_ && std::abs(velocityOf(i)) <= rest_speed_[i])
      candidates_.push_back(i);
  }
  for (;;)
  {
    solveRest(candidates_);
    factorPressed();
    others_.clear();
    solveHolds();
    solvePushes();
    const int least = leastHeld();
    if (least < 0)
      return;
    candidates_.erase(std::find(candidates_.begin(), candidates_.end(), pressed_[least]));
  }
}

/// Gives the impulses of the plan; the pressed touches end at zero velocity exactly. Returns the energy lost.
double ContactGroup::carryOut()
{
  before_.resize(touches.size());
  given_.assign(touches.size(), 0.0);
  for (std::size_t i = 0; i < touches.size(); ++i)
    before_[i] = velocityOf(static_cast<int>(i));
  for (std::size_t k = 0; k < others_.size(); ++k)
    if (pushes_[k] != 0.0)
    {
      push(others_[k], pushes_[k]);
      given_[others_[k]] = pushes_[k];
    }
  others_.clear();
  for (int pass = 0; pass < 2; ++pass)
  {
    solveHolds();
    for (std::size_t k = 0; k < pressed_.size(); ++k)
    {
      push(pressed_[k], holds_[k]);
      given_[pressed_[k]] += holds_[k];
    }
  }
  double loss = 0.0;
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (given_[i] != 0.0)
    {
      touches[i].capture += given_[i];
      loss -= 0.5 * given_[i] * (before_[i] + velocityOf(static_cast<int>(i)));
    }
  return loss;
}

/// Carries out the plan and makes active what is pressed at the velocities that come of it. Returns the energy lost.
double ContactGroup::capture()
{
  double loss = carryOut();
  const std::vector<int> held = pressed_;
  candidates_.clear();
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
  {
    const bool resting = std::abs(velocityOf(i)) <= noise_ || std::find(held.begin(), held.end(), i) != held.end();
    if (!touches[i].corner && touches[i].gap <= closed_ && resting)
      candidates_.push_back(i);
  }
  solveRest(candidates_);
  if (pressed_ != held)
  {
    factorPressed();
    loss += carryOut();
  }
  for (int i : pressed_)
    touches[i].active = true;
  return loss;
}

double ContactGroup::holdActive()
{
  prepare();
  pressed_.clear();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (touches[i].active)
      pressed_.push_back(static_cast<int>(i));
  factorPressed();
  others_.clear();
  const double loss = carryOut();
  clean();
  return loss;
}

}  // namespace block_world
