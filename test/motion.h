#pragma once

#include <algorithm>
#include <functional>

#include "bodies.h"
#include "flow.h"

namespace block_world
{
/// Bodies that move as one for a while: arc after arc.
class Motion
{
public:
  std::vector<Body> bodies;
  std::vector<SpringLink> links;
  Field field;
  std::vector<Rest> rests;
  Works works;
  Time now;
  int arcs = 0;
  double worst_gap = 0.0;  ///< of the rests, looked at along every arc

  /// Rests from the touches that carry force at the start.
  void findRests()
  {
    ContactGroup group = groupOf(bodies);
    for (Member& m : group.members)
      if (!bodies[m.body].fixed)
        m.acceleration = Vec2(0.0, -field.gravity);
    group.collide(ContactScales());
    for (const Touch& touch : group.touches)
      if (touch.active)
      {
        rests.push_back(Rest());
        rests.back().touch = touch;
      }
  }

  void expand()
  {
    std::vector<Member> members;
    std::vector<int> member_of(bodies.size(), -1);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!bodies[i].fixed)
      {
        member_of[i] = static_cast<int>(members.size());
        members.push_back(memberAt(bodies[i], static_cast<int>(i), now));
      }
    for (Rest& rest : rests)
    {
      Touch& t = rest.touch;
      const Member a = memberAt(bodies[t.a], t.a, now), b = memberAt(bodies[t.b], t.b, now);
      t.member_a = member_of[t.a];
      t.member_b = member_of[t.b];
      locate(t, bodies[t.a], a.frame, bodies[t.b], b.frame);
    }
    flow_.expand(bodies, links, field, now, kOrder, members, rests, works);
    ++arcs;
  }

  void runTo(double seconds)
  {
    const Time target = Time::fromSeconds(seconds);
    while (now < target && arcs < 100000)
    {
      expand();
      Time next = target;
      for (const Body& body : bodies)
        if (!body.fixed)
          next = std::min(next, body.arc.end);
      for (int k = 0; k <= 10; ++k)
        for (const Rest& rest : rests)
        {
          const Time time = now + 0.1 * k * (next - now);
          const Member a = memberAt(bodies[rest.touch.a], 0, time), b = memberAt(bodies[rest.touch.b], 1, time);
          const Face& face = bodies[rest.touch.b].shape->faces[rest.touch.face];
          const Vec2 vertex = a.frame.toWorld(bodies[rest.touch.a].shape->vertices[rest.touch.vertex]);
          worst_gap = std::max(worst_gap, std::abs(face.normal.dot(b.frame.toBody(vertex)) - face.offset));
        }
      now = next;
    }
  }

  Snapshot at(int body) const
  {
    return bodies[body].at(now);
  }

private:
  Flow flow_;
};

using State = std::vector<double>;

/// Classical Runge-Kutta method with steps small enough for rounding to rule: the independent reference.
inline State integrate(const std::function<State(const State&)>& rate, State y, double span, int steps)
{
  const double h = span / steps;
  const auto moved = [](const State& y, double h, const State& k) {
    State result = y;
    for (std::size_t i = 0; i < y.size(); ++i)
      result[i] += h * k[i];
    return result;
  };
  for (int n = 0; n < steps; ++n)
  {
    const State k1 = rate(y), k2 = rate(moved(y, h / 2, k1)), k3 = rate(moved(y, h / 2, k2)),
                k4 = rate(moved(y, h, k3));
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return y;
}

inline void expectState(const Snapshot& now, const State& y, double error)
{
  expectNear(now.position, Vec2(y[0], y[1]), error);
  EXPECT_NEAR(now.angle, y[2], error);
  expectNear(now.velocity, Vec2(y[3], y[4]), 10 * error);
  EXPECT_NEAR(now.omega, y[5], 10 * error);
}

}  // namespace block_world
