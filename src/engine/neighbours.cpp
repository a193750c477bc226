// Which pairs there are: each body with the bodies near it in the grid and the walls near its cell. When each is to be looked at.

#include <algorithm>

#include "engine.h"

namespace block_world
{
void World::Engine::configureGrid()
{
  std::vector<double> radii;
  for (const Body& body : bodies)
    radii.push_back(body.shape->radius);
  grid_.configure(radii, scene.tolerance);
  pairs_.clear();
  free_pair_ = -1;
  pair_mark_.clear();
  body_mark_.assign(bodies.size(), 0);
  mark_ = 0;
}

/// Whether a body may meet a wall before it changes its cell.
bool World::Engine::nearWall(int body, int wall) const
{
  const Grid::Box box = grid_.keeps(body);
  const Face& face = bodies[wall].shape->faces.front();
  double lowest = -face.offset;
  for (int axis : { 0, 1 })
    if (face.normal[axis] != 0.0)
      lowest += face.normal[axis] * (face.normal[axis] > 0.0 ? box.low : box.high)[axis];
  return lowest <= bodies[body].shape->radius + scene.tolerance;
}

/// Whom a body may meet before it changes its cell, ascending.
void World::Engine::findNear(int body)
{
  grid_.neighbours(body, near_);
  std::sort(near_.begin(), near_.end());
  for (int wall = block_count; wall < static_cast<int>(bodies.size()); ++wall)
    if (nearWall(body, wall))
      near_.push_back(wall);
}

/// All pairs, where the bodies are now. Their promises come with the arcs.
void World::Engine::pairAll()
{
  for (int a = 0; a < block_count; ++a)
    grid_.place(a, bodies[a].arc.order[0].place());
  for (int a = 0; a < block_count; ++a)
  {
    findNear(a);
    for (int b : near_)
      if (b > a && !(bodies[a].fixed && bodies[b].fixed))
        addPair(a, b);
  }
}

int World::Engine::addPair(int a, int b)
{
  int index = free_pair_;
  if (index < 0)
  {
    index = static_cast<int>(pairs_.size());
    pairs_.emplace_back();
    pair_mark_.push_back(0);
    promises_.grow();
  }
  else
    free_pair_ = pairs_[index].next[0];
  Pair& pair = pairs_[index];
  pair = Pair();
  pair.a = std::min(a, b);
  pair.b = std::max(a, b);
  for (int side : { 0, 1 })
  {
    const int body = side == 0 ? pair.a : pair.b;
    int& first = bodies[body].first_pair;
    pair.next[side] = first;
    if (first >= 0)
      pairs_[first].previous[pairs_[first].side(body)] = index;
    first = index;
  }
  return index;
}

void World::Engine::dropPair(int index)
{
  Pair& pair = pairs_[index];
  for (int side : { 0, 1 })
  {
    const int body = side == 0 ? pair.a : pair.b, next = pair.next[side], previous = pair.previous[side];
    if (next >= 0)
      pairs_[next].previous[pairs_[next].side(body)] = previous;
    (previous >= 0 ? pairs_[previous].next[pairs_[previous].side(body)] : bodies[body].first_pair) = next;
  }
  pair = Pair();
  promises_.set(pairSlot(index), Time::infinity());
  pair.next[0] = free_pair_;
  free_pair_ = index;
}

/// The body may have left its cell: then others are near it.
void World::Engine::lookAtCell(int body, const Time& time)
{
  if (grid_.place(body, snapshot(body, time).position))
  {
    ++mark_;
    for (int index = bodies[body].first_pair, next = -1; index >= 0; index = next)
    {
      next = pairs_[index].nextOf(body);
      const int other = pairs_[index].other(body);
      if (other < block_count ? grid_.near(body, other) : nearWall(body, other))
        body_mark_[other] = mark_;
      else
        dropPair(index);
    }
    findNear(body);
    for (int other : near_)
      if (body_mark_[other] != mark_)
        lookAtPair(addPair(body, other), time);
  }
  promiseCell(body, time);
}

void World::Engine::promiseCell(int body, const Time& time)
{
  const Body& b = bodies[body];
  if (grid_.endless())
  {
    promises_.set(cellSlot(body), Time::infinity());
    return;
  }
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
  double span = restsFlat(pair, *a.shape, *b.shape) ? horizon : -1.0;
  if (pair.resting.empty())
    span = detector_.apart(a, now_a, b, now_b, horizon);
  pair.contact_due = false;
  if (span < 0.0)
  {
    fetchShape(pair.a);
    fetchShape(pair.b);
    const View view_a{ &a, &now_a, frame(pair.a, time) }, view_b{ &b, &now_b, frame(pair.b, time) };
    span = detector_.certify(pair, view_a, view_b, time, horizon);
  }
  promises_.set(pairSlot(index), span < horizon ? time + span : end);
}

}  // namespace block_world
