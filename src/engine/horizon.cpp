// How long the arcs of an island last, and what follows from them: a part of Flow.

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow.h"

namespace block_world
{
namespace
{
/// Position scale times this is the truncation error allowed per arc: rounding.
constexpr double kTruncation = 2e-16;

/// Largest contact force times this is the truncation error allowed for a contact force.
constexpr double kForceTruncation = 1e-13;

/// s; arcs that are no parabolas are expanded anew at least this often, so that bounds over their horizon stay finite.
constexpr double kLongest = 1048576.0;

/// Size of order n of an arc, m / s^n.
double sizeOf(const Arc& arc, double radius, int n)
{
  return std::max({ std::abs(arc.x[n]), std::abs(arc.y[n]), radius * std::abs(arc.angle[n]) });
}

/// Bounds of the third derivatives over the horizon.
void findJerk(Arc& arc)
{
  arc.jerk = arc.angular_jerk = 0.0;
  double power = 1.0;
  for (int n = 3; n <= arc.degree; ++n, power *= arc.horizon)
  {
    const double weight = n * (n - 1) * (n - 2) * power;
    arc.jerk += weight * std::sqrt(arc.x[n] * arc.x[n] + arc.y[n] * arc.y[n]);
    arc.angular_jerk += weight * std::abs(arc.angle[n]);
  }
}
}  // namespace

/// Span s within which the first order left out, degree + 1, changes no position, direction, velocity or force by more than the truncation error of
/// its scale. Orders of a series fall like r^n with r = s / (radius of convergence), or faster, so that eps = r^(degree + 1) asks of order n that
/// its share of the scale is at most eps^(n / (degree + 1)). The last two orders are asked. For velocities the scale is that of the speeds there:
/// positions may be large next to the motion.
double Flow::horizon(int degree) const
{
  double span = kLongest;
  const auto atMost = [&span](double share, double allowed, int n) {
    if (share > 0.0)
      span = std::min(span, allowed * std::pow(share, -1.0 / n));
  };
  const double allowed = std::pow(kTruncation, 1.0 / (degree + 1));
  for (int n : { degree - 1, degree })
  {
    double share = 0.0;
    for (std::size_t i = 0; i < work_.size(); ++i)
    {
      const Arc& arc = body_[i]->arc;
      const double radius = body_[i]->shape.radius, size = std::max({ std::abs(arc.x[0]), std::abs(arc.y[0]), radius });
      share = std::max(share, sizeOf(arc, radius, n) / size);
      if (work_[i].trigonometric)
        share = std::max(share, radius * work_[i].direction[n].lpNorm<Eigen::Infinity>() / size);
    }
    atMost(share, allowed, n);
  }

  double largest = 0.0;
  for (const Rest& rest : *rests_)
    largest = std::max(largest, std::abs(rest.force[0]));
  for (int n : { degree - 3, degree - 2 })
  {
    double most = 0.0;
    for (const Rest& rest : *rests_)
      most = std::max(most, std::abs(rest.force[n]));
    if (largest > 0.0)
      atMost(most / largest, std::pow(kForceTruncation, 1.0 / (degree - 1)), n);
  }

  // Velocities over the span found: their shares are known where it ends, and it shrinks by what they are too large.
  double shares[] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    const Arc& arc = body_[i]->arc;
    double scale = 0.0, power = 1.0, speed = 0.0, before = 0.0;
    for (int n = 1; n <= degree; ++n, power *= span)
    {
      before = speed;
      speed = n * sizeOf(arc, body_[i]->shape.radius, n) * power;
      scale = std::max(scale, speed);
    }
    if (scale > 0.0)
    {
      shares[0] = std::max(shares[0], before / scale);
      shares[1] = std::max(shares[1], speed / scale);
    }
  }
  const double all = span, allowed_speed = std::pow(kTruncation, 1.0 / degree);
  for (int k : { 0, 1 })
    atMost(shares[k], all * allowed_speed, degree - 2 + k);
  return span;
}

void Flow::finish(const std::vector<Body>& bodies, int degree)
{
  double span = degree > 2 ? horizon(degree) : std::numeric_limits<double>::infinity();
  // A spring whose ends meet turns its direction there: a new arc.
  for (const LinkWork& link : links_)
  {
    if (link.rest_length == 0.0)
      continue;
    // Divided by s where the ends meet at the start.
    Series length;
    for (int n = 0; n <= degree - 2; ++n)
      length[n] = link.series.length[link.series.coincident ? n + 1 : n].x();
    if (length[0] > 0.0)
      span = std::min(span, firstBelow(length, degree - 2, span, 0.0));
  }
  for (Body* body : body_)
  {
    Arc& arc = body->arc;
    arc.degree = degree;
    while (arc.degree > 0 && arc.x[arc.degree] == 0.0 && arc.y[arc.degree] == 0.0 && arc.angle[arc.degree] == 0.0)
      --arc.degree;
    arc.horizon = span;
    arc.end = arc.start + span;
    findJerk(arc);
  }
  bool ends = false;
  for (Rest& rest : *rests_)
  {
    rest.degree = degree;
    rest.along[0] = rest.touch.along;
    ends = ends || !std::isinf(bodies[rest.touch.b].shape.faces[rest.touch.face].length);
  }
  // The way along the face is perp(n).d, the torque on its body d x n.
  if (ends)
  {
    for (int n = degree - 1; n <= degree; ++n)
      findLevers(n);
    for (std::size_t i = 0; i < rest_work_.size(); ++i)
      for (int n = 1; n <= degree; ++n)
        (*rests_)[i].along[n] = -rest_work_[i].levers[n].y();
  }
}

void Flow::findWorks(int degree, Works& works)
{
  works.degree = 0;
  bool any = field_->damping > 0.0;
  for (const Body* body : body_)
    any = any || body->pushed();
  for (const LinkWork& link : links_)
    any = any || link.damping != 0.0;
  if (!any)
    return;
  works.degree = 2 * degree;
  works.thrust.fill(0.0);
  works.loss.fill(0.0);
  VectorSeries rate, force;
  Series spin, lengthening;
  // Powers, as products of series that end: order n of a power is order n + 1 of the work.
  const int last = degree - 1;
  const auto lose = [&](double damping, const auto& velocity) {
    for (int n = 0; n <= 2 * last; ++n)
      works.loss[n + 1] += damping * cauchySquare(velocity, n, std::max(0, n - last));
  };
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    const BodyWork& w = work_[i];
    const Body& body = *body_[i];
    for (int n = 0; n <= last; ++n)
    {
      rate[n] = (n + 1) * Vec2(body.arc.x[n + 1], body.arc.y[n + 1]);
      spin[n] = (n + 1) * body.arc.angle[n + 1];
    }
    if (field_->damping > 0.0)
    {
      lose(field_->damping, rate);
      lose(field_->rotational_damping, spin);
    }
    if (!body.pushed())
      continue;
    for (int n = 0; n <= degree; ++n)
      force[n] = turned(w.direction[n], w.push);
    for (int n = 0; n <= degree + last; ++n)
      works.thrust[n + 1] += cauchy(force, rate, n, std::max(0, n - last), std::min(n, degree)) + (n <= last ? body.twist * spin[n] : 0.0);
  }
  for (LinkWork& link : links_)
  {
    if (link.damping == 0.0)
      continue;
    placeEnds(link, degree);
    if (link.rest_length == 0.0)
    {
      lose(link.damping, link.series.rate);
      continue;
    }
    lengthSeries(link.series, link.series.coincident ? degree - 1 : degree);
    for (int n = 0; n <= last; ++n)
      lengthening[n] = link.series.lengthening[n].x();
    lose(link.damping, lengthening);
  }
  for (int n = 1; n <= works.degree; ++n)
  {
    works.thrust[n] /= n;
    works.loss[n] /= n;
  }
}

}  // namespace block_world
