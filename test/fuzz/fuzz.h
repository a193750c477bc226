#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "block_world/world.h"

// What the fuzz targets do with an input. Plain functions, so that an input that once failed is replayed by a plain
// test.

namespace block_world
{
namespace fuzz
{
/// The input as a scene file: loaded, written and loaded again; a small one is set in motion. Returns what is wrong, or
/// nothing.
std::string runScene(const std::uint8_t* data, std::size_t size);

/// The input as a small scene and what is done with it: commands, good and bad, and advances. Returns what is wrong, or
/// nothing.
std::string runCommands(const std::uint8_t* data, std::size_t size);

/// Watches what holds in every world at every time.
class Invariants
{
public:
  /// States are finite, nothing overlaps by more than the tolerance, the energy account is balanced, impacts have given
  /// nothing. Returns what is wrong, or nothing.
  std::string check(const World& world);

  /// Blocks were put somewhere, as at the start: they may overlap by less than the tolerance.
  void place()
  {
    ++placed_;
  }

private:
  /// J, largest energy met so far. Forces of newtons do work on rounding errors of positions where there is no energy
  /// at all.
  double scale_ = 1.0;
  int placed_ = 1;
};

}  // namespace fuzz
}  // namespace block_world
