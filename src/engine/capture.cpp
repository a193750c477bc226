// How slow bounces end: the part of ContactGroup that decides which touches come to rest.

#include <algorithm>
#include <cmath>

#include "contact_group.h"

namespace block_world
{
/// Rounding of the acceleration g'' of a gap: of the free accelerations, and of the term 2 omega u at the speed u by which the bodies pass each other.
double ContactGroup::accelerationNoise(const Touch& t) const
{
  const Member &a = members[t.member_a], &b = members[t.member_b];
  const double radius = std::min(t.arm.norm(), t.reach.norm());
  const double u = (a.velocity - b.velocity).norm() + std::abs(a.omega) * t.arm.norm() + std::abs(b.omega) * t.reach.norm();
  return 1e-14 * acceleration_scale_ + 2.0 * u * noise_ / radius;
}

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
  bool presses = false;
  for (int i : candidates)
  {
    b_.push_back(normalAcceleration(touches[i], members[touches[i].member_a], members[touches[i].member_b]));
    presses = presses || -b_.back() > accelerationNoise(touches[i]);
  }
  if (!presses)
    return;
  solver_.solve(gram_, candidates, b_, guess_);
  for (int k : solver_.support())
  {
    pressed_.push_back(candidates[k]);
    touches[candidates[k]].force = solver_.value()[k];
  }
}

/// Drops those pressed rows that depend on the former ones by rounding: none, as they were independent in the order in which they were found.
void ContactGroup::factorPressed()
{
  independent(pressed_, kTrusted);
  pressed_ = independent_;
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
  solver_.solveHeld(gram_, plan_, b_, factor_, noise_);
  holds_.assign(solver_.value().begin(), solver_.value().begin() + held);
  pushes_.assign(solver_.value().begin() + held, solver_.value().end());
}

/// By member, the speed that the plan takes or gives, of rotation at the radius of gyration: |dv|^2 + (I/m) domega^2.
void ContactGroup::plannedSpeeds()
{
  sumChanges(plan_, solver_.value(), changes_);
  speeds_.assign(members.size(), 0.0);
  for (std::size_t m = 0; m < members.size(); ++m)
    if (members[m].inverse_mass > 0.0)
      speeds_[m] = std::sqrt(changes_[m].velocity.squaredNorm() +
                             members[m].inverse_mass / members[m].inverse_inertia * changes_[m].omega * changes_[m].omega);
}

/// Takes those pressed touches that can least be held out of the candidates; false if all can be held.
///
/// Left alone the touch would hop, or come and hop. Its force f_i needs the time |j_i| / f_i to give the impulse j_i that brings it to rest, so that
/// the hop lasts twice that and moves its bodies, whose speeds the plan changes by u, by u |j_i| / (2 f_i). What moves nothing by more than four
/// tolerances is replaced by its limit, rest. For a single touch, or flat on flat: w^2 <= 8 delta a. A touch that is left out lets others rest, of its
/// own bodies first: on each body only the worst goes.
bool ContactGroup::leaveOut()
{
  plannedSpeeds();
  over_.clear();
  worst_.assign(members.size(), 1.0);
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    const Touch& t = touches[pressed_[k]];
    const double speed = std::max(speeds_[t.member_a], speeds_[t.member_b]);
    over_.push_back(speed > noise_ ? std::abs(holds_[k]) * speed / (8.0 * depth_[pressed_[k]] * t.force) : 0.0);
    for (int member : { t.member_a, t.member_b })
      if (members[member].inverse_mass > 0.0)
        worst_[member] = std::max(worst_[member], over_.back());
  }
  bool all = true;
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    const Touch& t = touches[pressed_[k]];
    if (over_[k] <= 1.0 || over_[k] < worst_[t.member_a] || over_[k] < worst_[t.member_b])
      continue;
    candidates_.erase(std::find(candidates_.begin(), candidates_.end(), pressed_[k]));
    all = false;
  }
  return !all;
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
    if (!leaveOut())
      return;
  }
}

/// The pressed touches end at zero velocity, and so do the others that the plan pushes.
void ContactGroup::carryOut()
{
  stopped_ = pressed_;
  for (std::size_t k = 0; k < others_.size(); ++k)
    if (pushes_[k] > 0.0)
      stopped_.push_back(others_[k]);
  bringToRestWithNeighbours(stopped_);
}

/// Carries out the plan and makes active what is pressed at the velocities that come of it.
void ContactGroup::capture()
{
  carryOut();
  held_ = pressed_;
  candidates_.clear();
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
  {
    const bool resting = std::abs(velocityOf(i)) <= noise_ || std::find(held_.begin(), held_.end(), i) != held_.end();
    if (!touches[i].corner && touches[i].gap <= closed_ && resting)
      candidates_.push_back(i);
  }
  solveRest(candidates_);
  factorPressed();
  if (pressed_ != held_)
  {
    others_.clear();
    carryOut();
  }
  for (int i : pressed_)
    touches[i].active = true;
}

double ContactGroup::holdActive()
{
  prepare();
  start_ = velocities();
  stopped_.clear();
  approaching_.clear();
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
    if (touches[i].active)
      stopped_.push_back(i);
    else if (velocityOf(i) < -noise_)
      approaching_.push_back(i);  // has an impact of its own to come, though the moves may have closed its gap
  bringToRestWithNeighbours(stopped_, approaching_);
  clean();
  return lossSince(start_);
}

}  // namespace block_world
