// The forces of springs along an arc: a part of Flow.

#include <cmath>

#include "flow.h"

namespace block_world
{
void lengthSeries(SpringSeries& spring, int order)
{
  const int shift = spring.coincident ? 1 : 0;
  VectorSeries& u = spring.u;
  Series& length = spring.length;
  // Coefficients of d / s^shift are those of d further on, so those of its square stand twice as far.
  double square = cauchySquare(spring.d, order + 2 * shift, shift);
  if (spring.coincident)
    length[0] = 0.0;
  if (order == 0)
    length[shift] = std::sqrt(square);
  else
  {
    square -= cauchySquare(length, order + 2 * shift, 1 + shift);
    length[order + shift] = length[shift] > 0.0 ? square / (2.0 * length[shift]) : 0.0;
  }
  const Vec2 rest = spring.d[order + shift] - cauchy(length, u, order + shift, 1 + shift, order + shift);
  // Ends that meet without moving apart have no direction, and pull nowhere.
  u[order] = length[shift] > 0.0 ? Vec2(rest / length[shift]) : Vec2(Vec2::Zero());
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
void Flow::placeEnds(LinkWork& link, int n)
{
  SpringSeries& v = link.series;
  const auto placeOf = [&](int index) { return work_[index].body->arc.order[n].place(); };
  v.from[n] = turned(work_[link.first].direction[n], link.from);
  v.d[n] = placeOf(link.first) + v.from[n];
  if (link.second >= 0)
  {
    v.to[n] = turned(work_[link.second].direction[n], link.to);
    v.d[n] -= placeOf(link.second) + v.to[n];
  }
  else if (n == 0)
    v.d[n] -= link.world;
}

/// Force of a spring on its first end, order n. Needs the positions of order n + 1.
void Flow::springForce(LinkWork& link, int n)
{
  SpringSeries& v = link.series;
  if (n == 0)
    placeEnds(link, 0);
  placeEnds(link, n + 1);
  if (link.rest_length == 0.0)
    v.force = -link.stiffness * v.d[n] - link.damping * (n + 1) * v.d[n + 1];
  else
  {
    if (n == 0)
    {
      const Arc& arc = work_[link.first].body->arc;
      v.coincident = v.d[0].norm() <= kCancelled * (std::abs(arc.order[0].x) + std::abs(arc.order[0].y) + link.rest_length);
    }
    for (int k = n == 0 && !v.coincident ? 0 : n + 1; k <= n + 1; ++k)
      lengthSeries(v, v.coincident ? k - 1 : k);
    v.tension[n] = link.stiffness * (v.length[n] - (n == 0 ? link.rest_length : 0.0)) + link.damping * (n + 1) * v.length[n + 1];
    v.force = -cauchy(v.tension, v.u, n, 0, n);
  }
  v.turned[n] = Vec2(v.force.y(), -v.force.x());
}

}  // namespace block_world
