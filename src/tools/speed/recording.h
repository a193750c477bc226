#pragma once

#include <cstdint>
#include <vector>

#include "block_world/world.h"

namespace block_world::speed
{
/// All states of a simulation, at 60 Hz, the first at the start.
struct Recording
{
  int blocks = 0;
  std::vector<MotionState> states;

  int frames() const
  {
    return static_cast<int>(states.size()) / blocks;
  }
  const MotionState& at(int frame, int block) const
  {
    return states[static_cast<std::size_t>(frame) * blocks + block];
  }
};

/// One for each scene of a case.
struct Run
{
  std::vector<Recording> recordings;
  std::int64_t impacts = -1;  ///< where the engine counts them
};

}  // namespace block_world::speed
