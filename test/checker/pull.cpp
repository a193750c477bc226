#include <algorithm>
#include <cmath>

#include "replay.h"

namespace checker
{
namespace
{
/// What 1 N s at a touch does to its movable bodies.
struct Push
{
  std::vector<std::pair<int, Load>> loads;
  double impulse = 0.0;
};
}  // namespace

// N s, what of the impulses j no pushes p >= 0 at the same touches would do: min |J'(j - p)| sqrt(m) in the metric M^-1, with m all movable mass. (On a
// short lever large pulls and pushes do little together.) By coordinate descent from p = max(j, 0), which ends where the rest is small enough.
double Replay::pull(const std::vector<const ContactRow*>& events, double enough) const
{
  std::vector<Load> left(run_.bodies);
  const auto act = [&](const Push& push, double impulse) {
    for (const auto& [body, load] : push.loads)
    {
      left[body].force += impulse * load.force;
      left[body].torque += impulse * load.torque;
    }
  };
  const auto product = [&](int body, const Load& p, const Load& q) {
    return p.force.dot(q.force) / drive_->bodies[body].mass + p.torque * q.torque / motion_.inertia(*drive_, body);
  };

  std::vector<Push> pushes;
  for (const ContactRow* event : events)
  {
    pushes.push_back({ {}, std::max(0.0, event->impulse) });
    for (const int body : { event->a, event->b })
      if (scene_.movable(body))
      {
        const Vec2 force = (body == event->a ? 1.0 : -1.0) * event->normal;
        pushes.back().loads.push_back({ body, { force, cross(Vec2(event->point - states_[body].position), force) } });
      }
    act(pushes.back(), std::min(0.0, event->impulse));
  }
  constexpr int most_sweeps = 1000;
  for (int sweep = 0;; ++sweep)
  {
    double mass = 0.0, square = 0.0;
    for (int body = 0; body < static_cast<int>(run_.bodies); ++body)
      if (scene_.movable(body))
      {
        mass += drive_->bodies[body].mass;
        square += product(body, left[body], left[body]);
      }
    const double value = std::sqrt(mass * square);
    if (value <= enough || sweep == most_sweeps)
      return value;
    for (Push& push : pushes)
    {
      double rate = 0.0, diagonal = 0.0;
      for (const auto& [body, load] : push.loads)
      {
        rate += product(body, load, left[body]);
        diagonal += product(body, load, load);
      }
      const double more = std::max(-push.impulse, rate / diagonal);
      push.impulse += more;
      act(push, -more);
    }
  }
}

}  // namespace checker
