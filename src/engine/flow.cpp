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
  rests_room_.provide(rests.size(), rest_work_, row_, forces_, residual_);
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
    w.inverse_mass = body.inverse_mass;
    w.inverse_inertia = body.inverse_inertia;
    w.place[0] = m.frame.position;
    w.place[1] = m.velocity;
    w.direction[0] = Vec2(1.0, 0.0);
    w.push = m.frame.rotate(body.push);
    w.direction[1] = Vec2(0.0, m.omega);
    w.rate[1] = Vec2::Constant(m.omega);
    w.pushed = body.pushed();
    w.trigonometric = w.pushed || body.sprung();
    w.rotating = m.omega != 0.0;
  }
  rests_ = &rests;
  rest_work_.resize(rests.size());
  for (std::size_t i = 0; i < rests.size(); ++i)
  {
    RestWork& r = rest_work_[i];
    const Touch& t = rests[i].touch;
    r.a = t.member_a;
    r.b = t.member_b;
    r.normal[0] = t.normal;
    r.turned[0] = -perp(t.normal);
    r.arm[0] = t.arm;
    r.reach[0] = t.reach;
    r.along = Vec2(t.normal.dot(t.arm), t.normal.dot(t.reach));
    rests[i].force = Series{};
    for (int member : { r.a, r.b })
      if (member >= 0)
        work_[member].trigonometric = true;
  }
  gatherLinks(bodies, links, members);
}

/// Accelerations of order n by everything but contact, and the directions two orders on but for their angle's coefficient: with w the rate of the
/// angle, direction' = w perp(direction).
void Flow::freeAcceleration(int n)
{
  const double damping = -(n + 1) * field_->damping, share = 1.0 / (n + 2);
  for (BodyWork& w : work_)
  {
    w.a = damping * w.inverse_mass * w.place[n + 1];
    if (n == 0)
      w.a.y() -= field_->gravity;
    w.alpha = -field_->rotational_damping * w.inverse_inertia * w.rate[n + 1].x();
    w.a_size = w.a.cwiseAbs();
    w.alpha_size = std::abs(w.alpha);
    if (w.pushed)
    {
      const Vec2& direction = w.direction[n];
      const double twist = n == 0 ? w.body->twist : 0.0;
      w.act(turned(direction, w.push), Vec2::Constant(direction.lpNorm<1>() * w.push.lpNorm<1>()), twist, std::abs(twist));
    }
    w.known = w.trigonometric && w.rotating ? Vec2(share * perp(products(w.rate, w.direction, n + 2, 1, n + 1))) : Vec2(Vec2::Zero());
  }
  for (LinkWork& link : links_)
    pull(link, n);
}

/// Normal, arm and reach of every rest, order n.
void Flow::placeRests(int n)
{
  for (RestWork& r : rest_work_)
  {
    r.arm[n] = r.a >= 0 ? turned(work_[r.a].direction[n], r.arm[0]) : Vec2(Vec2::Zero());
    Vec2 reach = r.arm[n];
    if (r.a >= 0)
      reach += work_[r.a].place[n];
    if (r.b >= 0)
    {
      reach -= work_[r.b].place[n];
      r.normal[n] = turned(work_[r.b].direction[n], r.normal[0]);
      r.turned[n] = -perp(r.normal[n]);
    }
    r.reach[n] = reach;
  }
}

/// Torques of 1 N at a rest, order n. Of a normal that does not turn there is the order 0 only.
void Flow::findLevers(RestWork& r, int n)
{
  if (turns(r))
    r.levers[n] = Vec2(cauchy(r.arm, r.turned, n, 0, n), cauchy(r.reach, r.turned, n, 0, n));
  else
    r.levers[n] = Vec2(r.arm[n].dot(r.turned[0]), r.reach[n].dot(r.turned[0]));
}

/// A rest's force acts on both of its bodies, with its torques on them.
inline void Flow::push(const RestWork& rest, const SizedSum& force, const SizedSum& torque)
{
  if (rest.a >= 0)
    work_[rest.a].act(force.sum, force.size, torque.sum.x(), torque.size.x());
  if (rest.b >= 0)
    work_[rest.b].act(-force.sum, force.size, -torque.sum.y(), torque.size.y());
}

/// Contact forces of the orders below n, whose normals and levers turn: their part of order n.
void Flow::contactKnown(int n)
{
  for (RestWork& r : rest_work_)
  {
    findLevers(r, n);
    if (n == 0)
      continue;
    SizedSum force;
    if (turns(r))
    {
      force = sizedProducts(r.force, r.normal, n, 0, n - 1);
      force.size = Vec2::Constant(force.size.sum());
    }
    push(r, force, sizedProducts(r.force, r.levers, n, 0, n - 1));
  }
}

/// (n + 1)(n + 2) times the gap's coefficient of order n + 2, from the accelerations known so far: J q'' and what the turning of arm and normal adds,
/// of which the lower orders decide all but the angles' coefficients of this order, which are in J q''.
inline double Flow::gapAcceleration(const RestWork& r, int n) const
{
  const double factor = (n + 1) * (n + 2);
  double turning = turns(r) ? factor * cauchy(r.normal, r.reach, n + 2, 1, n + 1) : 0.0;
  Vec2 apart = Vec2::Zero();
  if (r.a >= 0)
  {
    const BodyWork& w = work_[r.a];
    apart += w.a;
    turning += r.levers[0].x() * (w.alpha + factor * w.known.y()) + factor * w.known.x() * r.along.x();
  }
  if (r.b >= 0)
  {
    const BodyWork& w = work_[r.b];
    apart -= w.a;
    turning += factor * w.known.x() * r.along.y() - r.levers[0].y() * (w.alpha + factor * w.known.y());
  }
  return r.normal[0].dot(apart) + turning;
}

/// Solves A lambda = forces_, with one step of iterative refinement at order 0, the forces at the start, of which higher orders are small shares, and
/// where touches depend on each other nearly.
void Flow::solveForces(int n)
{
  const int m = factor_.size();
  residual_ = forces_;
  factor_.solve(forces_.data());
  if (n > 0 && !factor_.doubtful())
    return;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      residual_[i] -= gram_(i, j) * forces_[j];
  factor_.solve(residual_.data());
  for (int i = 0; i < m; ++i)
    forces_[i] += residual_[i];
}

/// The force coefficients of order n, which make the gaps' coefficients of order n + 2 vanish: A lambda_n = -(n+1)(n+2) g_{n+2}.
void Flow::contactSolve(int n)
{
  const std::size_t m = rest_work_.size();
  for (std::size_t i = 0; i < m; ++i)
    forces_[i] = -gapAcceleration(rest_work_[i], n);
  if (m == 1)
    forces_[0] /= gram_(0, 0);
  else
    solveForces(n);
  for (std::size_t i = 0; i < m; ++i)
  {
    RestWork& r = rest_work_[i];
    const double lambda = forces_[i];
    (*rests_)[i].force[n] = lambda;
    r.force[n] = Vec2::Constant(lambda);
    SizedSum force, torque;
    force.add(lambda * r.normal[0]);
    torque.add(lambda * r.levers[0]);
    push(r, force, torque);
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
    const double x = cleaned(w.a.x(), w.a_size.x()) * divisor, y = cleaned(w.a.y(), w.a_size.y()) * divisor;
    const double angle = cleaned(w.alpha, w.alpha_size) * divisor;
    w.body->arc.order[n + 2] = { x, y, angle };
    w.place[n + 2] = Vec2(x, y);
    w.rate[n + 2] = Vec2::Constant((n + 2) * angle);
    w.direction[n + 2] = w.known + Vec2(0.0, angle);
    w.rotating = w.rotating || angle != 0.0;
    fits = fits && std::abs(x) < kLargest && std::abs(y) < kLargest && std::abs(angle) < kLargest;
  }
  placeRests(n + 2);
  if (n < 3 || fits)
    return true;
  for (const BodyWork& w : work_)
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
  for (const BodyWork& w : work_)
  {
    if (w.rotating && w.trigonometric)
      return false;
    if (field_->damping != 0.0 && !w.body->arc.order[2].isZero())
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
    forces_.resize(m);
    for (int i = 0; i < m; ++i)
    {
      for (int j = 0; j <= i; ++j)
        gram_(i, j) = gram_(j, i) = row_[j] = contactGram(rests[i].touch, rests[j].touch, members);
      factor_.append(row_.data(), kTrusted);
    }
  }
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
