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
}  // namespace

void Flow::begin(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Time& start,
                 const std::vector<Member>& members, std::vector<Rest>& rests)
{
  members_room_.provide(members.size(), work_);
  rests_room_.provide(rests.size(), rest_work_, row_, rhs_, residual_);
  work_.resize(members.size());
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Member& m = members[i];
    Body& body = bodies[m.body];
    body.arc.start = start;
    // What is beyond the degree is zero already.
    for (int n = 2; n <= body.arc.degree; ++n)
      body.arc.order[n] = Coefficients();
    body.arc.order[0] = { m.frame.position.x(), m.frame.position.y(), m.angle };
    body.arc.order[1] = { m.velocity.x(), m.velocity.y(), m.omega };
    BodyWork& w = work_[i];
    w.body = &body;
    w.direction[0] = Vec2(1.0, 0.0);
    w.push = m.frame.rotate(body.push);
    w.trigonometric = body.pushed() || body.sprung();
    w.rotating = false;
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

/// Directions of order n from the angles up to order n: with w the rate of the angle, direction' = w perp(direction).
void Flow::turn(int n)
{
  for (BodyWork& w : work_)
  {
    if (!w.trigonometric)
      continue;
    w.known = w.rotating ? Vec2(perp(cauchy(w.rate, w.direction, n, 1, n - 1)) / n) : Vec2(Vec2::Zero());
    turnTo(w, n);
  }
}

/// The same where the angles of the orders below n have been known before.
void Flow::turnTo(BodyWork& w, int n)
{
  const double angle = w.body->arc.order[n].angle;
  w.rate[n] = n * angle;
  w.direction[n] = w.known + Vec2(0.0, angle);
}

/// Accelerations of order n by everything but contact; sizes hold the sums of the absolute values of the terms.
void Flow::freeAcceleration(int n)
{
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    BodyWork& w = work_[i];
    const Body& body = *w.body;
    const Coefficients& c = body.arc.order[n + 1];
    const double k = field_->damping * body.inverse_mass * (n + 1);
    w.a = Vec2(-k * c.x, -k * c.y - (n == 0 ? field_->gravity : 0.0));
    w.alpha = -field_->rotational_damping * body.inverse_inertia * (n + 1) * c.angle;
    w.a_size = w.a.cwiseAbs();
    w.alpha_size = std::abs(w.alpha);
    if (body.pushed())
    {
      const Vec2& direction = w.direction[n];
      w.a += body.inverse_mass * turned(direction, w.push);
      if (n == 0)
        w.alpha += body.inverse_inertia * body.twist;
      const double push = body.inverse_mass * direction.lpNorm<1>() * w.push.lpNorm<1>();
      w.a_size += Vec2::Constant(push);
      w.alpha_size += std::abs(body.inverse_inertia * body.twist);
    }
  }
  for (LinkWork& link : links_)
  {
    springForce(link, n);
    const SpringSeries& v = link.series;
    const auto act = [&](int index, const VectorSeries& arm, double sign) {
      if (index < 0)
        return;
      BodyWork& w = work_[index];
      const Body& body = *w.body;
      Vec2 torque = Vec2::Zero(), size = Vec2::Zero();
      for (int j = 0; j <= (w.rotating ? n : 0); ++j)
      {
        const Vec2 part = arm[j].cwiseProduct(v.turned[n - j]);
        torque += part;
        size += part.cwiseAbs();
      }
      w.a += sign * body.inverse_mass * v.force;
      w.alpha += sign * body.inverse_inertia * torque.sum();
      w.a_size += (body.inverse_mass * v.force).cwiseAbs();
      w.alpha_size += body.inverse_inertia * size.sum();
    };
    act(link.first, v.from, 1.0);
    act(link.second, v.to, -1.0);
  }
}

/// Normal, arm and reach of every rest, order n.
void Flow::placeRests(int n)
{
  for (std::size_t i = 0; i < rest_work_.size(); ++i)
  {
    RestWork& r = rest_work_[i];
    const Touch& t = (*rests_)[i].touch;
    if (n == 0)
    {
      r.normal[0] = t.normal;
      r.arm[0] = t.arm;
      r.reach[0] = t.reach;
    }
    else
    {
      r.normal[n] = r.b >= 0 ? turned(work_[r.b].direction[n], t.normal) : Vec2(Vec2::Zero());
      r.arm[n] = r.a >= 0 ? turned(work_[r.a].direction[n], t.arm) : Vec2(Vec2::Zero());
      r.reach[n] = r.arm[n];
      if (r.a >= 0)
        r.reach[n] += work_[r.a].body->arc.order[n].place();
      if (r.b >= 0)
        r.reach[n] -= work_[r.b].body->arc.order[n].place();
    }
    r.turned[n] = -perp(r.normal[n]);
  }
}

/// Torques of 1 N at every rest, order n. Of a normal that does not turn there is the order 0 only.
void Flow::findLevers(int n)
{
  for (RestWork& r : rest_work_)
  {
    const int first = turns(r) ? 0 : n;
    r.levers[n] = Vec2(cauchy(r.arm, r.turned, n, first, n), cauchy(r.reach, r.turned, n, first, n));
  }
}

/// Contact forces of the orders below n, whose normals and levers turn: their part of order n.
void Flow::contactKnown(int n)
{
  findLevers(n);
  for (std::size_t i = 0; i < rest_work_.size(); ++i)
  {
    const RestWork& r = rest_work_[i];
    const Series& force = (*rests_)[i].force;
    Vec2 sum = Vec2::Zero(), size = Vec2::Zero(), torque = Vec2::Zero(), torque_size = Vec2::Zero();
    for (int j = 0; j < n; ++j)
    {
      const Vec2 part = force[j] * r.levers[n - j];
      torque += part;
      torque_size += part.cwiseAbs();
    }
    for (int j = turns(r) ? 0 : n; j < n; ++j)
    {
      const Vec2 part = force[j] * r.normal[n - j];
      sum += part;
      size += part.cwiseAbs();
    }
    const auto act = [&](int index, double sign, double torque, double torque_size) {
      if (index < 0)
        return;
      BodyWork& w = work_[index];
      const Body& body = *w.body;
      w.a += sign * body.inverse_mass * sum;
      w.alpha += sign * body.inverse_inertia * torque;
      w.a_size += Vec2::Constant(body.inverse_mass * size.sum());
      w.alpha_size += body.inverse_inertia * torque_size;
    };
    act(r.a, 1.0, torque.x(), torque_size.x());
    act(r.b, -1.0, torque.y(), torque_size.y());
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
    Arc& arc = work_[i].body->arc;
    arc.order[n + 2] = { work_[i].a.x() * divisor, work_[i].a.y() * divisor, work_[i].alpha * divisor };
  }
  turn(n + 2);
  placeRests(n + 2);
  rhs_.resize(m);
  for (int i = 0; i < m; ++i)
  {
    const RestWork& r = rest_work_[i];
    double g = r.normal[0].dot(r.reach[n + 2]) + r.normal[n + 2].dot(r.reach[0]);
    if (turns(r))
      g += cauchy(r.normal, r.reach, n + 2, 1, n + 1);
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
      const Body& body = *w.body;
      w.a += sign * body.inverse_mass * lambda * r.normal[0];
      w.alpha += sign * body.inverse_inertia * lambda * torque;
      w.a_size += body.inverse_mass * (lambda * r.normal[0]).cwiseAbs();
      w.alpha_size += body.inverse_inertia * std::abs(lambda * torque);
    };
    act(r.a, 1.0, r.levers[0].x());
    act(r.b, -1.0, r.levers[0].y());
  }
}

/// Writes order n + 2 of the arcs and what turns with it. Returns false, with that order zero, where it is so large that squares would overflow: of
/// a motion within some 1e-6 s or less, which lower orders tell as well.
bool Flow::store(int n)
{
  constexpr double kLargest = 1e130;
  bool fits = true;
  const double divisor = 1.0 / ((n + 1) * (n + 2));
  for (BodyWork& w : work_)
  {
    Coefficients& c = w.body->arc.order[n + 2];
    c.x = cleaned(w.a.x(), w.a_size.x()) * divisor;
    c.y = cleaned(w.a.y(), w.a_size.y()) * divisor;
    c.angle = cleaned(w.alpha, w.alpha_size) * divisor;
    w.rotating = w.rotating || c.angle != 0.0;
    fits = fits && std::abs(c.x) < kLargest && std::abs(c.y) < kLargest && std::abs(c.angle) < kLargest;
  }
  if (rest_work_.empty())
    turn(n + 2);
  else
    for (BodyWork& w : work_)
      turnTo(w, n + 2);
  placeRests(n + 2);
  if (n < 3 || fits)
    return true;
  for (BodyWork& w : work_)
    w.body->arc.order[n + 2] = Coefficients();
  for (Rest& rest : *rests_)
    rest.force[n] = 0.0;
  return false;
}

/// After order 2: without springs and (where something turns with a body) rotation, everything else is zero if no velocity changes that damping
/// would act on. Contact forces change along such a parabola only where a vertex slides along the face of a body that moves, whose lever then changes.
bool Flow::endsEarly() const
{
  if (!links_.empty())
    return false;
  for (std::size_t i = 0; i < work_.size(); ++i)
  {
    const Coefficients& c = work_[i].body->arc.order[2];
    if (work_[i].rotating && work_[i].trigonometric)
      return false;
    if (field_->damping != 0.0 && (c.x != 0.0 || c.y != 0.0 || c.angle != 0.0))
      return false;
  }
  for (const RestWork& r : rest_work_)
    if (r.b >= 0 && !(r.reach[1].isZero(0.0) && r.reach[2].isZero(0.0)))
      return false;
  return true;
}

void Flow::expand(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Field& field, const Time& start, int order,
                  const std::vector<Member>& members, std::vector<Rest>& rests, Works& works)
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
    placeRests(0);
  }
  turn(1);
  for (std::size_t i = 0; i < work_.size(); ++i)
    work_[i].rotating = members[i].omega != 0.0;
  placeRests(1);
  int degree = order;
  for (int n = 0; n + 2 <= order; ++n)
  {
    freeAcceleration(n);
    if (m > 0)
    {
      contactKnown(n);
      contactSolve(n);
    }
    if (!store(n))
    {
      degree = n + 1;
      break;
    }
    if (n == 0 && endsEarly())
    {
      degree = 2;
      break;
    }
  }
  finish(bodies, degree);
  findWorks(degree, works);
}

}  // namespace block_world
