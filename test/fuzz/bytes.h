#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace block_world
{
namespace fuzz
{
/// Turns the bytes of an input into choices and numbers. Zeros come when they are used up.
class Bytes
{
public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size)
  {
  }
  bool empty() const
  {
    return next_ == end_;
  }
  std::uint8_t byte()
  {
    return next_ == end_ ? 0 : *next_++;
  }
  int below(int end)
  {
    return byte() % end;
  }
  bool one()
  {
    return byte() % 2 == 1;
  }
  /// In steps of a sixteenth within -7..7, so that exact contact is common.
  double coordinate()
  {
    return byte() % 225 / 16.0 - 7.0;
  }
  /// From a list.
  template <std::size_t N>
  double of(const double (&values)[N])
  {
    return values[byte() % N];
  }
  /// A coordinate; of 32 times once a number that no command may hold.
  double risky()
  {
    const std::uint8_t choice = byte();
    if (choice % 32 != 31)
      return coordinate();
    return choice < 128 ? std::numeric_limits<double>::quiet_NaN() : choice < 192 ? HUGE_VAL : -HUGE_VAL;
  }

private:
  const std::uint8_t *next_, *end_;
};

}  // namespace fuzz
}  // namespace block_world
