#include <algorithm>
#include <limits>

#include "limits.h"
#include "replay.h"

// The part of Replay that looks at one instant: impulses and contact points.

namespace checker
{
namespace
{
/// Rows of one time in groups that share no movable block: what happens in one cannot affect another.
std::vector<std::vector<const ContactRow*>> groupsOf(const std::vector<const ContactRow*>& rows, const Scene& scene)
{
  std::vector<std::vector<const ContactRow*>> groups;
  const auto share = [&](const ContactRow& p, const ContactRow& q) {
    return (scene.movable(p.a) && (p.a == q.a || p.a == q.b)) || (scene.movable(p.b) && (p.b == q.a || p.b == q.b));
  };
  for (const ContactRow* row : rows)
  {
    std::vector<const ContactRow*> joined{ row };
    for (size_t g = groups.size(); g-- > 0;)
    {
      if (!std::any_of(groups[g].begin(), groups[g].end(),
                       [&](const ContactRow* other) { return share(*row, *other); }))
        continue;
      joined.insert(joined.end(), groups[g].begin(), groups[g].end());
      groups.erase(groups.begin() + g);
    }
    groups.push_back(joined);
  }
  return groups;
}

std::pair<int, int> pairOf(const ContactRow& row)
{
  return std::minmax(row.a, row.b);
}

/// The faces that meet where corner lies on corner, by their normals from body b to body a.
struct Corner
{
  std::vector<Vec2> normals;

  /// Whether a direction lies between two of them.
  bool contains(const Vec2& direction) const
  {
    bool left = false, right = false;
    for (const Vec2& normal : normals)
    {
      if (normal.dot(direction) <= 0.0)
        continue;
      left = left || cross(direction, normal) >= -relative_error;
      right = right || cross(direction, normal) <= relative_error;
    }
    return left && right;
  }
};

/// Adds the faces next to the vertex at a point, if there is one that near. Returns how many there are (0 or 1).
int addCorner(const Outline& outline, const Vec2& point, double near, double sign, Corner& corner)
{
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i)
  {
    if ((outline[i] - point).norm() > near)
      continue;
    for (const size_t start : { (i + n - 1) % n, i })
    {
      const Vec2 along = (outline[(start + 1) % n] - outline[start]).normalized();
      corner.normals.push_back(sign * Vec2(along.y(), -along.x()));
    }
    return 1;
  }
  return 0;
}

/// How far a value lies outside a range.
double excess(double value, double low, double high)
{
  return std::max({ 0.0, low - value, value - high });
}
}  // namespace

double Replay::normalVelocity(const ContactRow& row, const std::vector<State>& states) const
{
  const auto at = [&](int body) {
    return scene_.movable(body) ? states[body].velocityAt(row.point) : Vec2(Vec2::Zero());
  };
  return row.normal.dot(at(row.a) - at(row.b));
}

// A resting body is moved under the contact forces of the last sample; these turn and grow with all that leans on it, and
// with the place of the contact, which the interval's cube bounds.
double Replay::slack(const ContactRow& row, double since)
{
  const auto velocity = [&](int body) { return scene_.movable(body) ? states_[body].velocity : Vec2(Vec2::Zero()); };
  const double sliding = (velocity(row.a) - velocity(row.b)).norm();
  double value = 0.0;
  for (const int body : { row.a, row.b })
  {
    if (!scene_.movable(body) || !resting_[motion_.clusterOf(body)])
      continue;
    const double rate =
        1.0 + fastestRate(islandOf(motion_.clusterOf(body))) + sliding / scene_.blocks[body].shape.radius;
    value += since * since * since * rate * (rate * rate + 10.0 * leaning_[body].x() / drive_->bodies[body].mass);
  }
  return value;
}

/// How fast forces change in an island, 1/s: as bodies turn, as damping brakes them, as springs swing.
double Replay::fastestRate(int island)
{
  double fastest = 0.0;
  for (size_t i = 0; i < run_.bodies; ++i)
  {
    const int body = static_cast<int>(i);
    if (!scene_.movable(body) || islandOf(motion_.clusterOf(body)) != island)
      continue;
    const double radius = scene_.blocks[i].shape.radius, inertia = motion_.inertia(*drive_, body);
    const double yielding = 1.0 / drive_->bodies[i].mass + radius * radius / inertia;
    double stiffness = 0.0, damping = 0.0;
    const auto add = [&](const auto& spring) {
      stiffness += spring.stiffness;
      damping += spring.damping;
    };
    for (const Spring& spring : scene_.springs)
      if (spring.from == body || spring.to == body)
        add(spring);
    if (drive_->bodies[i].spring)
      add(*drive_->bodies[i].spring);
    const double braking = drive_->damping / drive_->bodies[i].mass +
                           drive_->damping * scene_.rotational_ratio / inertia;
    fastest = std::max(fastest, std::abs(states_[i].omega) + braking + damping * yielding + std::sqrt(stiffness * yielding));
  }
  return fastest;
}

void Replay::strike(RowRange rows)
{
  std::vector<const ContactRow*> events;
  for (size_t i = rows.first; i < rows.second; ++i)
  {
    const ContactRow& row = run_.contacts[i];
    if (row.kind == Kind::Rest)
      continue;
    events.push_back(&row);
    for (const int body : { row.a, row.b })
    {
      if (scene_.movable(body))
        bringIsland(motion_.clusterOf(body), row.time);
    }
  }
  if (events.empty())
    return;
  checkSigns(events);
  if (events.size() == 1)
    return strikeGroup(events);
  for (const std::vector<const ContactRow*>& group : groupsOf(events, scene_))
    strikeGroup(group);
}

// Where a slow bounce is replaced by its limit, touches that open slowly are held as well, and what is listed stands
// for the applied forces during the hops left out: it may pull, by no more than the speed of capture of all that moves,
// for each hop. (Their energies add up: so do the squares.) Some touches carry nothing once all are at rest, so that no
// row of a rest tells of them, but that they were slow.
void Replay::checkSigns(const std::vector<const ContactRow*>& events)
{
  const bool captures = std::any_of(events.begin(), events.end(), [&](const ContactRow* row) {
    return row->kind != Kind::Impact || std::binary_search(rest_pairs_.begin(), rest_pairs_.end(), pairOf(*row));
  });
  const bool slow = std::all_of(events.begin(), events.end(), [&](const ContactRow* row) {
    return row->impulse >= 0.0 || std::abs(row->normal_velocity) <= captureSpeed(*row, states_);
  });
  const ContactRow& least = **std::min_element(
      events.begin(), events.end(), [](const ContactRow* p, const ContactRow* q) { return p->impulse < q->impulse; });
  if (least.impulse < 0.0 && (captures || slow))
  {
    const auto hops = std::count_if(events.begin(), events.end(), [](const ContactRow* row) { return row->impulse < 0.0; });
    const double most = std::max(relative_error, std::sqrt(static_cast<double>(hops)) * captureImpulse());
    checks_.sign.add(pull(events, states_, most), most, least.time, least.a, least.b);
  }
  else
    checks_.sign.add(std::max(0.0, -least.impulse), relative_error, least.time, least.a, least.b);
}

// All movable mass at the speed of a bounce that the tolerance cannot tell from rest.
double Replay::captureImpulse() const
{
  double mass = 0.0, acceleration = 0.0;
  for (size_t i = 0; i < run_.bodies; ++i)
  {
    const int body = static_cast<int>(i);
    if (!scene_.movable(body))
      continue;
    mass += drive_->bodies[i].mass;
    acceleration = std::max(acceleration, appliedAcceleration(body, states_));
  }
  return mass * std::sqrt(8.0 * scene_.tolerance * (drive_->gravity + acceleration));
}

void Replay::strikeGroup(const std::vector<const ContactRow*>& group)
{
  std::vector<int> members;
  for (const ContactRow* row : group)
  {
    if (known(row->a) && known(row->b))
      checkRow(*row, states_, slack(*row, row->time - begin_));
    for (const int body : { row->a, row->b })
    {
      if (scene_.movable(body) && std::find(members.begin(), members.end(), body) == members.end())
        members.push_back(body);
    }
  }
  const bool free =
      std::none_of(members.begin(), members.end(), [&](int body) { return resting_[motion_.clusterOf(body)] != 0; });
  const auto energyOf = [&](int body) { return motion_.kinetic(*drive_, body, states_[body]); };
  double before = 0.0, after = 0.0, work = 0.0;
  for (const int body : members)
    before += energyOf(body);
  for (const ContactRow* row : group)
    work += std::abs(row->impulse) * (speedOf(row->a) + speedOf(row->b));
  const std::vector<State> old = group.size() == 1 && free ? states_ : std::vector<State>();
  // Impulses that all but cancel are known to some roundings of the largest.
  double largest = 0.0;
  for (const ContactRow* row : group)
  {
    push(*row);
    largest = std::max(largest, 4.0 * std::numeric_limits<double>::epsilon() * std::abs(row->impulse));
  }
  for (const int body : members)
  {
    pushed_[body] += largest / relative_error * Vec2(1.0, scene_.blocks[body].shape.radius);
    after += energyOf(body);
  }
  if (free)
  {
    account_->impact += before - after;
    // An impulse gives energy by the velocities of its point, as uncertain as the states are.
    checks_.energy.add(after - before, relative_error * std::max(1.0, before + work), group[0]->time, group[0]->a,
                       group[0]->b);
  }
  else
    account_->known = false;
  if (free && group.size() == 1 && group[0]->kind == Kind::Impact)
    checkSingle(*group[0], old);
  for (const int body : members)
    loseIsland(body);
}

/// Of the fastest point that a body may have.
double Replay::speedOf(int body) const
{
  if (!scene_.movable(body))
    return 0.0;
  return states_[body].velocity.norm() + scene_.blocks[body].shape.radius * std::abs(states_[body].omega);
}

void Replay::push(const ContactRow& row)
{
  for (const int body : { row.a, row.b })
  {
    if (!scene_.movable(body))
      continue;
    const Vec2 impulse = (body == row.a ? 1.0 : -1.0) * row.impulse * row.normal;
    const Vec2 arm = row.point - states_[body].position;
    states_[body].velocity += impulse / drive_->bodies[body].mass;
    states_[body].omega += cross(arm, impulse) / motion_.inertia(*drive_, body);
    pushed_[body] += std::abs(row.impulse) * Vec2(1.0, arm.norm());
  }
}

// After an event the contact forces of a resting body are known no longer, nor are those of the bodies that lean on it.
void Replay::loseIsland(int body)
{
  if (!resting_[motion_.clusterOf(body)])
    return;
  const int island = islandOf(motion_.clusterOf(body));
  for (size_t cluster = 0; cluster < lost_.size(); ++cluster)
    lost_[cluster] |= resting_[cluster] && islandOf(static_cast<int>(cluster)) == island;
}

void Replay::checkSingle(const ContactRow& row, const std::vector<State>& before)
{
  const double elastic = elasticity(scene_, *drive_, row.a, row.b);
  double speed = 0.0, kicks = 0.0, yielding = 0.0;
  for (const int body : { row.a, row.b })
  {
    if (!scene_.movable(body))
      continue;
    const State& state = before[body];
    speed += state.velocity.norm() + scene_.blocks[body].shape.radius * std::abs(state.omega);
    kicks += pushed_[body].x() / drive_->bodies[body].mass +
             scene_.blocks[body].shape.radius * pushed_[body].y() / motion_.inertia(*drive_, body);
    const double arm = cross(row.point - state.position, row.normal);
    yielding += 1.0 / drive_->bodies[body].mass + arm * arm / motion_.inertia(*drive_, body);
  }
  const double in = normalVelocity(row, before), out = normalVelocity(row, states_);
  // The speeds follow from those at the sample before, and carry the rounding of all impulses since.
  const double limit = relative_error * (10.0 * std::max(1.0, speed) + kicks);
  checks_.approach.add(std::abs(row.normal_velocity - in), limit, row.time, row.a, row.b);
  // A bounce too low for the tolerance to tell from rest may be taken for rest, be it the one that comes or the one that would follow.
  const double least = elastic * std::abs(in) <= captureSpeed(row, before) ? 0.0 : elastic;
  checks_.restitution.add(excess(out, -least * in, -elastic * in), limit, row.time, row.a, row.b);
  checks_.impulse.add(excess(row.impulse, -(1.0 + least) * in / yielding, -(1.0 + elastic) * in / yielding),
                      2.0 * limit / yielding, row.time, row.a, row.b);
}

// Speed of a bounce that rises by four tolerances under the accelerations of the two bodies.
double Replay::captureSpeed(const ContactRow& row, const std::vector<State>& states) const
{
  double acceleration = 0.0;
  for (const int body : { row.a, row.b })
    acceleration += scene_.movable(body) ? appliedAcceleration(body, states) : 0.0;
  return std::sqrt(8.0 * scene_.tolerance * acceleration);
}

// Largest acceleration of any point of a body by all that acts on it but contact.
double Replay::appliedAcceleration(int body, const std::vector<State>& states) const
{
  std::vector<Load> loads(run_.bodies);
  motion_.loads(motion_.clusterOf(body), *drive_, states, loads);
  const double radius = scene_.blocks[body].shape.radius, omega = states[body].omega;
  return loads[body].force.norm() / drive_->bodies[body].mass +
         radius * (std::abs(loads[body].torque) / motion_.inertia(*drive_, body) + omega * omega);
}

void Replay::checkRow(const ContactRow& row, const std::vector<State>& states, double slack)
{
  checks_.unit.add(std::abs(row.normal.norm() - 1.0), relative_error, row.time, row.a, row.b);
  const double limit = scene_.tolerance * (1.0 + 1e-6) + slack + relative_error * std::max(1.0, row.point.norm());
  double distance = 0.0, parting = 0.0;
  Corner corner;
  int corners = 0;
  for (const int body : { row.a, row.b })
  {
    const Vec2 outward = body == row.a ? Vec2(-row.normal) : row.normal;  // away from this body, into the other
    const double level = outward.dot(row.point);
    if (scene_.isWall(body))
    {
      const Wall& wall = scene_.wall(body);
      distance = std::max(distance, std::abs(wall.normal.dot(row.point) - wall.offset));
      parting = std::max(parting, (outward - wall.normal).norm());
      continue;
    }
    const Outline outline = place(scene_.blocks[body].shape, states[body].position, states[body].angle);
    distance = std::max(distance, boundaryDistance(outline, row.point));
    parting = std::max(parting, highest(outline, outward) - level);
    corners += addCorner(outline, row.point, 2.0 * limit, body == row.a ? -1.0 : 1.0, corner);
  }
  // Corner on corner the tolerance leaves open which of the faces that meet there parts the bodies.
  if (corners == 2 && corner.contains(row.normal))
    parting = 0.0;
  checks_.point.add(distance, limit, row.time, row.a, row.b);
  // A corner within the tolerance of a corner lies that much beside the line through the other one.
  checks_.normal.add(parting, 2.0 * limit, row.time, row.a, row.b);
  if (row.kind == Kind::Rest)
    return;
  checks_.overlap.add(overlap(row.a, row.b, states), limit, row.time, row.a, row.b);
}

double Replay::overlap(int a, int b, const std::vector<State>& states) const
{
  const auto outline = [&](int body) {
    return place(scene_.blocks[body].shape, states[body].position, states[body].angle);
  };
  if (scene_.isWall(a))
    std::swap(a, b);
  if (scene_.isWall(b))
    return std::max(0.0, scene_.wall(b).offset - lowest(outline(a), scene_.wall(b).normal));
  return std::max(0.0, -separation(outline(a), outline(b)));
}

void Replay::checkRest(size_t sample)
{
  const std::vector<State> states(run_.states.begin() + sample * run_.bodies,
                                  run_.states.begin() + (sample + 1) * run_.bodies);
  std::vector<const ContactRow*> rests;
  for (size_t i = sample == 0 ? 0 : rows_end_[sample - 1]; i < rows_end_[sample]; ++i)
    if (run_.contacts[i].kind == Kind::Rest)
      rests.push_back(&run_.contacts[i]);
  checkRestSigns(rests, states);
  for (const ContactRow* row : rests)
  {
    checkRow(*row, states, 0.0);
    double speed = 1.0;
    for (const int body : { row->a, row->b })
    {
      if (scene_.movable(body))
        speed += states[body].velocity.norm() + scene_.blocks[body].shape.radius * std::abs(states[body].omega);
    }
    checks_.rest_speed.add(std::abs(normalVelocity(*row, states)), 100.0 * relative_error * speed, row->time, row->a, row->b);
  }
}

// Where nothing presses, forces are the rounding of nothing. Where touches depend on each other nearly, forces are known as far as they do something.
void Replay::checkRestSigns(const std::vector<const ContactRow*>& rests, const std::vector<State>& states)
{
  double largest = relative_error, least = 0.0;
  for (const ContactRow* row : rests)
  {
    largest = std::max(largest, std::abs(row->impulse));
    least = std::min(least, row->impulse);
  }
  const double limit = relative_error * largest, most = -least > limit ? pull(rests, states, limit) : limit;
  for (const ContactRow* row : rests)
    checks_.sign.add(std::min(most, std::max(0.0, -row->impulse)), limit, row->time, row->a, row->b);
}

// A pair that carries force at one end of an interval only must have had an event of its island, or a change of the
// drive.
void Replay::checkRestSet(size_t sample)
{
  std::vector<std::pair<int, int>> sets[2];
  for (size_t i = sample == 1 ? 0 : rows_end_[sample - 2]; i < rows_end_[sample]; ++i)
  {
    const ContactRow& row = run_.contacts[i];
    if (row.kind == Kind::Rest && row.time >= begin_)
      sets[row.time == begin_ ? 0 : 1].emplace_back(std::minmax(row.a, row.b));
  }
  if (sets[0].empty() && sets[1].empty())
    return;
  const bool changes = timeline_.firstAfter(begin_) != timeline_.firstAfter(end_);
  for (auto& set : sets)
    std::sort(set.begin(), set.end());
  for (const auto* set : { &sets[0], &sets[1] })
  {
    const auto& other = set == &sets[0] ? sets[1] : sets[0];
    for (const auto& pair : *set)
    {
      const int body = scene_.movable(pair.first) ? pair.first : pair.second;
      const bool good = changes || eventful_[islandOf(motion_.clusterOf(body))] ||
                        std::binary_search(other.begin(), other.end(), pair);
      checks_.rest_set.add(good ? 0.0 : 1.0, 0.0, end_, pair.first, pair.second);
    }
  }
}

}  // namespace checker
