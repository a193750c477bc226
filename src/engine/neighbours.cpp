// Which pairs there are: each body with every wall, and with the bodies near it in the grid. When each is to be looked at.

#include <algorithm>

#include "engine.h"

namespace block_world
{
void World::Engine::configureGrid()
{
  std::vector<double> radii;
  for (const Body& body : bodies)
    radii.push_back(body.shape.radius);
  grid_.configure(radii, scene.tolerance);
  pairs_.clear();
  free_pairs_.clear();
  pair_mark_.clear();
  body_mark_.assign(bodies.size(), 0);
  mark_ = 0;
}

/// All pairs, where the bodies are now. Their promises come with the arcs.
void World::Engine::pairAll()
{
  for (int a = 0; a < block_count; ++a)
    grid_.place(a, Vec2(bodies[a].arc.x[0], bodies[a].arc.y[0]));
  for (int a = 0; a < block_count; ++a)
  {
    grid_.neighbours(a, near_);
    std::sort(near_.begin(), near_.end());
    for (int b : near_)
      if (b > a && !(bodies[a].fixed && bodies[b].fixed))
        addPair(a, b);
    for (int wall = block_count; wall < static_cast<int>(bodies.size()) && !bodies[a].fixed; ++wall)
      addPair(a, wall);
  }
}

void World::Engine::addPair(int a, int b)
{
  int index;
  if (free_pairs_.empty())
  {
    index = static_cast<int>(pairs_.size());
    pairs_.emplace_back();
    pair_mark_.push_back(0);
    promises_.grow();
  }
  else
  {
    index = free_pairs_.back();
    free_pairs_.pop_back();
  }
  Pair& pair = pairs_[index];
  pair.a = std::min(a, b);
  pair.b = std::max(a, b);
  bodies[a].pairs.push_back(index);
  bodies[b].pairs.push_back(index);
}

void World::Engine::dropPair(int index)
{
  Pair& pair = pairs_[index];
  for (int body : { pair.a, pair.b })
  {
    std::vector<int>& list = bodies[body].pairs;
    list.erase(std::find(list.begin(), list.end(), index));
  }
  pair = Pair();
  promises_.set(pairSlot(index), Time::infinity());
  free_pairs_.push_back(index);
}

/// The body may have left its cell: then others are near it.
void World::Engine::lookAtCell(int body, const Time& time)
{
  if (grid_.place(body, snapshot(body, time).position))
  {
    ++mark_;
    const std::vector<int>& list = bodies[body].pairs;
    for (std::size_t k = list.size(); k-- > 0;)
    {
      const Pair& pair = pairs_[list[k]];
      const int other = pair.a == body ? pair.b : pair.a;
      if (other >= block_count)
        continue;
      if (grid_.near(body, other))
        body_mark_[other] = mark_;
      else
        dropPair(list[k]);
    }
    grid_.neighbours(body, near_);
    std::sort(near_.begin(), near_.end());
    for (int other : near_)
      if (body_mark_[other] != mark_)
      {
        addPair(body, other);
        lookAtPair(bodies[body].pairs.back(), time);
      }
  }
  promiseCell(body, time);
}

void World::Engine::promiseCell(int body, const Time& time)
{
  const Body& b = bodies[body];
  const double horizon = b.arc.end - time;
  const Grid::Box box = grid_.keeps(body);
  const double span = detector_.within(b, snapshot(body, time), box.low, box.high, horizon);
  promises_.set(cellSlot(body), span < horizon ? time + span : b.arc.end);
}

void World::Engine::lookAtPairs(const Time& time)
{
  for (const Member& m : group_.members)
    if (!bodies[m.body].fixed)
      promiseCell(m.body, time);
  for (int index : group_pairs_)
    lookAtPair(index, time);
}

void World::Engine::lookAtPair(int index, const Time& time)
{
  Pair& pair = pairs_[index];
  charge(pair.a, 1);
  charge(pair.b, 1);
  const Body &a = bodies[pair.a], &b = bodies[pair.b];
  const Time end = std::min(a.arc.end, b.arc.end);
  const double horizon = end - time;
  const Snapshot &now_a = snapshot(pair.a, time), &now_b = snapshot(pair.b, time);
  double span = -1.0;
  if (pair.resting.empty())
    span = detector_.apart(a, now_a, b, now_b, horizon);
  pair.contact_due = false;
  if (span < 0.0)
  {
    const View view_a{ &a, &now_a, frame(pair.a, time) }, view_b{ &b, &now_b, frame(pair.b, time) };
    span = detector_.certify(pair, view_a, view_b, time, horizon);
  }
  promises_.set(pairSlot(index), span < horizon ? time + span : end);
}

}  // namespace block_world
