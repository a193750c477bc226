#include "replay.h"

#include <algorithm>
#include <numeric>

#include "limits.h"

namespace checker
{
Replay::Checks::Checks(Report& report)
  : start(report.check("start.state", "the first sample is the scene, in units of its limit"))
  , flight_position(report.check("flight.position", "free motion between samples, in units of its limit"))
  , flight_velocity(report.check("flight.velocity", "the same for velocities"))
  , replay_position(report.check("replay.position", "motion through the listed impulses, in units of its limit"))
  , linear(report.check("replay.linear_momentum", "m dv is the sum of impulses and forces (7, 8), in units of its "
                                                  "limit"))
  , angular(report.check("replay.angular_momentum", "I domega is the sum of their moments (9, 10), in units of its "
                                                    "limit"))
  , sign(report.check("contact.sign", "no contact pulls beyond what a capture stands for: force or impulse below "
                                      "zero"))
  , unit(report.check("contact.unit_normal", "length of the normal less 1"))
  , normal(report.check("contact.normal", "the normal points from b to a and parts them, m"))
  , point(report.check("contact.point", "distance of the contact point from the farther boundary, m"))
  , overlap(report.check("overlap.impacts", "depth of overlap at impacts, m"))
  , approach(report.check("impact.approach", "normal_velocity column against the motion, m/s"))
  , restitution(report.check("impact.restitution", "v+ = -e v- (6) at single impacts, m/s"))
  , impulse(report.check("impact.impulse", "formula (11) at single impacts, N s"))
  , energy(report.check("impact.energy", "kinetic energy gained in an impact, J"))
  , rest_speed(report.check("rest.normal_speed", "resting contacts neither close nor open, m/s"))
  , rest_set(report.check("rest.announced", "resting contacts begin and end with an event"))
  , bounded(report.check("rest.bounded", "where they change unseen: motion within what such forces can do, in units of "
                                         "its limit"))
{
}

Replay::Replay(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion, Report& report)
  : scene_(scene), run_(run), timeline_(timeline), motion_(motion), checks_(report)
{
  size_t row = 0;
  for (const double time : run.times)
  {
    while (row < run.contacts.size() && run.contacts[row].time <= time)
      ++row;
    rows_end_.push_back(row);
  }
  const size_t clusters = motion.clusters().size();
  regimes_.assign(run.times.size() * clusters, Regime::Broken);
  accounts_.resize(run.times.size());
  held_.resize(run.bodies);
  none_.resize(run.bodies);
  pushed_.resize(run.bodies);
  leaning_.resize(run.bodies);
  demand_.resize(clusters);
  moved_.resize(run.bodies);
  island_parent_.resize(clusters);
  resting_.resize(clusters);
  lost_.resize(clusters);
  eventful_.resize(clusters);
  clock_.resize(clusters);
}

void Replay::checkAll()
{
  checkStart();
  checkRest(0);
  for (size_t sample = 1; sample < run_.times.size(); ++sample)
    checkInterval(sample);
}

// Blocks may be moved by less than the tolerance when a scene is loaded; velocities are the scene's, before or after
// what happens at time 0.
void Replay::checkStart()
{
  std::vector<State> after(run_.states.begin(), run_.states.begin() + run_.bodies);
  for (size_t body = 0; body < run_.bodies; ++body)
  {
    after[body].velocity = scene_.blocks[body].start.velocity;
    after[body].omega = scene_.blocks[body].start.omega;
  }
  const std::vector<State> before = after;
  std::vector<Vec2> pushed(run_.bodies, Vec2::Zero());
  const Drive& drive = timeline_.at(0.0);
  for (size_t i = 0; i < rows_end_[0]; ++i)
  {
    const ContactRow& row = run_.contacts[i];
    for (const int body : { row.a, row.b })
    {
      if (row.kind == Kind::Rest || !scene_.movable(body))
        continue;
      const Vec2 impulse = (body == row.a ? 1.0 : -1.0) * row.impulse * row.normal;
      after[body].velocity += impulse / drive.bodies[body].mass;
      const Vec2 arm = row.point - after[body].position;
      after[body].omega += cross(arm, impulse) / motion_.inertia(drive, body);
      pushed[body] += std::abs(row.impulse) * Vec2(1.0, arm.norm());
    }
  }
  const auto difference = [&](const std::vector<State>& wanted, int body) {
    const State& found = run_.state(0, body);
    // Impulses of a jam undo each other but for their rounding.
    Limits limits = stateLimits(found, scene_.blocks[body].shape.radius, 0.0);
    limits.velocity += relative_error * pushed[body].x() / drive.bodies[body].mass;
    limits.omega += relative_error * pushed[body].y() / motion_.inertia(drive, body);
    return std::max((found.velocity - wanted[body].velocity).norm() / limits.velocity,
                    std::abs(found.omega - wanted[body].omega) / limits.omega);
  };
  double worst_before = 0.0, worst_after = 0.0;
  for (int body = 0; body < static_cast<int>(run_.bodies); ++body)
  {
    const State &found = run_.state(0, body), &wanted = scene_.blocks[body].start;
    const double shift = std::max((found.position - wanted.position).norm(),
                                  scene_.blocks[body].shape.radius * std::abs(found.angle - wanted.angle));
    checks_.start.add(shift / scene_.tolerance, 1.0, 0.0, body);
    worst_before = std::max(worst_before, difference(before, body));
    worst_after = std::max(worst_after, difference(after, body));
  }
  start_rows_pending_ = worst_before < worst_after;
  checks_.start.add(std::min(worst_before, worst_after), 1.0, 0.0);
}

void Replay::checkInterval(size_t sample)
{
  begin_ = run_.times[sample - 1];
  end_ = run_.times[sample];
  account_ = &accounts_[sample];
  drive_ = &timeline_.at(begin_);
  states_.assign(run_.states.begin() + (sample - 1) * run_.bodies, run_.states.begin() + sample * run_.bodies);
  std::fill(clock_.begin(), clock_.end(), begin_);
  std::fill(lost_.begin(), lost_.end(), 0);
  std::fill(pushed_.begin(), pushed_.end(), Vec2::Zero());
  std::fill(demand_.begin(), demand_.end(), 0.0);
  std::fill(moved_.begin(), moved_.end(), 0);
  RowRange rows(rows_end_[sample - 1], rows_end_[sample]);
  if (sample == 1 && start_rows_pending_)
    rows.first = 0;
  holdForces(sample - 1);
  markEvents(rows);
  classify(sample);
  walk(rows);
  land(sample);
  checkRest(sample);
  checkRestSet(sample);
}

int Replay::islandOf(int cluster)
{
  while (island_parent_[cluster] != cluster)
    cluster = island_parent_[cluster] = island_parent_[island_parent_[cluster]];
  return cluster;
}

/// Whether the state of a body is known at the time of the event at hand.
bool Replay::known(int body)
{
  return !scene_.movable(body) || !lost_[motion_.clusterOf(body)];
}

// Contact forces at the first sample, and who leans on whom at either end.
void Replay::holdForces(size_t sample)
{
  std::fill(held_.begin(), held_.end(), Load());
  std::fill(leaning_.begin(), leaning_.end(), Vec2::Zero());
  std::fill(resting_.begin(), resting_.end(), 0);
  std::iota(island_parent_.begin(), island_parent_.end(), 0);
  rests_.clear();
  rest_pairs_.clear();
  const size_t first = sample == 0 ? 0 : rows_end_[sample - 1];
  for (size_t i = first; i < rows_end_[sample + 1]; ++i)
  {
    const ContactRow& row = run_.contacts[i];
    if (row.kind == Kind::Impact)
      continue;
    if (row.time >= begin_)
      rests_.push_back(&row);
    rest_pairs_.push_back(std::minmax(row.a, row.b));
    if (scene_.movable(row.a) && scene_.movable(row.b))
      island_parent_[islandOf(motion_.clusterOf(row.a))] = islandOf(motion_.clusterOf(row.b));
    if (row.kind != Kind::Rest)
      continue;
    for (const int body : { row.a, row.b })
    {
      if (!scene_.movable(body))
        continue;
      resting_[motion_.clusterOf(body)] = 1;
      const Vec2 arm = row.point - run_.state(row.time == begin_ ? sample : sample + 1, body).position;
      leaning_[body] += std::abs(row.impulse) * Vec2(1.0, std::abs(cross(arm, row.normal)));
      if (row.time != begin_)
        continue;
      const Vec2 force = (body == row.a ? 1.0 : -1.0) * row.impulse * row.normal;
      held_[body].force += force;
      held_[body].torque += cross(row.point - states_[body].position, force);
    }
  }
  std::sort(rest_pairs_.begin(), rest_pairs_.end());
}

// Which islands have an event inside the interval; a contact that begins and ends inside it makes its bodies rest, too.
void Replay::markEvents(RowRange rows)
{
  std::fill(eventful_.begin(), eventful_.end(), 0);
  std::vector<double> began;
  double shift_time = -1.0;  // where a rest begins or ends, everything that meets there may be shifted
  for (size_t i = rows.first; i < rows.second; ++i)
  {
    const ContactRow& row = run_.contacts[i];
    if (row.kind == Kind::Rest)
      continue;
    for (size_t j = i; j < rows.second && run_.contacts[j].time == row.time && shift_time != row.time; ++j)
      shift_time =
          run_.contacts[j].kind == Kind::RestBegin || run_.contacts[j].kind == Kind::RestEnd ? row.time : shift_time;
    if (began.empty())
      began.assign(resting_.size(), end_);
    for (const int body : { row.a, row.b })
    {
      if (!scene_.movable(body))
        continue;
      const int cluster = motion_.clusterOf(body);
      eventful_[islandOf(cluster)] = 1;
      moved_[body] |= row.time == shift_time;
      if (row.kind == Kind::RestBegin)
        began[cluster] = std::min(began[cluster], row.time);
      if (row.kind == Kind::RestEnd && began[cluster] < row.time)
        resting_[cluster] = 1;
    }
  }
}

void Replay::classify(size_t sample)
{
  const bool changes = timeline_.firstAfter(begin_) != timeline_.firstAfter(end_);
  const size_t clusters = resting_.size();
  for (size_t cluster = 0; cluster < clusters; ++cluster)
  {
    const bool smooth = !changes && !eventful_[islandOf(static_cast<int>(cluster))];
    regimes_[sample * clusters + cluster] = !resting_[cluster] ? Regime::Flight :
                                            smooth             ? Regime::Smooth :
                                                                 Regime::Broken;
    if (regimes_[sample * clusters + cluster] == Regime::Broken)
      account_->known = false;
  }
}

void Replay::bring(int cluster, double time)
{
  const double span = time - clock_[cluster];
  if (span == 0.0)
    return;
  clock_[cluster] = time;
  // Contact forces that are not known are left out.
  const Power work = motion_.advance(cluster, *drive_, lost_[cluster] ? none_ : held_, span, states_);
  if (resting_[cluster])
    return;
  account_->thrust += work.thrust;
  account_->damping += work.damping;
}

// Events and changes of the drive inside the interval, in the order of their times.
void Replay::walk(RowRange rows)
{
  const std::vector<Change>& changes = timeline_.changes();
  size_t change = timeline_.firstAfter(begin_);
  const auto applyChangesUntil = [&](double time) {
    for (; change < changes.size() && changes[change].time <= time && changes[change].time < end_; ++change)
      applyChange(changes[change]);
  };
  while (rows.first < rows.second)
  {
    const double time = run_.contacts[rows.first].time;
    RowRange together(rows.first, rows.first);
    while (together.second < rows.second && run_.contacts[together.second].time == time)
      ++together.second;
    applyChangesUntil(time);
    strike(together);
    rows.first = together.second;
  }
  applyChangesUntil(end_);
}

void Replay::applyChange(const Change& change)
{
  for (size_t cluster = 0; cluster < clock_.size(); ++cluster)
  {
    bringIsland(static_cast<int>(cluster), change.time);
    // A resting body's contact forces jump with the drive, and only their values at the samples are known.
    lost_[cluster] |= resting_[cluster];
    account_->known = account_->known && !lost_[cluster];
  }
  account(change);
  drive_ = &change.after;
}

// The work of a command is the jump of the energy.
void Replay::account(const Change& change)
{
  account_->spring += motion_.mouseSpringEnergy(change.after, states_) - motion_.mouseSpringEnergy(*drive_, states_);
  for (size_t i = 0; i < run_.bodies; ++i)
  {
    const int body = static_cast<int>(i);
    if (scene_.movable(body))
      account_->command +=
          motion_.kinetic(change.after, body, states_[i]) - motion_.kinetic(*drive_, body, states_[i]) +
          motion_.gravityEnergy(change.after, body, states_[i]) - motion_.gravityEnergy(*drive_, body, states_[i]);
  }
}

// Where bodies are at the next sample, against where the file says they are.
void Replay::land(size_t sample)
{
  const int clusters = static_cast<int>(clock_.size());
  for (int cluster = 0; cluster < clusters; ++cluster)
    if (regime(sample, cluster) != Regime::Smooth)
      bringIsland(cluster, end_);
  for (int cluster = 0; cluster < clusters; ++cluster)
  {
    for (const int body : motion_.clusters()[cluster])
    {
      if (regime(sample, cluster) == Regime::Flight)
        compare(body, states_[body], run_.state(sample, body));
      else if (regime(sample, cluster) == Regime::Broken)
        bound(body, sample);
    }
  }
  std::copy_n(run_.states.begin() + sample * run_.bodies, run_.bodies, states_.begin());
  const std::vector<Change>& changes = timeline_.changes();
  const size_t next = timeline_.firstAfter(end_) - 1;
  if (changes[next].time == end_)
    account(changes[next]);
}

void Replay::compare(int body, const State& wanted, const State& found)
{
  const double radius = scene_.blocks[body].shape.radius;
  const double mass = drive_->bodies[body].mass, inertia = motion_.inertia(*drive_, body);
  Limits limits = stateLimits(found, radius, end_);
  const double late = timeResolution(end_);
  limits.velocity += relative_error * pushed_[body].x() / mass;
  limits.omega +=
      relative_error * (pushed_[body].y() + pushed_[body].x() * std::max(1.0, found.position.norm())) / inertia;
  limits.position += late * pushed_[body].x() / mass + (moved_[body] ? scene_.tolerance : 0.0);
  limits.angle += late * pushed_[body].y() / inertia + (moved_[body] ? scene_.tolerance / radius : 0.0);
  const double place = std::max((found.position - wanted.position).norm() / limits.position,
                                std::abs(found.angle - wanted.angle) / limits.angle);
  const double linear = (found.velocity - wanted.velocity).norm() / limits.velocity;
  const double angular = std::abs(found.omega - wanted.omega) / limits.omega;
  if (pushed_[body].x() > 0.0 || moved_[body])
  {
    checks_.replay_position.add(place, 1.0, end_, body);
    checks_.linear.add(linear, 1.0, end_, body);
    checks_.angular.add(angular, 1.0, end_, body);
  }
  else
  {
    checks_.flight_position.add(place, 1.0, end_, body);
    checks_.flight_velocity.add(std::max(linear, angular), 1.0, end_, body);
  }
}

}  // namespace checker
