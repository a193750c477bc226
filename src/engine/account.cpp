#include <algorithm>
#include <cmath>

#include "engine.h"

namespace block_world
{
namespace
{
/// Coefficients of the derivative.
Series derivative(const Series& c, int degree)
{
  Series d{};
  for (int n = 1; n <= degree; ++n)
    d[n - 1] = n * c[n];
  return d;
}

/// Integral of the product a b over [0, s].
double integrateProduct(const Series& a, const Series& b, int degree_a, int degree_b, double s)
{
  double sum = 0.0;
  for (int n = degree_a + degree_b; n >= 0; --n)
  {
    double c = 0.0;
    for (int j = std::max(0, n - degree_b); j <= std::min(n, degree_a); ++j)
      c += a[j] * b[n - j];
    sum = (sum + c / (n + 1)) * s;
  }
  return sum;
}

/// Cosine and sine of a body's angle along its arc.
void directions(const Body& body, Series& c, Series& s)
{
  c.fill(0.0);
  s.fill(0.0);
  c[0] = std::cos(body.arc.angle[0]);
  s[0] = std::sin(body.arc.angle[0]);
  trigonometricSeries(body.arc.angle, body.arc.degree, kOrder, c, s);
}

Frame frameAt(const Body& body, const Time& time)
{
  const Snapshot now = body.at(time);
  return Frame(now.position, now.angle);
}
}  // namespace

/// Work of thrusters and wrench, and loss by damping, since the start of the body's arc.
World::Engine::Work World::Engine::arcWork(const Body& body, const Time& time) const
{
  Work work;
  const double s = time - body.arc.start;
  if (!(s > 0.0) || body.arc.degree == 0)
    return work;
  const int degree = body.arc.degree - 1;
  const bool damped = field_.damping > 0.0;
  if (!damped && !body.pushed())
    return work;
  const Series vx = derivative(body.arc.x, body.arc.degree), vy = derivative(body.arc.y, body.arc.degree);
  if (damped)
  {
    const Series omega = derivative(body.arc.angle, body.arc.degree);
    work.damping = field_.damping * (integrateProduct(vx, vx, degree, degree, s) + integrateProduct(vy, vy, degree, degree, s)) +
                   field_.rotational_damping * integrateProduct(omega, omega, degree, degree, s);
  }
  if (body.pushed())
  {
    Series c, sn, fx, fy;
    directions(body, c, sn);
    for (int n = 0; n <= kOrder; ++n)
    {
      fx[n] = c[n] * body.push.x() - sn[n] * body.push.y();
      fy[n] = sn[n] * body.push.x() + c[n] * body.push.y();
    }
    work.thrust = integrateProduct(fx, vx, kOrder, degree, s) + integrateProduct(fy, vy, kOrder, degree, s) +
                  body.twist * (evaluate(body.arc.angle, body.arc.degree, s) - body.arc.angle[0]);
  }
  return work;
}

/// Energy that the damper of a spring took since the start of the arcs of its ends.
double World::Engine::damperLoss(const Body& first, const Vec2& first_point, const Body* second, const Vec2& second_point,
                                 double rest_length, double damping, const Time& time) const
{
  const double span = time - first.arc.start;
  if (damping == 0.0 || !(span > 0.0))
    return 0.0;
  Series c, s, dx, dy;
  directions(first, c, s);
  for (int n = 0; n <= kOrder; ++n)
  {
    dx[n] = first.arc.x[n] + c[n] * first_point.x() - s[n] * first_point.y();
    dy[n] = first.arc.y[n] + s[n] * first_point.x() + c[n] * first_point.y();
  }
  if (second == nullptr)
  {
    dx[0] -= second_point.x();
    dy[0] -= second_point.y();
  }
  else
  {
    directions(*second, c, s);
    for (int n = 0; n <= kOrder; ++n)
    {
      dx[n] -= second->arc.x[n] + c[n] * second_point.x() - s[n] * second_point.y();
      dy[n] -= second->arc.y[n] + s[n] * second_point.x() + c[n] * second_point.y();
    }
  }
  if (rest_length == 0.0)
  {
    const Series rx = derivative(dx, kOrder), ry = derivative(dy, kOrder);
    return damping * (integrateProduct(rx, rx, kOrder - 1, kOrder - 1, span) + integrateProduct(ry, ry, kOrder - 1, kOrder - 1, span));
  }
  Series length{}, ux{}, uy{};
  const bool coincident = endsMeet(dx[0], dy[0], std::abs(first.arc.x[0]) + std::abs(first.arc.y[0]) + rest_length);
  for (int k = 0; k <= (coincident ? kOrder - 1 : kOrder); ++k)
    lengthSeries(dx, dy, k, coincident, length, ux, uy);
  const Series rate = derivative(length, kOrder);
  return damping * integrateProduct(rate, rate, kOrder - 1, kOrder - 1, span);
}

/// Losses of all dampers at the bodies of an island, each spring once.
double World::Engine::springLoss(int island, const Time& time) const
{
  double loss = 0.0;
  for (int index : islands_[island].bodies)
  {
    const Body& body = bodies[index];
    if (body.mouse.active)
      loss += damperLoss(body, body.mouse.attach, nullptr, body.mouse.anchor, 0.0, body.mouse.damping, time);
    for (int spring : body.springs)
    {
      const SpringLink& link = links_[spring];
      const bool first_moves = !bodies[link.first].fixed;
      if (link.damping == 0.0 || (first_moves && link.first != index))
        continue;
      if (first_moves)
        loss += damperLoss(body, link.first_point, link.second < 0 ? nullptr : &bodies[link.second], link.second_point,
                           link.rest_length, link.damping, time);
      else
        loss += damperLoss(body, link.second_point, &bodies[link.first], link.first_point, link.rest_length, link.damping, time);
    }
  }
  return loss;
}

void World::Engine::closeArc(int body, const Time& time)
{
  const Work work = arcWork(bodies[body], time);
  thrust_work_ += work.thrust;
  damping_loss_ += work.damping;
}

void World::Engine::closeSprings(int island, const Time& time)
{
  damping_loss_ += springLoss(island, time);
}

/// Before the forces on a body change: what its island's arcs did until now belongs to the former forces. New arcs begin here, straight ones until
/// the island is resolved at this same instant.
void World::Engine::closeIsland(int body, const Time& time)
{
  const int island = bodies[body].island;
  for (int i : islands_[island].bodies)
    closeArc(i, time);
  closeSprings(island, time);
  for (int i : islands_[island].bodies)
    putAt(i, bodies[i].stateAt(time), time);
}

/// A straight arc from a state.
void World::Engine::putAt(int body, const MotionState& state, const Time& time)
{
  Arc arc;
  arc.start = time;
  arc.degree = 1;
  arc.x[0] = state.position.x();
  arc.y[0] = state.position.y();
  arc.angle[0] = state.angle;
  arc.x[1] = state.velocity.x();
  arc.y[1] = state.velocity.y();
  arc.angle[1] = state.omega;
  bodies[body].arc = arc;
  cache_[body].time = Time::infinity();
}

double World::Engine::springEnergy(const SpringLink& link, const Time& time) const
{
  const Vec2 from = frameAt(bodies[link.first], time).toWorld(link.first_point);
  const Vec2 to = link.second < 0 ? link.second_point : frameAt(bodies[link.second], time).toWorld(link.second_point);
  const double stretch = (from - to).norm() - link.rest_length;
  return 0.5 * link.stiffness * stretch * stretch;
}

double World::Engine::mouseEnergy(const Body& body, const Time& time) const
{
  if (!body.mouse.active)
    return 0.0;
  return 0.5 * body.mouse.stiffness * (frameAt(body, time).toWorld(body.mouse.attach) - body.mouse.anchor).squaredNorm();
}

/// What the state itself holds: energies and momenta.
void World::Engine::stored(const Time& time, EnergyAccount& energy) const
{
  for (int i = 0; i < block_count; ++i)
  {
    const Body& body = bodies[i];
    if (body.fixed)
      continue;
    const MotionState state = body.stateAt(time);
    energy.gravity += body.mass * field_.gravity * (state.position.y() - zero_height_);
    energy.translational += 0.5 * body.mass * state.velocity.squaredNorm();
    energy.rotational += 0.5 * body.inertia * state.omega * state.omega;
    energy.spring += mouseEnergy(body, time);
    energy.momentum_x += body.mass * state.velocity.x();
    energy.momentum_y += body.mass * state.velocity.y();
    energy.angular_momentum += body.inertia * state.omega + body.mass * cross(state.position, state.velocity);
  }
  for (const SpringLink& link : links_)
    energy.spring += springEnergy(link, time);
  energy.total = energy.gravity + energy.spring + energy.translational + energy.rotational;
}

double World::Engine::storedTotal(const Time& time) const
{
  EnergyAccount energy;
  stored(time, energy);
  return energy.total;
}

void World::Engine::restartAccount()
{
  thrust_work_ = spring_work_ = command_work_ = damping_loss_ = impact_loss_ = 0.0;
  initial_total_ = storedTotal(now);
}

EnergyAccount World::Engine::energy() const
{
  EnergyAccount energy;
  stored(now, energy);
  energy.thrust_work = thrust_work_;
  energy.damping_loss = damping_loss_;
  for (int i = 0; i < block_count; ++i)
  {
    if (bodies[i].fixed)
      continue;
    const Work work = arcWork(bodies[i], now);
    energy.thrust_work += work.thrust;
    energy.damping_loss += work.damping;
    if (bodies[i].island == i)
      energy.damping_loss += springLoss(i, now);
  }
  energy.spring_work = spring_work_;
  energy.command_work = command_work_;
  energy.impact_loss = impact_loss_;
  energy.balance_error = energy.total - initial_total_ - energy.thrust_work - energy.spring_work - energy.command_work +
                         energy.damping_loss + energy.impact_loss;
  return energy;
}

std::vector<ContactEvent> World::Engine::restingContacts() const
{
  std::vector<ContactEvent> result;
  for (int i = 0; i < block_count; ++i)
    for (const Rest& rest : islands_[i].rests)
    {
      const Body &a = bodies[rest.touch.a], &b = bodies[rest.touch.b];
      const Body& mover = a.fixed ? b : a;
      ContactEvent contact;
      contact.time = now;
      contact.kind = ContactKind::Rest;
      contact.a = rest.touch.a;
      contact.b = rest.touch.b;
      contact.point = frameAt(a, now).toWorld(a.shape.vertices[rest.touch.vertex]);
      contact.normal = frameAt(b, now).rotate(b.shape.faces[rest.touch.face].normal);
      contact.impulse = evaluate(rest.force, std::max(0, rest.degree - 2), rest.degree > 2 ? now - mover.arc.start : 0.0);
      result.push_back(contact);
    }
  return result;
}

double World::Engine::overlap() const
{
  double deepest = 0.0;
  for (const Pair& pair : pairs_)
  {
    if (pair.a < 0)
      continue;
    const Body &a = bodies[pair.a], &b = bodies[pair.b];
    const Snapshot now_a = a.at(now), now_b = b.at(now);
    if (!a.shape.vertices.empty() && !b.shape.vertices.empty())
    {
      const double reach = a.shape.radius + b.shape.radius;
      if ((now_a.position - now_b.position).squaredNorm() > reach * reach)
        continue;
    }
    deepest = std::max(deepest, -separation(a.shape, Frame(now_a.position, now_a.angle), b.shape, Frame(now_b.position, now_b.angle)));
  }
  return deepest;
}

std::vector<SpringState> World::Engine::springs() const
{
  std::vector<SpringState> result;
  for (const SpringLink& link : links_)
  {
    SpringState state;
    state.body = link.first;
    state.from = frameAt(bodies[link.first], now).toWorld(link.first_point);
    state.to = link.second < 0 ? link.second_point : frameAt(bodies[link.second], now).toWorld(link.second_point);
    result.push_back(state);
  }
  for (int i = 0; i < block_count; ++i)
  {
    if (!bodies[i].mouse.active)
      continue;
    SpringState state;
    state.body = i;
    state.from = frameAt(bodies[i], now).toWorld(bodies[i].mouse.attach);
    state.to = bodies[i].mouse.anchor;
    state.mouse = true;
    result.push_back(state);
  }
  return result;
}

}  // namespace block_world
