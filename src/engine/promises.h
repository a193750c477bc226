#pragma once

#include <utility>
#include <vector>

#include "block_world/time.h"

namespace block_world
{
/// Every promise about the future of the world, by its slot; the earliest on top. A promise that changes moves within the heap, so that none is
/// ever stale. Equal times come in the order of their slots.
class Promises
{
public:
  void reset(int slots)
  {
    times_.assign(slots, Time::infinity());
    heap_.resize(slots);
    place_.resize(slots);
    for (int i = 0; i < slots; ++i)
      heap_[i] = place_[i] = i;
  }

  /// Appends a slot without a promise.
  void grow()
  {
    const int slot = static_cast<int>(times_.size());
    times_.push_back(Time::infinity());
    heap_.push_back(slot);
    place_.push_back(slot);
  }

  void set(int slot, const Time& time)
  {
    const bool earlier = time < times_[slot];
    times_[slot] = time;
    if (earlier)
      rise(place_[slot]);
    else
      sink(place_[slot]);
  }

  const Time& time(int slot) const
  {
    return times_[slot];
  }
  int first() const
  {
    return heap_.front();
  }
  const Time& firstTime() const
  {
    return times_[heap_.front()];
  }

  template <class A>
  void exchange(A& archive)
  {
    archive(times_, heap_, place_);
  }

private:
  bool before(int a, int b) const
  {
    return times_[a] < times_[b] || (times_[a] == times_[b] && a < b);
  }
  void put(int place, int slot)
  {
    heap_[place] = slot;
    place_[slot] = place;
  }
  void rise(int place)
  {
    const int slot = heap_[place];
    while (place > 0 && before(slot, heap_[(place - 1) / 2]))
    {
      put(place, heap_[(place - 1) / 2]);
      place = (place - 1) / 2;
    }
    put(place, slot);
  }
  void sink(int place)
  {
    const int slot = heap_[place];
    const int size = static_cast<int>(heap_.size());
    for (int child = 2 * place + 1; child < size; child = 2 * place + 1)
    {
      if (child + 1 < size && before(heap_[child + 1], heap_[child]))
        ++child;
      if (!before(heap_[child], slot))
        break;
      put(place, heap_[child]);
      place = child;
    }
    put(place, slot);
  }

  std::vector<Time> times_;  ///< by slot
  std::vector<int> heap_;    ///< slots in heap order
  std::vector<int> place_;   ///< of each slot in the heap
};

}  // namespace block_world
