#pragma once

#include <cstddef>

namespace block_world
{
/// What the cache of the processor takes in at a time, in bytes. What is looked at most often begins such a line.
constexpr std::size_t kCacheLine = 64;

/// Room for vectors that take so many entries, of which none grows by itself: the memory of all doubles at once and soon suffices for good.
class Room
{
public:
  template <class... Vector>
  void provide(std::size_t entries, Vector&... vectors)
  {
    if (entries <= entries_)
      return;
    entries_ = 2 * entries;
    (vectors.reserve(entries_), ...);
  }

private:
  std::size_t entries_ = 0;
};

}  // namespace block_world
