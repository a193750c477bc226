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
  const Coefficients& c = arc.order[n];
  return std::max({ std::abs(c.x), std::abs(c.y), radius * std::abs(c.angle) });
}

/// Bounds of the third derivatives over the horizon.
void findJerk(Arc& arc)
{
  Vec2 jerk = Vec2::Zero();
  arc.angular_jerk = 0.0;
  double power = 1.0;
  for (int n = 3; n <= arc.degree; ++n, power *= arc.horizon)
  {
    const double weight = n * (n - 1) * (n - 2) * power;
    jerk += weight * arc.order[n].place().cwiseAbs();
    arc.angular_jerk += weight * std::abs(arc.order[n].angle);
  }
  arc.jerk = jerk.norm();
}

/// Coefficients of the derivative.
Series rateOf(const Series& c, int degree)
{
  Series rate;
  for (int n = 0; n < degree; ++n)
    rate[n] = (n + 1) * c[n + 1];
  return rate;
}

/// Adds to a power a factor times the square of a series of that degree. Order n of the power is order n + 1 of the work.
void addSquare(ProductSeries& work, double factor, Series rate, int degree)
{
  for (int i = 0; i <= degree; ++i)
  {
    const double twice = 2.0 * factor * rate[i];
    double* from = &work[2 * i + 1];
    from[0] += 0.5 * twice * rate[i];
    for (int j = 1; j <= degree - i; ++j)
      from[j] += twice * rate[i + j];
  }
}

/// From the power to the work.
void integrate(Work& work)
{
  for (int n = 1; n <= work.degree; ++n)
    work.series[n] /= n;
}
}  // namespace

/// Span s within which the first order left out, degree + 1, changes no position, direction, velocity or force by more than the truncation error of
/// its scale. Orders of a series fall like r^n with r = s / (radius of convergence), or faster, so that eps = r^(degree + 1) asks of order n that
/// its share of the scale is at most eps^(n / (degree + 1)). The last two orders are asked. For velocities the scale is that of the speeds there:
/// positions may be large next to the motion. Spans are found by their logarithms to the base of 2.
double Flow::horizon(int degree) const
{
  double span = std::log2(kLongest);
  const auto atMost = [&span](double share, double allowed, int n) {
    if (share > 0.0)
      span = std::min(span, allowed - std::log2(share) / n);
  };
  const double truncation = std::log2(kTruncation);
  for (int n : { degree - 1, degree })
  {
    double share = 0.0;
    for (const BodyWork& w : work_)
    {
      const Arc& arc = w.body->arc;
      const double radius = w.body->shape->radius, size = std::max({ std::abs(arc.order[0].x), std::abs(arc.order[0].y), radius });
      share = std::max(share, sizeOf(arc, radius, n) / size);
      if (w.trigonometric)
        share = std::max(share, radius * w.direction[n].lpNorm<Eigen::Infinity>() / size);
    }
    atMost(share, truncation / (degree + 1), n);
  }

  double largest = 0.0;
  for (const Rest& rest : *rests_)
    largest = std::max(largest, std::abs(rest.force[0]));
  if (largest > 0.0)
    for (int n : { degree - 3, degree - 2 })
    {
      double most = 0.0;
      for (const Rest& rest : *rests_)
        most = std::max(most, std::abs(rest.force[n]));
      atMost(most / largest, std::log2(kForceTruncation) / (degree - 1), n);
    }

  // Velocities over the span found: their shares are known where it ends, and it shrinks by what they are too large.
  double shares[] = { 0.0, 0.0 };
  const double all = std::exp2(span);
  for (const BodyWork& w : work_)
  {
    double scale = 0.0, power = 1.0, speed = 0.0, before = 0.0;
    for (int n = 1; n <= degree; ++n, power *= all)
    {
      before = speed;
      speed = n * sizeOf(w.body->arc, w.body->shape->radius, n) * power;
      scale = std::max(scale, speed);
    }
    if (scale > 0.0)
    {
      shares[0] = std::max(shares[0], before / scale);
      shares[1] = std::max(shares[1], speed / scale);
    }
  }
  const double allowed = span + truncation / degree;
  for (int k : { 0, 1 })
    atMost(shares[k], allowed, degree - 2 + k);
  return std::exp2(span);
}

void Flow::finish(const std::vector<Body>& bodies, int degree)
{
  double span = degree > 2 ? horizon(degree) : std::numeric_limits<double>::infinity();
  // A spring whose ends meet turns its direction there: a new arc.
  for (const LinkWork& link : links_)
  {
    if (link.rest_length == 0.0)
      continue;
    // Divided by the time where the ends meet at the start.
    Series length;
    for (int n = 0; n <= degree - 2; ++n)
      length[n] = link.series.length[link.series.coincident ? n + 1 : n].x();
    if (length[0] > 0.0)
      span = std::min(span, firstBelow(length, degree - 2, span, 0.0));
  }
  for (const BodyWork& w : work_)
  {
    Arc& arc = w.body->arc;
    arc.degree = degree;
    while (arc.degree > 0 && arc.order[arc.degree].isZero())
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
    ends = ends || !std::isinf(bodies[rest.touch.b].shape->faces[rest.touch.face].length);
  }
  // The way along the face is perp(n).d, the torque on its body d x n.
  if (ends)
  {
    for (std::size_t i = 0; i < rest_work_.size(); ++i)
    {
      for (int n = degree - 1; n <= degree; ++n)
        findLevers(rest_work_[i], n);
      for (int n = 1; n <= degree; ++n)
        (*rests_)[i].along[n] = -rest_work_[i].levers[n].y();
    }
  }
}

void Flow::findWorks(int degree, Works& works)
{
  const bool pushed = std::any_of(work_.begin(), work_.end(), [](const BodyWork& w) { return w.pushed; });
  const bool damped = field_->damping > 0.0 || std::any_of(links_.begin(), links_.end(), [](const LinkWork& link) { return link.damping != 0.0; });
  const int last = degree - 1;  // of velocities
  works.thrust.degree = pushed ? degree + last + 1 : 0;
  works.loss.degree = damped ? 2 * last + 1 : 0;
  for (Work* work : { &works.thrust, &works.loss })
    std::fill_n(work->series.begin(), work->degree + 1, 0.0);
  for (const BodyWork& w : work_)
  {
    const Body& body = *w.body;
    if (field_->damping > 0.0)
    {
      addSquare(works.loss.series, field_->damping, rateOf(body.arc.series(&Coefficients::x), degree), last);
      addSquare(works.loss.series, field_->damping, rateOf(body.arc.series(&Coefficients::y), degree), last);
      addSquare(works.loss.series, field_->rotational_damping, rateOf(body.arc.series(&Coefficients::angle), degree), last);
    }
    if (!w.pushed)
      continue;
    VectorSeries rate, force;
    for (int n = 0; n <= last; ++n)
      rate[n] = (n + 1) * body.arc.order[n + 1].place();
    for (int n = 0; n <= degree; ++n)
      force[n] = turned(w.direction[n], w.push);
    for (int n = 0; n <= degree + last; ++n)
      works.thrust.series[n + 1] += cauchy(force, rate, n, std::max(0, n - last), std::min(n, degree));
    for (int n = 0; n <= last; ++n)
      works.thrust.series[n + 1] += body.twist * (n + 1) * body.arc.order[n + 1].angle;
  }
  for (LinkWork& link : links_)
  {
    if (link.damping == 0.0)
      continue;
    // With it the ends are placed up to the degree.
    springForce(link, last);
    const bool has_length = link.rest_length != 0.0;
    Series x, y;
    for (int n = 0; n <= last; ++n)
    {
      const Vec2 rate = has_length ? Vec2((n + 1) * link.series.length[n + 1]) : link.series.rate[n + 1];
      x[n] = rate.x();
      y[n] = rate.y();
    }
    addSquare(works.loss.series, link.damping, x, last);
    if (!has_length)
      addSquare(works.loss.series, link.damping, y, last);
  }
  integrate(works.thrust);
  integrate(works.loss);
}

}  // namespace block_world
