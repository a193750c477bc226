// How slow bounces end: the part of ContactGroup that decides which touches come to rest.

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// The free accelerations of the candidates' gaps; one below the rounding of the accelerations presses nothing.
void ContactGroup::accelerate()
{
  accelerations_.resize(touches.size());
  presses_.resize(touches.size());
  for (int i : candidates_)
  {
    const Touch& t = touches[i];
    accelerations_[i] = normalAcceleration(t, members[t.member_a], members[t.member_b]);
    presses_[i] = -accelerations_[i] > accelerationNoise(t);
  }
}

/// Which of the candidates the free accelerations press together: 0 <= f, A f + b >= 0, complementary. Fills in pressed_ and the forces.
void ContactGroup::solveRest()
{
  for (Touch& touch : touches)
    touch.force = 0.0;
  pressed_.clear();
  if (std::none_of(candidates_.begin(), candidates_.end(), [this](int i) { return presses_[i]; }))
    return;
  pressing_.solve(candidates_, accelerations_);
  pressed_ = pressing_.support();
  for (int i : pressed_)
    touches[i].force = pressing_.value()[i];
}

/// The impulses by which the pressed touches end at rest and no other closed one approaches: w_P + (A j)_P = 0; j_O >= 0, w_O + (A j)_O >= 0,
/// complementary.
void ContactGroup::solvePlan()
{
  planned_.solve(plan_, rates_, pressed_, noise_);
  others_.clear();
  std::set_difference(plan_.begin(), plan_.end(), pressed_.begin(), pressed_.end(), std::back_inserter(others_));
}

/// By member, the speed that the plan takes or gives, of rotation at the radius of gyration: |dv|^2 + (I/m) domega^2.
void ContactGroup::plannedSpeeds()
{
  impulses_.clear();
  for (int i : plan_)
    impulses_.push_back(planned_.value()[i]);
  sumChanges(plan_, impulses_, changes_);
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
/// tolerances is replaced by its limit, rest. For a single touch, or flat on flat: w^2 <= 8 delta a. A touch that is left out lets others rest, those of
/// its own bodies first: only what is the worst on both of them goes.
bool ContactGroup::leaveOut()
{
  plannedSpeeds();
  over_.clear();
  worst_.assign(members.size(), 1.0);
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    const Touch& t = touches[pressed_[k]];
    const double speed = std::max(speeds_[t.member_a], speeds_[t.member_b]);
    over_.push_back(speed > noise_ ? std::abs(planned_.value()[pressed_[k]]) * speed / (8.0 * depth_[pressed_[k]] * t.force) : 0.0);
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

/// Which closed touches come to rest together, pressed_, and the impulses that this takes of these and the others.
void ContactGroup::planCapture()
{
  measureRates();
  plan_.clear();
  candidates_.clear();
  for (int i = 0; i < static_cast<int>(touches.size()); ++i)
  {
    const Touch& t = touches[i];
    if (t.gap > closed_)
      continue;
    plan_.push_back(i);
    if (!t.corner && std::abs(rates_[i]) <= rest_speed_[i])
      candidates_.push_back(i);
  }
  accelerate();
  for (int i : candidates_)
    if (touches[i].rested)
      pressing_.suppose(i);
  do
  {
    solveRest();
    solvePlan();
  } while (leaveOut());
}

/// The pressed touches end at zero velocity, and so do the others that the plan pushes.
void ContactGroup::carryOut()
{
  stopped_ = pressed_;
  for (int i : others_)
    if (planned_.value()[i] > 0.0)
      stopped_.push_back(i);
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
    const bool resting = std::abs(velocityOf(i)) <= noise_ || std::binary_search(held_.begin(), held_.end(), i);
    if (!touches[i].corner && touches[i].gap <= closed_ && resting)
      candidates_.push_back(i);
  }
  accelerate();
  solveRest();
  // None of these depends on others, in whatever order: the arcs ask for that.
  independent(pressed_, kTrusted);
  pressed_ = independent_;
  if (pressed_ != held_)
  {
    others_.clear();
    carryOut();
  }
  // Others that depend on them nearly may have left them a share of their rates.
  if (!atRest(pressed_))
    bringToRest(pressed_);
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
