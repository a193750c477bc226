#include "flow.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
double cleaned(double sum, double size)
{
  return std::abs(sum) <= kCancelled * size ? 0.0 : sum;
}

/// Position scale times this is the truncation error allowed per arc: rounding.
constexpr double kTruncation = 1e-15;

/// Largest contact force times this is the truncation error allowed for a contact force.
constexpr double kForceTruncation = 1e-13;

/// s; arcs that are no parabolas are expanded anew at least this often, so that bounds over their horizon stay finite.
constexpr double kLongest = 1048576.0;

/// Span, at most horizon, within which the last orders change no velocity by more than the truncation error of the speeds there: positions may be
/// large next to the motion.
double velocityHorizon(const Arc& arc, double radius, int degree, double horizon)
{
  const auto speed = [&](int n) {
    return n * std::max({ std::abs(arc.x[n]), std::abs(arc.y[n]), radius * std::abs(arc.angle[n]) }) * std::pow(horizon, n - 1);
  };
  double scale = 0.0;
  for (int n = 1; n <= degree; ++n)
    scale = std::max(scale, speed(n));
  double span = horizon;
  for (int n : { degree - 1, degree })
    if (speed(n) > kTruncation * scale)
      span = std::min(span, horizon * std::pow(kTruncation * scale / speed(n), 1.0 / (n - 1)));
  return span;
}
}  // namespace

void Flow::begin(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Time& start,
                 const std::vector<Member>& members, std::vector<Rest>& rests)
{
  body_.clear();
  work_.resize(members.size());
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Member& m = members[i];
    Body& body = bodies[m.body];
    body_.push_back(&body);
    body.arc.start = start;
    body.arc.x = body.arc.y = body.arc.angle = Series{};
    body.arc.x[0] = m.frame.position.x();
    body.arc.y[0] = m.frame.position.y();
    body.arc.angle[0] = m.angle;
    body.arc.x[1] = m.velocity.x();
    body.arc.y[1] = m.velocity.y();
    body.arc.angle[1] = m.omega;
    BodyWork& w = work_[i];
    w.c[0] = m.frame.cosine;
    w.s[0] = m.frame.sine;
    w.trigonometric = body.pushed() || body.sprung();
    w.rotating = m.omega != 0.0;
  }
  rests_ = &rests;
  rest_work_.resize(rests.size());
  for (std::size_t i = 0; i < rests.size(); ++i)
  {
    rest_work_[i].a = rests[i].touch.member_a;
    rest_work_[i].b = rests[i].touch.member_b;
    rests[i].force = Series{};
    for (int member : { rest_work_[i].a, rest_work_[i].b })
      if (member >= 0)
        work_[member].trigonometric = true;
  }
  gatherLinks(bodies, links, members);
}

/// Cosine and sine of order n from the angles up to order n.
void Flow::trigonometry(int n)
{
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    BodyWork& w = work_[i];
    if (!w.trigonometric)
      continue;
    double c = 0.0, s = 0.0;
    if (w.rotating)
    {
      const Series& angle = body_[i]->arc.angle;
      for (int j = 1; j <= n; ++j)
      {
        c -= j * angle[j] * w.s[n - j];
        s += j * angle[j] * w.c[n - j];
      }
    }
    w.c[n] = c / n;
    w.s[n] = s / n;
  }
}

/// Accelerations of order n by everything but contact; sizes hold the sums of the absolute values of the terms.
void Flow::freeAcceleration(int n)
{
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    BodyWork& w = work_[i];
    const Body& body = *body_[i];
    const double k = field_->damping * body.inverse_mass * (n + 1);
    w.ax = -k * body.arc.x[n + 1];
    w.ay = -k * body.arc.y[n + 1] - (n == 0 ? field_->gravity : 0.0);
    w.alpha = -field_->rotational_damping * body.inverse_inertia * (n + 1) * body.arc.angle[n + 1];
    w.ax_size = std::abs(w.ax);
    w.ay_size = std::abs(w.ay);
    w.alpha_size = std::abs(w.alpha);
    if (body.pushed())
    {
      w.ax += body.inverse_mass * (w.c[n] * body.push.x() - w.s[n] * body.push.y());
      w.ay += body.inverse_mass * (w.s[n] * body.push.x() + w.c[n] * body.push.y());
      if (n == 0)
        w.alpha += body.inverse_inertia * body.twist;
      const double push = body.inverse_mass * (std::abs(w.c[n]) + std::abs(w.s[n])) * (std::abs(body.push.x()) + std::abs(body.push.y()));
      w.ax_size += push;
      w.ay_size += push;
      w.alpha_size += std::abs(body.inverse_inertia * body.twist);
    }
  }
  for (LinkWork& link : links_)
  {
    springForce(link, n);
    const SpringSeries& v = link.series;
    const auto act = [&](int index, const Series& px, const Series& py, double sign) {
      if (index < 0)
        return;
      BodyWork& w = work_[index];
      const Body& body = *body_[index];
      double torque = 0.0, size = 0.0;
      for (int j = 0; j <= n; ++j)
      {
        const double one = px[j] * v.fy[n - j], other = py[j] * v.fx[n - j];
        torque += one - other;
        size += std::abs(one) + std::abs(other);
      }
      w.ax += sign * body.inverse_mass * v.fx[n];
      w.ay += sign * body.inverse_mass * v.fy[n];
      w.alpha += sign * body.inverse_inertia * torque;
      w.ax_size += std::abs(body.inverse_mass * v.fx[n]);
      w.ay_size += std::abs(body.inverse_mass * v.fy[n]);
      w.alpha_size += body.inverse_inertia * size;
    };
    act(link.first, v.from_x, v.from_y, 1.0);
    act(link.second, v.to_x, v.to_y, -1.0);
  }
}

/// Normal, arm and reach of every rest, order k, and the torque arms of the contact forces.
void Flow::contactGeometry(int k)
{
  for (std::size_t i = 0; i < rest_work_.size(); ++i)
  {
    RestWork& r = rest_work_[i];
    const Touch& t = (*rests_)[i].touch;
    if (k == 0)
    {
      r.nx[0] = t.normal.x();
      r.ny[0] = t.normal.y();
      r.px[0] = t.arm.x();
      r.py[0] = t.arm.y();
      r.dx[0] = t.reach.x();
      r.dy[0] = t.reach.y();
    }
    else
    {
      r.nx[k] = r.ny[k] = r.px[k] = r.py[k] = r.dx[k] = r.dy[k] = 0.0;
      // The vector turned by order 0 times (c, s)_k of the angle relative to the start.
      if (r.a >= 0)
      {
        const BodyWork& w = work_[r.a];
        const double c = w.c[k] * w.c[0] + w.s[k] * w.s[0], s = w.s[k] * w.c[0] - w.c[k] * w.s[0];
        r.px[k] = c * t.arm.x() - s * t.arm.y();
        r.py[k] = s * t.arm.x() + c * t.arm.y();
        r.dx[k] = body_[r.a]->arc.x[k] + r.px[k];
        r.dy[k] = body_[r.a]->arc.y[k] + r.py[k];
      }
      if (r.b >= 0)
      {
        const BodyWork& w = work_[r.b];
        const double c = w.c[k] * w.c[0] + w.s[k] * w.s[0], s = w.s[k] * w.c[0] - w.c[k] * w.s[0];
        r.nx[k] = c * t.normal.x() - s * t.normal.y();
        r.ny[k] = s * t.normal.x() + c * t.normal.y();
        r.dx[k] -= body_[r.b]->arc.x[k];
        r.dy[k] -= body_[r.b]->arc.y[k];
      }
    }
  }
}

/// Contact forces of the orders below n, whose normals turn: their part of order n.
void Flow::contactKnown(int n)
{
  for (std::size_t i = 0; i < rest_work_.size(); ++i)
  {
    RestWork& r = rest_work_[i];
    r.ta[n] = cauchy(r.px, r.ny, n) - cauchy(r.py, r.nx, n);
    r.tb[n] = cauchy(r.dx, r.ny, n) - cauchy(r.dy, r.nx, n);
    const Series& force = (*rests_)[i].force;
    double fx = 0.0, fy = 0.0, ta = 0.0, tb = 0.0, size = 0.0, ta_size = 0.0, tb_size = 0.0;
    for (int j = 0; j < n; ++j)
    {
      fx += force[j] * r.nx[n - j];
      fy += force[j] * r.ny[n - j];
      ta += force[j] * r.ta[n - j];
      tb += force[j] * r.tb[n - j];
      size += std::abs(force[j]) * (std::abs(r.nx[n - j]) + std::abs(r.ny[n - j]));
      ta_size += std::abs(force[j] * r.ta[n - j]);
      tb_size += std::abs(force[j] * r.tb[n - j]);
    }
    const auto act = [&](int index, double sign, double torque, double torque_size) {
      if (index < 0)
        return;
      BodyWork& w = work_[index];
      const Body& body = *body_[index];
      w.ax += sign * body.inverse_mass * fx;
      w.ay += sign * body.inverse_mass * fy;
      w.alpha += sign * body.inverse_inertia * torque;
      w.ax_size += body.inverse_mass * size;
      w.ay_size += body.inverse_mass * size;
      w.alpha_size += body.inverse_inertia * torque_size;
    };
    act(r.a, 1.0, ta, ta_size);
    act(r.b, -1.0, tb, tb_size);
  }
}

/// The force coefficients of order n, which make the gaps' coefficients of order n + 2 vanish:
/// A lambda_n = -(n+1)(n+2) g_{n+2}, with g_{n+2} computed from the accelerations known so far.
void Flow::contactSolve(int n)
{
  const int m = static_cast<int>(rest_work_.size());
  const double divisor = 1.0 / ((n + 1) * (n + 2));
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    Arc& arc = body_[i]->arc;
    arc.x[n + 2] = work_[i].ax * divisor;
    arc.y[n + 2] = work_[i].ay * divisor;
    arc.angle[n + 2] = work_[i].alpha * divisor;
    work_[i].rotating = work_[i].rotating || arc.angle[n + 2] != 0.0;
  }
  trigonometry(n + 2);
  contactGeometry(n + 2);
  rhs_.resize(m);
  for (int i = 0; i < m; ++i)
  {
    const RestWork& r = rest_work_[i];
    const double g = cauchy(r.nx, r.dx, n + 2) + cauchy(r.ny, r.dy, n + 2);
    rhs_[i] = -g / divisor;
  }
  residual_ = rhs_;
  factor_.solve(rhs_.data());
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      residual_[i] -= gram_(i, j) * rhs_[j];
  factor_.solve(residual_.data());
  for (int i = 0; i < m; ++i)
  {
    const double lambda = rhs_[i] + residual_[i];
    (*rests_)[i].force[n] = lambda;
    const RestWork& r = rest_work_[i];
    const auto act = [&](int index, double sign, double torque) {
      if (index < 0)
        return;
      BodyWork& w = work_[index];
      const Body& body = *body_[index];
      w.ax += sign * body.inverse_mass * lambda * r.nx[0];
      w.ay += sign * body.inverse_mass * lambda * r.ny[0];
      w.alpha += sign * body.inverse_inertia * lambda * torque;
      w.ax_size += body.inverse_mass * std::abs(lambda * r.nx[0]);
      w.ay_size += body.inverse_mass * std::abs(lambda * r.ny[0]);
      w.alpha_size += body.inverse_inertia * std::abs(lambda * torque);
    };
    act(r.a, 1.0, r.ta[0]);
    act(r.b, -1.0, r.tb[0]);
  }
}

/// Writes order n + 2 of the arcs. Returns whether anything of it is not zero.
bool Flow::store(int n)
{
  bool any = false;
  const double divisor = 1.0 / ((n + 1) * (n + 2));
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    BodyWork& w = work_[i];
    Arc& arc = body_[i]->arc;
    arc.x[n + 2] = cleaned(w.ax, w.ax_size) * divisor;
    arc.y[n + 2] = cleaned(w.ay, w.ay_size) * divisor;
    arc.angle[n + 2] = cleaned(w.alpha, w.alpha_size) * divisor;
    w.rotating = arc.angle[1] != 0.0 || (w.rotating && n > 0) || arc.angle[n + 2] != 0.0;
    any = any || arc.x[n + 2] != 0.0 || arc.y[n + 2] != 0.0 || arc.angle[n + 2] != 0.0;
  }
  return any;
}

/// After order 2: without springs and (where something turns with a body) rotation, everything else is zero if no velocity changes that damping
/// would act on. Contact forces change along such a parabola only where a vertex slides along the face of a body that moves, whose lever then changes.
bool Flow::endsEarly() const
{
  if (!links_.empty())
    return false;
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    const Arc& arc = body_[i]->arc;
    if (work_[i].rotating && work_[i].trigonometric)
      return false;
    if (field_->damping != 0.0 && (arc.x[2] != 0.0 || arc.y[2] != 0.0 || arc.angle[2] != 0.0))
      return false;
  }
  for (const RestWork& r : rest_work_)
    if (r.b >= 0 && (r.dx[1] != 0.0 || r.dy[1] != 0.0 || r.dx[2] != 0.0 || r.dy[2] != 0.0))
      return false;
  return true;
}

void Flow::finish(const std::vector<Body>& bodies, int degree)
{
  double horizon = std::numeric_limits<double>::infinity();
  if (degree > 2)
  {
    horizon = kLongest;
    double largest = 0.0;
    for (const Rest& rest : *rests_)
      largest = std::max(largest, std::abs(rest.force[0]));
    for (const Rest& rest : *rests_)
      for (int n : { degree - 3, degree - 2 })
        if (rest.force[n] != 0.0)
          horizon = std::min(horizon, 0.8 * std::pow(kForceTruncation * largest / std::abs(rest.force[n]), 1.0 / n));
    for (std::size_t i = 0; i < work_.size(); ++i)
    {
      const Arc& arc = body_[i]->arc;
      const double radius = body_[i]->shape.radius;
      const double size = std::max({ std::abs(arc.x[0]), std::abs(arc.y[0]), radius });
      for (int n : { degree - 1, degree })
      {
        const double top = std::max({ std::abs(arc.x[n]), std::abs(arc.y[n]), radius * std::abs(arc.angle[n]) });
        if (top > 0.0)
          horizon = std::min(horizon, 0.8 * std::pow(kTruncation * size / top, 1.0 / n));
      }
      horizon = std::min(horizon, velocityHorizon(arc, radius, degree, horizon));
      // The series of the directions in the body's frame converge for every span, but keep their digits up to one radian only.
      if (work_[i].trigonometric && arc.angle[1] != 0.0)
        horizon = std::min(horizon, 1.0 / std::abs(arc.angle[1]));
    }
  }
  // A spring whose ends meet turns its direction there: a new arc.
  for (const LinkWork& link : links_)
  {
    if (link.rest_length == 0.0)
      continue;
    Series length = link.series.length;
    if (link.series.coincident)
      std::rotate(length.begin(), length.begin() + 1, length.end());
    if (length[0] > 0.0)
      horizon = std::min(horizon, firstBelow(length, degree - 2, horizon, 0.0));
  }
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    Arc& arc = body_[i]->arc;
    arc.degree = degree;
    while (arc.degree > 0 && arc.x[arc.degree] == 0.0 && arc.y[arc.degree] == 0.0 && arc.angle[arc.degree] == 0.0)
      --arc.degree;
    arc.horizon = horizon;
    arc.end = arc.start + horizon;
    arc.jerk = arc.angular_jerk = 0.0;
    double power = 1.0;
    for (int n = 3; n <= arc.degree; ++n, power *= horizon)
    {
      const double weight = n * (n - 1) * (n - 2) * power;
      arc.jerk += weight * std::hypot(arc.x[n], arc.y[n]);
      arc.angular_jerk += weight * std::abs(arc.angle[n]);
    }
  }
  for (std::size_t i = 0; i < rest_work_.size(); ++i)
  {
    Rest& rest = (*rests_)[i];
    const RestWork& r = rest_work_[i];
    rest.degree = degree;
    rest.along[0] = rest.touch.along;
    const Body& face_body = bodies[rest.touch.b];
    const bool endless = std::isinf(face_body.shape.faces[rest.touch.face].length);
    for (int k = 1; k <= degree && !endless; ++k)
      rest.along[k] = cauchy(r.nx, r.dy, k) - cauchy(r.ny, r.dx, k);
  }
}

void Flow::expand(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Field& field, const Time& start,
                  const std::vector<Member>& members, std::vector<Rest>& rests)
{
  field_ = &field;
  begin(bodies, links, start, members, rests);
  const int m = static_cast<int>(rests.size());
  if (m > 0)
  {
    gram_.resize(m);
    factor_.clear();
    row_.resize(m);
    for (int i = 0; i < m; ++i)
    {
      for (int j = 0; j <= i; ++j)
        gram_(i, j) = gram_(j, i) = row_[j] = contactGram(rests[i].touch, rests[j].touch, members);
      factor_.append(row_.data(), kTrusted);
    }
    contactGeometry(0);
  }
  trigonometry(1);
  contactGeometry(1);
  int degree = kOrder;
  for (int n = 0; n + 2 <= kOrder; ++n)
  {
    freeAcceleration(n);
    if (m > 0)
    {
      contactKnown(n);
      contactSolve(n);
    }
    store(n);
    if (n == 0 && endsEarly())
    {
      degree = 2;
      break;
    }
    trigonometry(n + 2);
    contactGeometry(n + 2);
  }
  finish(bodies, degree);
}

}  // namespace block_world
