#include <algorithm>

#include "limits.h"
#include "replay.h"

// The part of Replay that looks at bodies whose contact forces change between the samples, where no file tells them. By Gauss's principle of
// least constraint they change the accelerations no more than it takes: with squares of accelerations weighed by mass and moment of inertia
// (2 T of the change), no more than any other change that keeps the contacts. One that does stops what is applied, and sends all bodies
// along the paths that turning and sliding force upon them. A wedge makes these paths longer, and there the samples show forces as large.
// So what a body gains beyond what is applied and listed is bounded.

namespace checker
{
// With all that rests on it. What contact forces may have to balance changes from one event to the next. The larger of the values at both ends
// stands for the time between, and what it may change beyond that, as it is computed without the contact forces.
void Replay::bringIsland(int cluster, double time)
{
  const int island = islandOf(cluster);
  if (!resting_[cluster])
    return bring(cluster, time);
  const double span = time - clock_[cluster];
  if (span == 0.0)
    return;
  const double before = demand(island);
  for (size_t other = 0; other < clock_.size(); ++other)
    if (islandOf(static_cast<int>(other)) == island)
      bring(static_cast<int>(other), time);
  demand_[island] += span * std::max(before, demand(island)) * (1.0 + fastestRate(island) * (end_ - begin_));
}

// Root of the sum of m a^2 + I alpha^2 in an island, for what is applied and for what is forced.
double Replay::demand(int island)
{
  std::vector<double> forced(run_.bodies, 0.0);
  for (const ContactRow* row : rests_)
  {
    const double acceleration = forcedAcceleration(*row);
    for (const int body : { row->a, row->b })
      if (scene_.movable(body))
        forced[body] = std::max(forced[body], acceleration);
  }
  std::vector<Load> loads(run_.bodies);
  double applied = 0.0, turning = 0.0;
  for (size_t cluster = 0; cluster < clock_.size(); ++cluster)
  {
    if (islandOf(static_cast<int>(cluster)) != island)
      continue;
    motion_.loads(static_cast<int>(cluster), *drive_, states_, loads);
    for (const int body : motion_.clusters()[cluster])
    {
      const double mass = drive_->bodies[body].mass, inertia = motion_.inertia(*drive_, body), radius = scene_.blocks[body].shape.radius;
      applied += loads[body].force.squaredNorm() / mass + loads[body].torque * loads[body].torque / inertia;
      turning += (mass + inertia / (radius * radius)) * forced[body] * forced[body];
    }
  }
  return std::sqrt(applied) + std::sqrt(turning);
}

// A point of contact goes round on its body, omega^2 r, and where it slides by u on a face that turns, its path bends by 2 omega u.
double Replay::forcedAcceleration(const ContactRow& row) const
{
  const auto velocity = [&](int body) { return scene_.movable(body) ? states_[body].velocityAt(row.point) : Vec2(Vec2::Zero()); };
  const double sliding = std::abs(cross(row.normal, velocity(row.a) - velocity(row.b)));
  double largest = 0.0;
  for (const int body : { row.a, row.b })
  {
    const double omega = scene_.movable(body) ? std::abs(states_[body].omega) : 0.0;
    if (omega > 0.0)
      largest = std::max(largest, omega * (omega * scene_.blocks[body].shape.radius + 2.0 * sliding));
  }
  return largest;
}

void Replay::bound(int body, size_t sample)
{
  const State &wanted = states_[body], &found = run_.state(sample, body);
  const double h = end_ - begin_, radius = scene_.blocks[body].shape.radius;
  const double mass = drive_->bodies[body].mass, inertia = motion_.inertia(*drive_, body);
  const double change = demand_[islandOf(motion_.clusterOf(body))];
  const Vec2 shown = h * leaning_[body];
  const double gain = std::max(change / std::sqrt(mass), shown.x() / mass) + relative_error * (1.0 + pushed_[body].x() / mass);
  // The listed impulses act where the contact points are; what is not known is how far the centre has gone meanwhile.
  const double move = h * gain + scene_.tolerance;
  const double turn = std::max(change / std::sqrt(inertia), shown.y() / inertia) + relative_error +
                      (pushed_[body].x() * move + relative_error * pushed_[body].y()) / inertia;
  checks_.bounded.add(std::max({ (found.velocity - wanted.velocity).norm() / gain, std::abs(found.omega - wanted.omega) / turn,
                                 (found.position - wanted.position).norm() / move,
                                 std::abs(found.angle - wanted.angle) / (h * turn + scene_.tolerance / radius) }),
                      1.0, end_, body);
}

}  // namespace checker
