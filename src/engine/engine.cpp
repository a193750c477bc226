#include "engine.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace block_world
{
namespace
{
MotionState initialState(const Block& block)
{
  MotionState state;
  state.position = block.position;
  state.angle = block.angle;
  state.velocity = block.velocity;
  state.omega = block.omega;
  return state;
}
}  // namespace

World::Engine::Engine(Scene loaded, const Time& begin) : now(begin), loaded_(std::move(loaded))
{
  notes = completeScene(loaded_);
  scene = loaded_;
  build();
  start();
}

/// Bodies, springs and pairs from the scene, all arcs at rest where the scene puts the blocks.
void World::Engine::build()
{
  buildBodies();
  field_.gravity = scene.gravity;
  field_.damping = scene.damping;
  field_.rotational_damping = scene.damping * scene.rotational_damping_ratio;
  zero_height_ = scene.walls.bottom.value_or(0.0);
  links_.clear();
  const auto indexOf = [this](const std::string& name) {
    for (int i = 0; i < block_count; ++i)
      if (bodies[i].name == name)
        return i;
    return -1;
  };
  for (const Spring& spring : scene.springs)
  {
    SpringLink link;
    link.first = indexOf(spring.from_block);
    link.second = spring.to_block.empty() ? -1 : indexOf(spring.to_block);
    link.first_point = spring.from_point;
    link.second_point = spring.to_point;
    link.stiffness = spring.stiffness;
    link.rest_length = spring.rest_length;
    link.damping = spring.damping;
    for (int end : { link.first, link.second })
      if (end >= 0 && !bodies[end].fixed)
        bodies[end].springs.push_back(static_cast<int>(links_.size()));
    links_.push_back(link);
  }
  refreshDissipative();
  const int count = static_cast<int>(bodies.size());
  islands_.resize(count);
  for (Island& island : islands_)
    island.clear();
  promises_.reset(pairSlot(0));
  forgetAll();
  member_of_.assign(count, -1);
  group_.clear();  // its members are bodies by their former numbers
  detector_.configure(scene.tolerance, resolution_);
  configureGrid();
}

void World::Engine::buildBodies()
{
  std::vector<Body> formers;
  formers.swap(bodies);
  double largest = 0.0;
  for (const Block& block : scene.blocks)
  {
    Body body;
    body.name = block.name;
    body.shape = std::make_shared<Polygon>(makePolygon(block.vertices));
    body.fixed = block.fixed;
    if (!block.fixed)
    {
      body.mass = block.mass;
      body.inertia = block.mass * body.shape->gyration;
      body.inverse_mass = 1.0 / body.mass;
      body.inverse_inertia = 1.0 / body.inertia;
      body.thrusters = block.thrusters ? *block.thrusters : defaultThrusters(block.vertices, scene.thrust);
      body.levels.assign(body.thrusters.size(), 0.0);
    }
    for (const Body& former : formers)
      if (former.name == body.name)
        body.crowd_cost = body.cost = former.cost;
    body.crowd_start = now;
    body.elasticity = block.elasticity.value_or(scene.elasticity);
    body.arc.order[0] = { block.position.x(), block.position.y(), block.angle };
    largest = std::max({ largest, std::abs(block.position.x()), std::abs(block.position.y()), body.shape->radius });
    bodies.push_back(body);
  }
  block_count = static_cast<int>(bodies.size());
  const auto wall = [&](const char* name, const std::optional<double>& at, const Vec2& normal) {
    if (!at)
      return;
    Body body;
    body.name = name;
    body.elasticity = scene.elasticity;
    body.shape = std::make_shared<Polygon>(makeHalfPlane(normal, normal.x() + normal.y() > 0.0 ? *at : -*at));
    largest = std::max(largest, std::abs(*at));
    bodies.push_back(body);
  };
  wall("wall_left", scene.walls.left, Vec2(1, 0));
  wall("wall_right", scene.walls.right, Vec2(-1, 0));
  wall("wall_bottom", scene.walls.bottom, Vec2(0, 1));
  wall("wall_top", scene.walls.top, Vec2(0, -1));
  resolution_ = 8.0 * (std::nextafter(largest, HUGE_VAL) - largest);
  shareShapes();
}

/// Bodies of the same shape refer to one, which stays in the cache of the processor.
void World::Engine::shareShapes()
{
  const auto byCoordinates = [](const Vec2& p, const Vec2& q) { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); };
  const auto byVertices = [&](const auto& p, const auto& q) {
    return std::lexicographical_compare(p->vertices.begin(), p->vertices.end(), q->vertices.begin(), q->vertices.end(), byCoordinates);
  };
  std::set<std::shared_ptr<const Polygon>, decltype(byVertices)> shapes(byVertices);
  for (int i = 0; i < block_count; ++i)
    bodies[i].shape = *shapes.insert(bodies[i].shape).first;
}

/// Sets the scene's states in motion at now, and begins a new account there.
void World::Engine::start()
{
  kind_ = CostKind::Command;
  tryAgain();
  for (int i = 0; i < block_count; ++i)
  {
    Body& body = bodies[i];
    putAt(i, initialState(scene.blocks[i]), now);
    if (body.fixed)
    {
      body.arc.degree = 0;
      continue;
    }
    body.island = i;
    islands_[i].bodies.assign(1, i);
    islands_[i].rests.clear();
  }
  pairAll();
  resolveAll(now);
  input_start_ = now;
  next_input_ = 0;
  promises_.set(0, nextInputTime());
  restartAccount();
}

/// Bodies changed in number: everything is built anew from the scene, with the present states, forces and springs of those that stay.
void World::Engine::rebuild(const Time& time)
{
  const double before = storedTotal(time);
  for (int i = 0; i < block_count; ++i)
    if (!bodies[i].fixed && bodies[i].island == i)
      closeIsland(i, time);
  const std::vector<Body> old(bodies.begin(), bodies.begin() + block_count);
  const Time input_promise = promises_.time(0);
  build();
  promises_.set(0, input_promise);
  for (int i = 0; i < block_count; ++i)
  {
    Body& body = bodies[i];
    body.arc.start = time;
    if (body.fixed)
      continue;
    MotionState state = initialState(scene.blocks[i]);
    for (const Body& former : old)
    {
      if (former.name != body.name)
        continue;
      state = former.stateAt(time);
      body.levels = former.levels;
      body.thrust_until = former.thrust_until;
      body.wrench_force = former.wrench_force;
      body.wrench_torque = former.wrench_torque;
      body.mouse = former.mouse;
      refreshPush(body);
    }
    putAt(i, state, time);
    body.island = i;
    islands_[i].bodies.assign(1, i);
  }
  refreshDissipative();
  // The jump is the command's; what impacts take at once is theirs.
  command_work_ += storedTotal(time) - before;
  pairAll();
  resolveAll(time);
  for (int i = 0; i < block_count; ++i)
    if (!bodies[i].fixed)
      expiryPromise(i);
}

void World::Engine::resolveAll(const Time& time)
{
  std::vector<char> done(bodies.size(), 0);
  for (int i = 0; i < block_count; ++i)
  {
    if (bodies[i].fixed || done[i])
      continue;
    seeds_.assign(1, i);
    resolve(time);
    for (const Member& member : group_.members)
      done[member.body] = 1;
  }
}

Time World::Engine::advance(Time target, std::int64_t max_events)
{
  std::int64_t kept = 0;
  while (promises_.firstTime() <= target)
  {
    if (statistics.stalled || (max_events >= 0 && kept++ >= max_events))
      return now;
    const int slot = promises_.first();
    const Time time = promises_.firstTime();
    if (time > now)
      now = time;
    ++statistics.events;
    fetchFor(promises_.second());
    keep(slot, now);
  }
  now = target;
  return now;
}

/// A promise came due.
void World::Engine::keep(int slot, const Time& time)
{
  const int count = static_cast<int>(bodies.size());
  if (slot == 0)
    applyInputs(time);
  else if (slot < 1 + count)
    expire(slot - 1, time);
  else if (slot < 1 + 2 * count)
  {
    const int island = slot - 1 - count;
    if (time < bodies[island].arc.end)
    {
      kind_ = CostKind::Contact;
      seeds_.assign(1, island);
      resolve(time);
    }
    else
    {
      kind_ = CostKind::Arc;
      continueIsland(island, time);
    }
  }
  else if (slot < pairSlot(0))
  {
    kind_ = CostKind::Cell;
    chargeEvent(slot - cellSlot(0), time);
    lookAtCell(slot - cellSlot(0), time);
  }
  else
  {
    const int pair = slot - pairSlot(0);
    const int a = pairs_[pair].a, b = pairs_[pair].b;
    if (!pairs_[pair].contact_due)
    {
      kind_ = CostKind::Look;
      chargeEvent(a, time);
      chargeEvent(b, time);
      lookAtPair(pair, time);
      return;
    }
    kind_ = CostKind::Contact;
    seeds_.clear();
    if (!bodies[a].fixed)
      seeds_.push_back(a);
    if (!bodies[b].fixed)
      seeds_.push_back(b);
    resolve(time);
  }
}

}  // namespace block_world
