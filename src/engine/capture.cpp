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

/// Appends the last of the rows to the factor of the others. Refuses one that depends on them.
bool ContactGroup::appendRow(const std::vector<int>& rows)
{
  row_.resize(rows.size());
  for (std::size_t j = 0; j < rows.size(); ++j)
    row_[j] = gram_(rows.back(), rows[j]);
  return factor_.append(row_.data());
}

/// Cholesky factor of the pressed rows; those that depend on the former ones by rounding are dropped.
void ContactGroup::factorPressed()
{
  factor_.clear();
  stopped_.swap(pressed_);
  pressed_.clear();
  for (int i : stopped_)
  {
    pressed_.push_back(i);
    if (!appendRow(pressed_))
      pressed_.pop_back();
  }
}

/// The impulses at the pressed touches that make their velocities vanish: A_PP j = -w_P.
void ContactGroup::solveHolds()
{
  holds_.resize(pressed_.size());
  for (std::size_t k = 0; k < pressed_.size(); ++k)
    holds_[k] = -velocityOf(pressed_[k]);
  factor_.solve(holds_.data());
}

/// The impulses by which the pressed touches end at rest and no other closed one approaches: w_P + (A j)_P = 0; j_O >= 0, w_O + (A j)_O >= 0,
/// complementary.
void ContactGroup::solvePlan()
{
  const int held = static_cast<int>(pressed_.size()), n = static_cast<int>(touches.size());
  others_.clear();
  plan_ = pressed_;
  for (int i = 0; i < n; ++i)
    if (touches[i].gap <= closed_ && std::find(pressed_.begin(), pressed_.end(), i) == pressed_.end())
      others_.push_back(i);
  plan_.insert(plan_.end(), others_.begin(), others_.end());
  b_.clear();
  for (int i : plan_)
    b_.push_back(velocityOf(i));
  solver_.solveHeld(gram_, plan_, b_, held, noise_);
  holds_.assign(solver_.value().begin(), solver_.value().begin() + held);
  pushes_.assign(solver_.value().begin() + held, solver_.value().end());
}

/// By member, the speed that the plan takes or gives, of rotation at the radius of gyration: |dv|^2 + (I/m) domega^2.
void ContactGroup::plannedSpeeds()
{
  changes_.assign(members.size(), Change());
  for (std::size_t k = 0; k < plan_.size(); ++k)
  {
    const double impulse = k < holds_.size() ? holds_[k] : pushes_[k - holds_.size()];
    const Touch& t = touches[plan_[k]];
    const Member &a = members[t.member_a], &b = members[t.member_b];
    changes_[t.member_a].velocity += impulse * a.inverse_mass * t.normal;
    changes_[t.member_a].omega += impulse * a.inverse_inertia * cross(t.arm, t.normal);
    changes_[t.member_b].velocity -= impulse * b.inverse_mass * t.normal;
    changes_[t.member_b].omega -= impulse * b.inverse_inertia * cross(t.reach, t.normal);
  }
  for (std::size_t m = 0; m < members.size(); ++m)
    if (members[m].inverse_mass > 0.0)
      changes_[m].speed = std::sqrt(changes_[m].velocity.squaredNorm() +
                                    members[m].inverse_mass / members[m].inverse_inertia * changes_[m].omega * changes_[m].omega);
}

/// Position of the pressed touch that can least be held, -1 if all can.
///
/// Left alone the touch would hop, or come and hop. Its force f_i needs the time |j_i| / f_i to give the impulse j_i that brings it to rest, so that
/// the hop lasts twice that and moves its bodies, whose speeds the plan changes by u, by u |j_i| / (2 f_i). What moves nothing by more than four
/// tolerances is replaced by its limit, rest. For a single touch, or flat on flat: w^2 <= 8 delta a.
int ContactGroup::leastHeld()
{
  plannedSpeeds();
  int least = -1;
  double most = 1.0;
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    const Touch& t = touches[pressed_[k]];
    const double speed = std::max(changes_[t.member_a].speed, changes_[t.member_b].speed);
    const double over = std::abs(holds_[k]) * speed / (8.0 * depth_[pressed_[k]] * t.force);
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
    solvePlan();
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
  const auto give = [this](int i, double impulse) {
    push(i, impulse);
    given_[i] += impulse;
  };
  for (std::size_t k = 0; k < others_.size(); ++k)
    if (pushes_[k] != 0.0)
      give(others_[k], pushes_[k]);
  for (std::size_t k = 0; k < pressed_.size(); ++k)
    give(pressed_[k], holds_[k]);
  factorPressed();
  solveHolds();  // what rounding left
  for (std::size_t k = 0; k < pressed_.size(); ++k)
    give(pressed_[k], holds_[k]);
  double loss = 0.0;
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (given_[i] != 0.0)
    {
      touches[i].capture += given_[i];
      loss -= 0.5 * given_[i] * (before_[i] + velocityOf(static_cast<int>(i)));
    }
  return loss;
}

double ContactGroup::holdPressed()
{
  factorPressed();
  others_.clear();
  solveHolds();
  return carryOut();
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
    loss += holdPressed();
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
  const double loss = holdPressed();
  clean();
  return loss;
}

}  // namespace block_world
