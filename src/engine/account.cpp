#include <algorithm>
#include <cmath>
#include <utility>

#include "engine.h"

namespace block_world
{
namespace
{
Frame frameAt(const Body& body, const Time& time)
{
  const Snapshot now = body.at(time);
  return Frame(now.position, now.angle);
}
}  // namespace

/// What an island's arcs did since their start belongs to the account.
void World::Engine::closeWorks(int island, const Time& time)
{
  const Works& works = islands_[island].works;
  const double span = time - bodies[island].arc.start;
  thrust_work_ += works.thrust.after(span);
  damping_loss_ += works.loss.after(span);
}

/// Before the forces on a body change: what its island's arcs did until now belongs to the former forces. New arcs begin here, straight ones until
/// the island is resolved at this same instant.
void World::Engine::closeIsland(int body, const Time& time)
{
  const int island = bodies[body].island;
  closeWorks(island, time);
  for (int i : islands_[island].bodies)
    putAt(i, bodies[i].stateAt(time), time);
}

/// A straight arc from a state.
void World::Engine::putAt(int body, const MotionState& state, const Time& time)
{
  Arc arc;
  arc.start = time;
  arc.degree = 1;
  arc.order[0] = { state.position.x(), state.position.y(), state.angle };
  arc.order[1] = { state.velocity.x(), state.velocity.y(), state.omega };
  bodies[body].arc = arc;
  forget(body);
}

double World::Engine::springEnergy(const SpringLink& link, const Time& time) const
{
  const Vec2 from = frameAt(bodies[link.first], time).toWorld(link.first_point);
  const Vec2 to = link.second < 0 ? link.second_point : frameAt(bodies[link.second], time).toWorld(link.second_point);
  const double stretch = (from - to).norm() - link.rest_length;
  return 0.5 * link.stiffness * stretch * stretch;
}

/// Energy that gravity and springs gain as the group's members move from the frames before to those they have now: of forces that have a potential
/// only. Damping, thrusters and wrenches do no work where no time passes.
double World::Engine::storedOnMove() const
{
  // Where a point of a body (or of the world) was and is.
  const auto ends = [&](int body, const Vec2& point) -> std::pair<Vec2, Vec2> {
    if (body < 0)
      return { point, point };
    const int k = member_of_[body];
    if (k >= 0)
      return { before_[k].frame.toWorld(point), group_.members[k].frame.toWorld(point) };
    const Arc& still = bodies[body].arc;  // a fixed one
    const Vec2 there = Frame(still.order[0].place(), still.order[0].angle).toWorld(point);
    return { there, there };
  };
  const auto gain = [&](double stiffness, double rest_length, const std::pair<Vec2, Vec2>& from, const std::pair<Vec2, Vec2>& to) {
    const double was = (from.first - to.first).norm() - rest_length, is = (from.second - to.second).norm() - rest_length;
    return 0.5 * stiffness * (is - was) * (is + was);
  };
  double sum = 0.0;
  for (std::size_t k = 0; k < group_.members.size(); ++k)
  {
    const Member& m = group_.members[k];
    const Body& body = bodies[m.body];
    if (body.fixed)
      continue;
    sum += body.mass * field_.gravity * (m.frame.position.y() - before_[k].frame.position.y());
    if (body.mouse.active)
      sum += gain(body.mouse.stiffness, 0.0, ends(m.body, body.mouse.attach), ends(-1, body.mouse.anchor));
    for (int index : body.springs)
    {
      const SpringLink& link = links_[index];
      // One between two that move is listed by both: take it once.
      if (link.first == m.body || bodies[link.first].fixed)
        sum += gain(link.stiffness, link.rest_length, ends(link.first, link.first_point), ends(link.second, link.second_point));
    }
  }
  return sum;
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
    if (bodies[i].fixed || bodies[i].island != i)
      continue;
    const Works& works = islands_[i].works;
    const double span = now - bodies[i].arc.start;
    energy.thrust_work += works.thrust.after(span);
    energy.damping_loss += works.loss.after(span);
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
      contact.point = frameAt(a, now).toWorld(a.shape->vertices[rest.touch.vertex]);
      contact.normal = frameAt(b, now).rotate(b.shape->faces[rest.touch.face].normal);
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
    if (!a.shape->vertices.empty() && !b.shape->vertices.empty())
    {
      const double reach = a.shape->radius + b.shape->radius;
      if ((now_a.position - now_b.position).squaredNorm() > reach * reach)
        continue;
    }
    deepest = std::max(deepest, -separation(*a.shape, Frame(now_a.position, now_a.angle), *b.shape, Frame(now_b.position, now_b.angle)));
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
