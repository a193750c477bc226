// The forces of springs along an arc: a part of Flow.

#include <cmath>

#include "flow.h"

namespace block_world
{
namespace
{
/// Length and direction of the vector d up to an order, from length' = u.d' and length u = d; values of lower orders are there already. Where the
/// ends meet at the start the length is t |e| with e = d / t, so that the order above is needed of d.
///
/// With s = 1 where the ends meet, else 0, and m = order + s, the two equations leave of coefficient m of both
///     L_m u_0 + L_s u_order = A   and   m L_m - s L_s u_0.u_order = B,
/// with A and B of lower orders and of d; hence (m + s) L_m = B + s u_0.A.
void findLength(SpringSeries& spring, int order)
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
    spring.lengthening = shift * spring.d[shift];
    return;
  }
  // Products with the same coefficient of u: of the length, of its derivative, and of that of d.
  Vec2 placed = Vec2::Zero(), lengthened = Vec2::Zero(), moved = spring.rate[top].cwiseProduct(u[0]);
  for (int i = 1 + shift; i < top; ++i)
  {
    const Vec2& direction = u[top - i];
    const Vec2 part = length[i].cwiseProduct(direction);
    placed += part;
    lengthened += i * part;
    moved += spring.rate[i].cwiseProduct(direction);
  }
  const Vec2 rest = spring.d[top] - placed;
  length[top] = Vec2::Constant((moved.sum() + shift * u[0].dot(rest)) / (top + shift));
  const Vec2 end = length[top].cwiseProduct(u[0]);
  u[order] = spring.inverse * (rest - end);
  spring.lengthening = lengthened + top * end + shift * length[shift].cwiseProduct(u[order]);
}
}  // namespace

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
    const Body& body = *work_[i].body;
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
        w.world = Frame(bodies[fixed].arc.order[0].place(), bodies[fixed].arc.order[0].angle).toWorld(second_point);
      else
        w.world = second_point;
    }
  }
  links_.resize(used);
}

/// Arms and the vector between the ends, order n.
inline void Flow::placeEnds(LinkWork& link, int n) const
{
  SpringSeries& v = link.series;
  const BodyWork& first = work_[link.first];
  v.from[n] = turned(first.direction[n], link.from);
  Vec2 d = first.place[n] + v.from[n];
  if (link.second >= 0)
  {
    const BodyWork& second = work_[link.second];
    v.to[n] = turned(second.direction[n], link.to);
    d -= second.place[n] + v.to[n];
  }
  else if (n == 0)
    d -= link.world;
  v.d[n] = d;
  v.rate[n] = n * d;
}

/// Force of a spring on its first end, order n: -k (d - rest_length u) - c length' u. Needs the positions of order n + 1.
void Flow::springForce(LinkWork& link, int n) const
{
  SpringSeries& v = link.series;
  if (n == 0)
    placeEnds(link, 0);
  placeEnds(link, n + 1);
  if (link.rest_length == 0.0)
    v.force = -link.stiffness * v.d[n] - link.damping * v.rate[n + 1];
  else
  {
    if (n == 0)
    {
      v.coincident = v.d[0].norm() <= kCancelled * (work_[link.first].place[0].lpNorm<1>() + link.rest_length);
      if (!v.coincident)
        findLength(v, 0);
    }
    findLength(v, v.coincident ? n : n + 1);
    v.force = -link.stiffness * (v.d[n] - link.rest_length * v.u[n]) - link.damping * v.lengthening;
  }
  v.turned[n] = Vec2(v.force.y(), -v.force.x());
}

/// What a spring does to its bodies, order n.
void Flow::pull(LinkWork& link, int n)
{
  springForce(link, n);
  const SpringSeries& v = link.series;
  const auto act = [&](int index, const VectorSeries& arm, double sign) {
    if (index < 0)
      return;
    BodyWork& w = work_[index];
    const SizedSum torque = sizedProducts(arm, v.turned, n, 0, w.rotating ? n : 0);
    w.act(sign * v.force, v.force.cwiseAbs(), sign * torque.sum.sum(), torque.size.sum());
  };
  act(link.first, v.from, 1.0);
  act(link.second, v.to, -1.0);
}

}  // namespace block_world
