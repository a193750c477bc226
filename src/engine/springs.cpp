// The forces of springs along an arc: a part of Flow.

#include <cmath>

#include "flow.h"

namespace block_world
{
bool endsMeet(double dx, double dy, double size)
{
  return std::hypot(dx, dy) <= kCancelled * size;
}

void lengthSeries(const Series& dx, const Series& dy, int order, bool coincident, Series& length, Series& ux, Series& uy)
{
  const int shift = coincident ? 1 : 0;
  const auto at = [shift](const Series& series, int n) { return series[n + shift]; };
  double square = 0.0;
  for (int j = 0; j <= order; ++j)
    square += at(dx, j) * at(dx, order - j) + at(dy, j) * at(dy, order - j);
  if (coincident)
    length[0] = 0.0;
  if (order == 0)
    length[shift] = std::sqrt(square);
  else
  {
    for (int j = 1; j < order; ++j)
      square -= at(length, j) * at(length, order - j);
    length[order + shift] = length[shift] > 0.0 ? square / (2.0 * length[shift]) : 0.0;
  }
  double x = at(dx, order), y = at(dy, order);
  for (int j = 1; j <= order; ++j)
  {
    x -= at(length, j) * ux[order - j];
    y -= at(length, j) * uy[order - j];
  }
  // Ends that meet without moving apart have no direction, and pull nowhere.
  ux[order] = length[shift] > 0.0 ? x / length[shift] : 0.0;
  uy[order] = length[shift] > 0.0 ? y / length[shift] : 0.0;
}

void Flow::gatherLinks(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const std::vector<Member>& members)
{
  links_.clear();
  const auto indexOf = [&](int body) {
    for (std::size_t i = 0; i < members.size(); ++i)
      if (members[i].body == body)
        return static_cast<int>(i);
    return -1;
  };
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Body& body = *body_[i];
    if (body.mouse.active)
    {
      LinkWork w;
      w.mouse = &body.mouse;
      w.first = static_cast<int>(i);
      w.first_point = body.mouse.attach;
      w.world = body.mouse.anchor;
      w.stiffness = body.mouse.stiffness;
      w.rest_length = 0.0;
      w.damping = body.mouse.damping;
      links_.push_back(w);
    }
    for (int index : body.springs)
    {
      const SpringLink& link = links[index];
      const int first = indexOf(link.first);
      // A spring between two members is listed by both: take it once.
      if (first >= 0 && first != static_cast<int>(i))
        continue;
      LinkWork w;
      w.link = &link;
      w.first = first;
      w.second = link.second < 0 ? -1 : indexOf(link.second);
      w.first_point = link.first_point;
      w.second_point = link.second_point;
      w.stiffness = link.stiffness;
      w.rest_length = link.rest_length;
      w.damping = link.damping;
      w.world = link.second_point;
      if (w.second < 0 && link.second >= 0)
      {
        const Arc& arc = bodies[link.second].arc;
        w.world = Frame(Vec2(arc.x[0], arc.y[0]), arc.angle[0]).toWorld(link.second_point);
      }
      if (w.first < 0)
      {
        // The first end is on a fixed block: the same spring seen from its other end.
        const Arc& arc = bodies[link.first].arc;
        w.world = Frame(Vec2(arc.x[0], arc.y[0]), arc.angle[0]).toWorld(link.first_point);
        std::swap(w.first, w.second);
        std::swap(w.first_point, w.second_point);
      }
      links_.push_back(w);
    }
  }
}

/// Force of a spring on its first end, order n. Needs the positions of order n + 1.
void Flow::springForce(LinkWork& link, int n)
{
  SpringSeries& v = link.series;
  // Arms and the vector between the ends up to order n + 1; order 0 is made with the first call.
  for (int k = n == 0 ? 0 : n + 1; k <= n + 1; ++k)
  {
    const BodyWork& f = work_[link.first];
    v.from_x[k] = f.c[k] * link.first_point.x() - f.s[k] * link.first_point.y();
    v.from_y[k] = f.s[k] * link.first_point.x() + f.c[k] * link.first_point.y();
    v.dx[k] = body_[link.first]->arc.x[k] + v.from_x[k];
    v.dy[k] = body_[link.first]->arc.y[k] + v.from_y[k];
    if (link.second >= 0)
    {
      const BodyWork& t = work_[link.second];
      v.to_x[k] = t.c[k] * link.second_point.x() - t.s[k] * link.second_point.y();
      v.to_y[k] = t.s[k] * link.second_point.x() + t.c[k] * link.second_point.y();
      v.dx[k] -= body_[link.second]->arc.x[k] + v.to_x[k];
      v.dy[k] -= body_[link.second]->arc.y[k] + v.to_y[k];
    }
    else if (k == 0)
    {
      v.dx[k] -= link.world.x();
      v.dy[k] -= link.world.y();
    }
  }
  if (link.rest_length == 0.0)
  {
    v.fx[n] = -link.stiffness * v.dx[n] - link.damping * (n + 1) * v.dx[n + 1];
    v.fy[n] = -link.stiffness * v.dy[n] - link.damping * (n + 1) * v.dy[n + 1];
    return;
  }
  if (n == 0)
    v.coincident = endsMeet(v.dx[0], v.dy[0], std::abs(body_[link.first]->arc.x[0]) + std::abs(body_[link.first]->arc.y[0]) + link.rest_length);
  for (int k = n == 0 && !v.coincident ? 0 : n + 1; k <= n + 1; ++k)
    lengthSeries(v.dx, v.dy, v.coincident ? k - 1 : k, v.coincident, v.length, v.ux, v.uy);
  double fx = 0.0, fy = 0.0;
  for (int j = 0; j <= n; ++j)
  {
    const double tension = link.stiffness * (v.length[j] - (j == 0 ? link.rest_length : 0.0)) + link.damping * (j + 1) * v.length[j + 1];
    fx -= tension * v.ux[n - j];
    fy -= tension * v.uy[n - j];
  }
  v.fx[n] = fx;
  v.fy[n] = fy;
}

}  // namespace block_world
