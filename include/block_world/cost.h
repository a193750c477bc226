#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace block_world
{
class World;

/// What the engine computes for.
enum class CostKind
{
  Impact,   ///< blocks that hit something
  Contact,  ///< contacts that begin, end or change without a hit
  Arc,      ///< arcs that reach their end
  Look,     ///< promises of two bodies not to meet yet
  Cell,     ///< promises of a block not to leave its cell yet
  Command   ///< commands and timed inputs, and the start itself
};
constexpr std::size_t kCostKinds = 6;

/// What was done with a block, or with several. Counted, never timed: the same run, the same numbers.
///
/// A block is charged for every event that it takes part in: one unit for the event, one for each pair of its that is looked at, one for each
/// order of the arc that it gets, and for each of its touches as many as are decided together.
struct Cost
{
  struct Part
  {
    std::int64_t count = 0;  ///< of Impact: hits, as Statistics counts them; else events
    std::int64_t units = 0;
  };
  std::array<Part, kCostKinds> parts;

  Part& operator[](CostKind kind)
  {
    return parts[static_cast<std::size_t>(kind)];
  }
  const Part& operator[](CostKind kind) const
  {
    return parts[static_cast<std::size_t>(kind)];
  }
  std::int64_t units() const;
  Cost& operator+=(const Cost& other);
  Cost& operator-=(const Cost& other);
};

/// What most of the units went into, in words: "98 % impacts".
std::string mainKind(const Cost& cost);

/// What was done with the blocks of an island.
struct IslandCost
{
  std::vector<std::string> blocks;  ///< costliest first
  Cost cost;
  Cost first;          ///< of the first block alone
  double share = 0.0;  ///< of the units of all islands

  /// "block3, block5: 97 % of the computing; 98 % impacts, 41000 a second of block3"; without the rate where no time has passed.
  std::string describe(double seconds) const;
};

/// Tells what the computing of a world was done for since it was last asked. Asking changes nothing in the world.
class CostMeter
{
public:
  /// The islands that the world has now, costliest first; without those that had none. Cost counts from the world's start the first time, or
  /// where the world is another than the last time.
  std::vector<IslandCost> read(const World& world);

private:
  std::map<std::string, Cost> seen_;  ///< by block
};

}  // namespace block_world
