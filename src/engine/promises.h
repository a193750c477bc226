#pragma once

#include <utility>
#include <vector>

#include "block_world/time.h"

namespace block_world
{
/// Every promise about the future of the world, by its slot; the earliest on top. A promise that changes moves within the heap, so that none is
/// ever stale; what never comes due is not in it. Equal times come in the order of their slots.
class Promises
{
public:
  void reset(int slots)
  {
    heap_.clear();
    heap_.reserve(slots);
    place_.assign(slots, kNone);
  }

  /// Appends a slot without a promise.
  void grow()
  {
    place_.push_back(kNone);
    if (place_.size() > heap_.capacity())
      heap_.reserve(place_.capacity());
  }

  void set(int slot, const Time& time)
  {
    if (time.isInfinite())
    {
      remove(slot);
      return;
    }
    const Entry entry{ time, slot };
    if (place_[slot] == kNone)
    {
      heap_.push_back(entry);
      rise(static_cast<int>(heap_.size()) - 1, entry);
      return;
    }
    move(place_[slot], entry);
  }

  Time time(int slot) const
  {
    return place_[slot] == kNone ? Time::infinity() : heap_[place_[slot]].time;
  }
  /// The slot of the earliest promise; 0 where there is none.
  int first() const
  {
    return heap_.empty() ? 0 : heap_.front().slot;
  }
  /// The slot of the next one after that; 0 where there is none.
  int second() const
  {
    if (heap_.size() < 3)
      return heap_.size() < 2 ? 0 : heap_[1].slot;
    return heap_[heap_[2].before(heap_[1]) ? 2 : 1].slot;
  }
  Time firstTime() const
  {
    return heap_.empty() ? Time::infinity() : heap_.front().time;
  }

  template <class A>
  void exchange(A& archive)
  {
    archive(heap_, place_);
    heap_.reserve(place_.size());
  }

private:
  static constexpr int kNone = -1;

  struct Entry
  {
    Time time;
    int slot = 0;

    bool before(const Entry& other) const
    {
      return time < other.time || (time == other.time && slot < other.slot);
    }
    template <class A>
    void exchange(A& archive)
    {
      archive(time, slot);
    }
  };

  void put(int place, const Entry& entry)
  {
    heap_[place] = entry;
    place_[entry.slot] = place;
  }
  void remove(int slot)
  {
    const int place = place_[slot];
    if (place == kNone)
      return;
    place_[slot] = kNone;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.slot != slot)
      move(place, last);
  }
  /// Puts the entry where another one was.
  void move(int place, const Entry& entry)
  {
    if (place > 0 && entry.before(heap_[(place - 1) / 2]))
      rise(place, entry);
    else
      sink(place, entry);
  }
  void rise(int place, const Entry& entry)
  {
    for (; place > 0 && entry.before(heap_[(place - 1) / 2]); place = (place - 1) / 2)
      put(place, heap_[(place - 1) / 2]);
    put(place, entry);
  }
  void sink(int place, const Entry& entry)
  {
    const int size = static_cast<int>(heap_.size());
    for (int child = 2 * place + 1; child < size; child = 2 * place + 1)
    {
      if (child + 1 < size && heap_[child + 1].before(heap_[child]))
        ++child;
      if (!heap_[child].before(entry))
        break;
      put(place, heap_[child]);
      place = child;
    }
    put(place, entry);
  }

  std::vector<Entry> heap_;
  std::vector<int> place_;  ///< of each slot in the heap
};

}  // namespace block_world
