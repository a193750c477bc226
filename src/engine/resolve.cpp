#include <algorithm>
#include <cmath>

#include "engine.h"

namespace block_world
{
namespace
{
void fetchLines(const void* from, const void* to)
{
  for (const char* line = static_cast<const char*>(from); line < static_cast<const char*>(to); line += kCacheLine)
    __builtin_prefetch(line);
}
}  // namespace

/// Has what a look at a body needs brought from memory, all at once, where one after the other would take several times as long.
void World::Engine::fetch(int body) const
{
  fetchLines(&bodies[body], &bodies[body].arc.order[3]);
}

/// The same for what a close look needs.
void World::Engine::fetchShape(int body) const
{
  const Polygon& shape = *bodies[body].shape;
  fetchLines(shape.vertices.data(), shape.vertices.data() + shape.vertices.size());
  fetchLines(shape.faces.data(), shape.faces.data() + shape.faces.size());
}

/// Has what a promise is about brought from memory before it comes due.
void World::Engine::fetchFor(int slot) const
{
  if (slot >= pairSlot(0))
  {
    const Pair& pair = pairs_[slot - pairSlot(0)];
    fetch(pair.a);
    fetch(pair.b);
  }
  else if (slot >= cellSlot(0))
    fetch(slot - cellSlot(0));
}

/// The body among those that are seen at this instant, as its arc has it.
World::Engine::Seen& World::Engine::see(int body, const Time& time)
{
  if (seen_at_ != time)
  {
    seen_count_ = 0;
    seen_at_ = time;
  }
  const int place = seen_as_[body];
  if (!(place < seen_count_ && seen_[place].body == ~body))
    seen_as_[body] = seen_count_++;
  Seen& seen = seen_[seen_as_[body]];
  seen.body = body;
  seen.now = bodies[body].at(time);
  seen.framed = false;
  return seen;
}

/// The body's arc changes.
void World::Engine::forget(int body)
{
  const int place = seen_as_[body];
  if (place < seen_count_ && seen_[place].body == body)
    seen_[place].body = ~body;
}

void World::Engine::forgetAll()
{
  seen_.assign(bodies.size(), Seen());
  seen_as_.assign(bodies.size(), 0);
  seen_count_ = 0;
}

Frame World::Engine::frame(int body, const Time& time)
{
  Seen& it = seen(body, time);
  if (!it.framed)
  {
    it.cosine = std::cos(it.now.angle);
    it.sine = std::sin(it.now.angle);
    it.framed = true;
  }
  Frame frame;
  frame.position = it.now.position;
  frame.cosine = it.cosine;
  frame.sine = it.sine;
  return frame;
}

/// Accelerations by all forces but contact, at the member's state.
void World::Engine::freeAcceleration(Member& m) const
{
  const Body& body = bodies[m.body];
  m.acceleration = -field_.damping * body.inverse_mass * m.velocity - Vec2(0.0, field_.gravity);
  m.alpha = -field_.rotational_damping * body.inverse_inertia * m.omega;
  if (body.pushed())
  {
    m.acceleration += body.inverse_mass * m.frame.rotate(body.push);
    m.alpha += body.inverse_inertia * body.twist;
  }
  const auto pull = [&](const Vec2& arm, const Vec2& force) {
    m.acceleration += body.inverse_mass * force;
    m.alpha += body.inverse_inertia * cross(arm, force);
  };
  if (body.mouse.active)
  {
    const Vec2 arm = m.frame.rotate(body.mouse.attach);
    pull(arm, -body.mouse.stiffness * (m.frame.position + arm - body.mouse.anchor) -
                  body.mouse.damping * (m.velocity + m.omega * perp(arm)));
  }
  for (int index : body.springs)
  {
    const SpringLink& link = links_[index];
    const bool is_first = link.first == m.body;
    const int other = is_first ? link.second : link.first;
    const Vec2 arm = m.frame.rotate(is_first ? link.first_point : link.second_point);
    Vec2 end = is_first ? link.second_point : link.first_point, end_velocity = Vec2::Zero();
    if (other >= 0)
    {
      // Movable ends of a spring are members together; a fixed one stays where its arc begins.
      const int k = member_of_[other];
      const Arc& still = bodies[other].arc;
      const Frame f = k >= 0 ? group_.members[k].frame : Frame(still.order[0].place(), still.order[0].angle);
      const Vec2 far_arm = f.rotate(end);
      if (k >= 0)
        end_velocity = group_.members[k].velocity + group_.members[k].omega * perp(far_arm);
      end = f.position + far_arm;
    }
    const Vec2 d = m.frame.position + arm - end;
    const Vec2 rate = m.velocity + m.omega * perp(arm) - end_velocity;
    if (link.rest_length == 0.0)
    {
      pull(arm, -link.stiffness * d - link.damping * rate);
      continue;
    }
    const double length = d.norm();
    if (length > 0.0)
      pull(arm, -(link.stiffness * (length - link.rest_length) + link.damping * d.dot(rate) / length) / length * d);
  }
}

/// The body as its arc has it, its frame without the directions.
Member World::Engine::memberAt(int body, const Time& time)
{
  const Snapshot& now = snapshot(body, time);
  Member m;
  m.body = body;
  m.frame.position = now.position;
  m.angle = now.angle;
  m.velocity = now.velocity;
  m.omega = now.omega;
  m.acceleration = now.acceleration;
  m.alpha = now.alpha;
  m.inverse_mass = bodies[body].inverse_mass;
  m.inverse_inertia = bodies[body].inverse_inertia;
  return m;
}

int World::Engine::memberOf(int body, const Time& time)
{
  if (member_of_[body] >= 0)
    return member_of_[body];
  group_.members.push_back(memberAt(body, time));
  group_.members.back().frame = frame(body, time);
  member_of_[body] = static_cast<int>(group_.members.size()) - 1;
  return member_of_[body];
}

/// Takes a body, its island and whatever springs tie to it into the group.
void World::Engine::join(int body, const Time& time)
{
  if (member_of_[body] >= 0)
    return;
  memberOf(body, time);
  if (bodies[body].fixed)
    return;
  for (int index = bodies[body].first_pair; index >= 0; index = pairs_[index].nextOf(body))
    fetch(pairs_[index].other(body));
  for (int other : islands_[bodies[body].island].bodies)
    join(other, time);
  for (int index : bodies[body].springs)
    for (int end : { links_[index].first, links_[index].second })
      if (end >= 0 && !bodies[end].fixed)
        join(end, time);
}

/// Whether the circles of a pair, or a circle and a half-plane, are as near as a touch has them, and so is the face that parted them last.
bool World::Engine::mayTouch(const Pair& pair, const Time& time)
{
  const Polygon &first = *bodies[pair.a].shape, &second = *bodies[pair.b].shape;
  const Vec2 &at_first = snapshot(pair.a, time).position, &at_second = snapshot(pair.b, time).position;
  const double shell = 0.5 * scene.tolerance;
  if (first.vertices.empty() || second.vertices.empty())
  {
    const bool wall_first = first.vertices.empty();
    const Face& face = (wall_first ? first : second).faces.front();
    return !(face.normal.dot(wall_first ? at_second : at_first) - face.offset > (wall_first ? second : first).radius + shell);
  }
  const double reach = first.radius + second.radius + shell;
  if ((at_first - at_second).squaredNorm() > reach * reach)
    return false;
  // The face that parted them last may do so still.
  const Frame of_first = frame(pair.a, time), of_second = frame(pair.b, time);
  return pair.face < 0 || !(pair.face_of_a ? faceGap(first.faces[pair.face], of_first, second, of_second) > shell
                                           : faceGap(second.faces[pair.face], of_second, first, of_first) > shell);
}

/// The body as the group has it, or else as its arc has it, which is put into the member given.
const Member& World::Engine::viewed(int body, const Time& time, Member& member)
{
  if (member_of_[body] >= 0)
    return group_.members[member_of_[body]];
  member = memberAt(body, time);
  member.frame = frame(body, time);
  return member;
}

/// All touches of the group's bodies; who touches them joins the group with its island.
void World::Engine::findTouches(const Time& time, int round)
{
  group_.touches.clear();
  group_pairs_.clear();
  velocity_decided_ = false;
  ++mark_;
  for (std::size_t m = 0; m < group_.members.size(); ++m)
  {
    const int body = group_.members[m].body;
    if (bodies[body].fixed)
      continue;
    for (int index = bodies[body].first_pair; index >= 0; index = pairs_[index].nextOf(body))
    {
      if (pair_mark_[index] == mark_)
        continue;
      pair_mark_[index] = mark_;
      group_pairs_.push_back(index);
      const Pair& pair = pairs_[index];
      const int other = pair.other(body);
      if (!mayTouch(pair, time))
        continue;
      const std::size_t before = group_.touches.size();
      Member a, b;
      finder_.find(bodies[pair.a], viewed(pair.a, time, a), bodies[pair.b], viewed(pair.b, time, b), scene.tolerance, group_.touches,
                   2.0 * detector_.guard(), group_.noise(), round > 0);
      velocity_decided_ = velocity_decided_ || finder_.velocityDecided();
      if (group_.touches.size() == before)
        continue;
      join(other, time);
      for (std::size_t t = before; t < group_.touches.size(); ++t)
      {
        Touch& touch = group_.touches[t];
        touch.pair = index;
        touch.rested = pair.resting.contains({ touch.b == pair.a, static_cast<unsigned>(touch.face), touch.vertex });
      }
    }
  }
  for (Touch& touch : group_.touches)
  {
    touch.member_a = member_of_[touch.a];
    touch.member_b = member_of_[touch.b];
    statistics.worst_overlap = std::max(statistics.worst_overlap, -touch.separation);
  }
}

/// Everything that touches the seeds meets at this instant: impacts, capture, new islands, new arcs, new promises.
void World::Engine::resolve(const Time& time)
{
  const CostKind cause = kind_;
  for (const Member& m : group_.members)
    member_of_[m.body] = -1;
  group_.clear();
  for (int body : seeds_)
    join(body, time);

  ContactScales scales;
  scales.tolerance = scene.tolerance;
  scales.guard = detector_.guard();
  scales.dissipative = dissipative_;
  former_rests_.clear();
  const double lost_before = impact_loss_;
  // Corner on corner is decided by the velocities: look again with the new ones.
  for (int round = 0;; ++round)
  {
    findTouches(time, round);
    if (round == 0)
      for (const Member& m : group_.members)
        if (!bodies[m.body].fixed && bodies[m.body].island == m.body)
          former_rests_.insert(former_rests_.end(), islands_[m.body].rests.begin(), islands_[m.body].rests.end());
    for (Member& m : group_.members)
      if (!bodies[m.body].fixed)
        freeAcceleration(m);
    if (group_.touches.empty() && !(velocity_decided_ && round == 0))
    {
      report(time, true);
      break;
    }
    group_.prepare();
    // Between the last instant before a contact and the next one, what is fast moves by more than coordinates resolve;
    // and these resolve less, the farther away from where the scene began.
    double fastest = 0.0, farthest = 0.0;
    for (const Touch& touch : group_.touches)
      fastest = std::max(fastest, -touch.approach);
    for (const Member& m : group_.members)
      farthest = std::max(farthest, m.frame.position.lpNorm<Eigen::Infinity>());
    scales.closed = 2.0 * detector_.guard() + kRounding * (fastest + 4.0 * farthest);
    impact_loss_ += group_.collide(scales);
    const bool again = velocity_decided_ && round < 8 && (round == 0 || group_.struck());
    report(time, !again);
    chargeTouches();
    if (!again)
      break;
  }
  settle(impact_loss_ - lost_before);
  for (const Member& m : group_.members)
    if (!bodies[m.body].fixed && bodies[m.body].island == m.body)
      closeWorks(m.body, time);
  regroup(time);
  lookAtPairs(time);
  for (const Member& m : group_.members)
  {
    charge(m.body, bodies[m.body].arc.degree);
    chargeEvent(m.body, time);
  }
  kind_ = cause;
}

/// The touches where the members are now.
void World::Engine::locateTouches()
{
  for (Touch& t : group_.touches)
  {
    const double before = t.gap;
    locate(t, bodies[t.a], group_.members[t.member_a].frame, bodies[t.b], group_.members[t.member_b].frame);
    t.separation += t.gap - before;
  }
}

/// Gaps of the touches that carry force become exactly zero, and so do their rates. What the moves take from the stored energy the impact has lost.
///
/// Moves that do not lessen the gaps are taken back: where there is no room for all, as in a jam, they only push one into another. So are moves that
/// lift by more than the gaps, if the impact has not lost as much (paid): what sinks by the guard and is lifted again gains nothing, but on a short
/// lever what rounding sinks would be lifted by a thousand times as much.
void World::Engine::settle(double paid)
{
  const double deep = 2.0 * detector_.guard(), rounding = 8.0 * resolution_;
  double misfit = group_.misfit(deep);
  for (int pass = 0; pass < 8 && misfit > 0.0; ++pass)
  {
    before_ = group_.members;
    const ContactGroup::Moves moves = group_.settlePositions(deep);
    locateTouches();
    const double left = group_.misfit(deep), gain = storedOnMove();
    if (left >= misfit || gain * (1.0 - (rounding + moves.gap) / moves.farthest) > paid)
    {
      group_.members = before_;
      locateTouches();
      return;
    }
    misfit = left;
    paid -= gain;
    impact_loss_ -= gain;
    if (moves.gap <= rounding)
      return;
    const double loss = group_.holdActive();
    paid += loss;
    impact_loss_ += loss;
  }
}

}  // namespace block_world
