// Bodies that move as one: which they are after an event, their arcs, and their next event.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine.h"

namespace block_world
{
namespace
{
/// Where events cut arcs off after less than this share of the highest order's horizon, as in heaps, half as many orders are good for as long: the
/// horizon goes with eps^(1 / (order + 1)), and eps^(1/13 - 1/26) = 0.25.
constexpr double kBrief = 0.25;
}  // namespace

/// New islands among the members: joined by touches that carry force or by springs.
void World::Engine::regroup(const Time& time)
{
  const int count = static_cast<int>(group_.members.size());
  component_.resize(count);
  for (int i = 0; i < count; ++i)
    component_[i] = i;
  const auto root = [this](int i) {
    while (component_[i] != i)
      i = component_[i];
    return i;
  };
  const auto unite = [&](int i, int j) {
    const int p = root(i), q = root(j);
    if (group_.members[p].body < group_.members[q].body)
      component_[q] = p;
    else
      component_[p] = q;
  };
  for (const Touch& t : group_.touches)
    if (t.active && !bodies[t.a].fixed && !bodies[t.b].fixed)
      unite(t.member_a, t.member_b);
  for (const Member& m : group_.members)
    for (int index : bodies[m.body].springs)
    {
      const SpringLink& link = links_[index];
      if (link.second >= 0 && !bodies[link.first].fixed && !bodies[link.second].fixed)
        unite(member_of_[link.first], member_of_[link.second]);
    }
  for (const Member& m : group_.members)
    if (!bodies[m.body].fixed)
    {
      islands_[m.body].clear();
      promises_.set(islandSlot(m.body), Time::infinity());
    }
  for (int index : group_pairs_)
    pairs_[index].resting.clear();
  for (int i = 0; i < count; ++i)
  {
    if (bodies[group_.members[i].body].fixed || root(i) != i)
      continue;
    island_members_.clear();
    for (int j = 0; j < count; ++j)
      if (!bodies[group_.members[j].body].fixed && root(j) == i)
        island_members_.push_back(j);
    launch(time, island_members_);
  }
}

/// Arcs and promises of one new island. members: indices into the group.
void World::Engine::launch(const Time& time, const std::vector<int>& members)
{
  int name = group_.members[members.front()].body;
  for (int m : members)
    name = std::min(name, group_.members[m].body);
  Island& island = islands_[name];
  for (int m : members)
    island.takeMemory(islands_[group_.members[m].body]);
  island_state_.clear();
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    const Member& m = group_.members[members[k]];
    island.bodies.push_back(m.body);
    bodies[m.body].island = name;
    island_state_.push_back(m);
  }
  const auto indexIn = [&](int member) {
    for (std::size_t k = 0; k < members.size(); ++k)
      if (members[k] == member)
        return static_cast<int>(k);
    return -1;
  };
  for (const Touch& t : group_.touches)
  {
    if (!t.active)
      continue;
    Rest rest;
    rest.touch = t;
    rest.touch.member_a = indexIn(t.member_a);
    rest.touch.member_b = indexIn(t.member_b);
    if (rest.touch.member_a < 0 && rest.touch.member_b < 0)
      continue;
    island.rests.push_back(rest);
  }
  do
    move(island, time);
  while (letGo(island, time));
  for (const Rest& rest : island.rests)
  {
    Pair& pair = pairs_[rest.touch.pair];
    pair.resting.add({ pair.a == rest.touch.b, static_cast<unsigned>(rest.touch.face), rest.touch.vertex });
  }
  promiseIsland(name, time);
}

/// Below this a contact force pulls; what is nearer to zero is rounding.
double World::Engine::leastForce(const Island& island) const
{
  double largest = 0.0;
  for (const Rest& rest : island.rests)
    largest = std::max(largest, std::abs(rest.force[0]));
  return -1e-12 * largest;
}

/// Lets the touch go that pulls most at the next instant after the start of new arcs, if any does, or if none presses. The plan had it press, by less
/// than the rounding of forces that depend on each other nearly, so that its force is zero, or by what is gone before time can tell; as an event it would
/// come again at once, and again.
bool World::Engine::letGo(Island& island, const Time& time)
{
  const auto next = [](const Rest& rest) { return rest.force[0] + kRounding * rest.force[1]; };
  const auto least = std::min_element(island.rests.begin(), island.rests.end(), [&](const Rest& p, const Rest& q) { return next(p) < next(q); });
  if (least == island.rests.end() || next(*least) > leastForce(island))
    return false;
  for (Touch& t : group_.touches)
    if (t.active && sameTouch(t, least->touch))
    {
      t.active = false;
      tell(t, ContactKind::RestEnd, 0.0, time);
    }
  island.rests.erase(least);
  return true;
}

/// Whether the former arcs of an island's bodies, those that had a horizon, have been cut off before arcs of low order would end.
bool World::Engine::wereBrief(const Island& island, const Time& time) const
{
  bool brief = false;
  for (int body : island.bodies)
  {
    const Arc& arc = bodies[body].arc;
    if (std::isinf(arc.horizon))
      continue;
    const double low = arc.degree <= kLowOrder ? arc.horizon : kBrief * arc.horizon;
    if (time >= arc.end || time - arc.start >= low)
      return false;
    brief = true;
  }
  return brief;
}

/// New arcs of an island from island_state_ on.
void World::Engine::move(Island& island, const Time& time)
{
  flow_.expand(bodies, links_, field_, time, wereBrief(island, time) ? kLowOrder : kOrder, island_state_, island.rests, island.works);
  for (int body : island.bodies)
    forget(body);
  if (isStill(island))
    sleep(island);
}

/// Whether an island is in equilibrium, and its velocities are rounding. What rounding leaves of an acceleration is proportional to the forces that
/// cancel in it.
bool World::Engine::isStill(const Island& island) const
{
  double a = 0.0;
  for (const Rest& rest : island.rests)
    for (int body : { rest.touch.a, rest.touch.b })
      a = std::max(a, std::abs(rest.force[0]) * bodies[body].inverse_mass);
  return a > 0.0 && std::all_of(island.bodies.begin(), island.bodies.end(), [&](int body) {
    const Arc& arc = bodies[body].arc;
    const double radius = bodies[body].shape->radius;
    const double speed = std::hypot(arc.order[1].x, arc.order[1].y) + radius * std::abs(arc.order[1].angle);
    const double acceleration = 2.0 * (std::hypot(arc.order[2].x, arc.order[2].y) + radius * std::abs(arc.order[2].angle));
    return speed <= 1e-12 * std::sqrt(a * radius) && acceleration <= 1e-12 * a;
  });
}

/// Constant arcs without an end.
void World::Engine::sleep(Island& island)
{
  for (int body : island.bodies)
  {
    Arc& arc = bodies[body].arc;
    for (int n = 1; n <= arc.degree; ++n)
      arc.order[n] = Coefficients();
    arc.degree = 0;
    arc.horizon = std::numeric_limits<double>::infinity();
    arc.end = Time::infinity();
    arc.jerk = arc.angular_jerk = 0.0;
  }
  for (Rest& rest : island.rests)
    rest.degree = 0;
  island.works.thrust.degree = island.works.loss.degree = 0;
}

/// The island's next event: the end of its arcs, a force that would pull, or a vertex that leaves its face.
void World::Engine::promiseIsland(int name, const Time& time)
{
  const Island& island = islands_[name];
  const Arc& arc = bodies[island.bodies.front()].arc;
  double span = arc.horizon;
  const double least = leastForce(island);
  for (const Rest& rest : island.rests)
  {
    if (rest.degree > 2)
      span = std::min(span, firstBelow(rest.force, rest.degree - 2, span, least));
    const Face& face = bodies[rest.touch.b].shape->faces[rest.touch.face];
    if (std::isinf(face.length))
      continue;
    // A vertex inside the face's ends leaves exactly at them; one that was let in a little outside has the shell to go.
    Series left = rest.along;
    for (double& c : left)
      c = -c;
    left[0] += face.length;
    for (const Series* margin : std::array<const Series*, 2>{ &rest.along, &left })
      span = std::min(span, firstBelow(*margin, rest.degree, span, (*margin)[0] > resolution_ ? 0.0 : -scene.tolerance));
  }
  promises_.set(islandSlot(name), span < arc.horizon ? time + span : arc.end);
}

/// Ends the arcs of a body's island and leaves each of its bodies alone, on a straight arc from here, to be resolved anew.
void World::Engine::dissolve(int body, const Time& time)
{
  const std::vector<int> members = islands_[bodies[body].island].bodies;
  closeIsland(body, time);
  seeds_.clear();
  for (int i : members)
  {
    promises_.set(islandSlot(i), Time::infinity());
    islands_[i].bodies.assign(1, i);
    islands_[i].rests.clear();
    bodies[i].island = i;
    for (int pair = bodies[i].first_pair; pair >= 0; pair = pairs_[pair].nextOf(i))
      pairs_[pair].resting.clear();
    seeds_.push_back(i);
  }
}

/// A component of the velocity that has decayed to the rounding of the others is zero: else it would go on decaying, in arcs as short as its time.
void World::Engine::endDecay(Member& m) const
{
  const double radius = bodies[m.body].shape->radius, least = kCancelled * (m.velocity.norm() + radius * std::abs(m.omega));
  for (double* component : { &m.velocity.x(), &m.velocity.y() })
    if (std::abs(*component) <= least)
      *component = 0.0;
  if (radius * std::abs(m.omega) <= least)
    m.omega = 0.0;
}

/// Whether rounding has moved the touches of island_state_ that carry force by more than the coordinates resolve.
bool World::Engine::hasDrifted(Island& island, const Time& time)
{
  const Member still;
  const auto member = [&](int index) -> const Member& { return index < 0 ? still : island_state_[index]; };
  double speed = 0.0;
  for (const Member& m : island_state_)
    speed = std::max(speed, m.velocity.norm() + bodies[m.body].shape->radius * std::abs(m.omega));
  return std::any_of(island.rests.begin(), island.rests.end(), [&](Rest& rest) {
    Touch& t = rest.touch;
    locate(t, bodies[t.a], frame(t.a, time), bodies[t.b], frame(t.b, time));
    return std::abs(t.gap) > resolution_ || std::abs(normalVelocity(t, member(t.member_a), member(t.member_b))) > kSpeedNoise * speed;
  });
}

/// The arcs of an island reach their end: the same motion, expanded anew. No trajectory changes, so no other promise does.
void World::Engine::continueIsland(int name, const Time& time)
{
  Island& island = islands_[name];
  island_state_.clear();
  for (int body : island.bodies)
  {
    Member m = memberAt(body, time);
    m.frame = frame(body, time);
    if (field_.damping > 0.0)
      endDecay(m);
    island_state_.push_back(m);
  }
  if (hasDrifted(island, time))
  {
    seeds_.assign(1, name);
    resolve(time);
    return;
  }
  closeWorks(name, time);
  move(island, time);
  for (int body : island.bodies)
  {
    promiseCell(body, time);
    charge(body, bodies[body].arc.degree);
    chargeEvent(body, time);
  }
  promiseIsland(name, time);
}

}  // namespace block_world
