// The forces of springs along an arc: a part of Flow.

#include <cmath>

#include "flow.h"

namespace block_world
{
/// With s = 1 where the ends meet, else 0, and m = order + s, the two equations leave of coefficient m of both
///     L_m u_0 + L_s u_order = A   and   m L_m - s L_s u_0.u_order = B,
/// with A and B of lower orders and of d; hence (m + s) L_m = B + s u_0.A.
void lengthSeries(SpringSeries& spring, int order)
{
  const int shift = spring.coincident ? 1 : 0, top = order + shift;
  VectorSeries &u = spring.u, &length = spring.length;
  if (order == 0)
  {
    const double first = spring.d[shift].norm();
    // Ends that meet without moving apart have no direction, and pull nowhere.
    spring.inverse = first > 0.0 ? 1.0 / first : 0.0;
    u[0] = spring.inverse * spring.d[shift];
    length[0] = Vec2::Zero();
    length[shift] = Vec2::Constant(first);
  }
  else
  {
    const Vec2 rest = spring.d[top] - products(length, u, top, 1 + shift, top - 1);
    double known = cauchy(u, spring.rate, top - 1, 0, order - 1);
    if (spring.coincident)
      known += u[0].dot(rest);
    length[top] = Vec2::Constant(known / (top + shift));
    u[order] = spring.inverse * (rest - length[top].cwiseProduct(u[0]));
  }
  if (top > 0)
    spring.lengthening[top - 1] = top * length[top];
}

void Flow::gatherLinks(const std::vector<Body>& bodies, const std::vector<SpringLink>& links, const std::vector<Member>& members)
{
  const auto indexOf = [&](int body) {
    for (std::size_t i = 0; i < members.size(); ++i)
      if (members[i].body == body)
        return static_cast<int>(i);
    return -1;
  };
  // The series of former links are written over.
  std::size_t used = 0;
  const auto add = [&](double stiffness, double rest_length, double damping) -> LinkWork& {
    if (used == links_.size())
      links_.emplace_back();
    LinkWork& w = links_[used++];
    w.first = w.second = -1;
    w.stiffness = stiffness;
    w.rest_length = rest_length;
    w.damping = damping;
    return w;
  };
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Body& body = *body_[i];
    if (body.mouse.active)
    {
      LinkWork& w = add(body.mouse.stiffness, 0.0, body.mouse.damping);
      w.first = static_cast<int>(i);
      w.from = members[i].frame.rotate(body.mouse.attach);
      w.world = body.mouse.anchor;
    }
    for (int index : body.springs)
    {
      const SpringLink& link = links[index];
      int first = indexOf(link.first), second = link.second < 0 ? -1 : indexOf(link.second);
      // A spring between two members is listed by both: take it once.
      if (first >= 0 && first != static_cast<int>(i))
        continue;
      LinkWork& w = add(link.stiffness, link.rest_length, link.damping);
      Vec2 first_point = link.first_point, second_point = link.second_point;
      int fixed = link.second;
      if (first < 0)
      {
        // The first end is on a fixed block: the same spring seen from its other end.
        std::swap(first, second);
        std::swap(first_point, second_point);
        fixed = link.first;
      }
      w.first = first;
      w.second = second;
      w.from = members[first].frame.rotate(first_point);
      if (second >= 0)
        w.to = members[second].frame.rotate(second_point);
      else if (fixed >= 0)
        w.world = Frame(Vec2(bodies[fixed].arc.x[0], bodies[fixed].arc.y[0]), bodies[fixed].arc.angle[0]).toWorld(second_point);
      else
        w.world = second_point;
    }
  }
  links_.resize(used);
}

/// Arms and the vector between the ends, order n.
void Flow::placeEnds(LinkWork& link, int n)
{
  SpringSeries& v = link.series;
  const BodyWork& first = work_[link.first];
  v.from[n] = turned(first.direction[n], link.from);
  v.d[n] = first.place[n] + v.from[n];
  if (link.second >= 0)
  {
    const BodyWork& second = work_[link.second];
    v.to[n] = turned(second.direction[n], link.to);
    v.d[n] -= second.place[n] + v.to[n];
  }
  else if (n == 0)
    v.d[n] -= link.world;
  if (n > 0)
    v.rate[n - 1] = n * v.d[n];
}

/// Force of a spring on its first end, order n: -k (d - rest_length u) - c length' u. Needs the positions of order n + 1.
void Flow::springForce(LinkWork& link, int n)
{
  SpringSeries& v = link.series;
  if (n == 0)
    placeEnds(link, 0);
  placeEnds(link, n + 1);
  if (link.rest_length == 0.0)
    v.force = -link.stiffness * v.d[n] - link.damping * v.rate[n];
  else
  {
    if (n == 0)
      v.coincident = v.d[0].norm() <= kCancelled * (work_[link.first].place[0].lpNorm<1>() + link.rest_length);
    for (int k = n == 0 && !v.coincident ? 0 : n + 1; k <= n + 1; ++k)
      lengthSeries(v, v.coincident ? k - 1 : k);
    v.force = -link.stiffness * (v.d[n] - link.rest_length * v.u[n]);
    if (link.damping != 0.0)
      v.force -= link.damping * products(v.lengthening, v.u, n, 0, n);
  }
  v.turned[n] = Vec2(v.force.y(), -v.force.x());
}

}  // namespace block_world
