#pragma once

#include <string>
#include <vector>

#include "case.h"
#include "player.h"
#include "result.h"

namespace campaign
{
/// Where every block is at the times of comparison, and all contacts of the run.
struct Track
{
  struct Placed
  {
    std::string name;
    Eigen::Vector2d position;
    double angle, radius;
  };
  std::vector<std::vector<Placed>> places;
  std::vector<block_world::ContactEvent> contacts;
};

/// Plays a case to its end, reads everything at many uneven times, and the places at the times of comparison.
Track read(const Case& item, Player& player);

/// Mirrored and re-ordered copies must go the same way as the run itself, for as long as two copies that start off by a
/// rounding do: what rounding errors grow to is thus measured, not guessed.
void compareCopies(const Case& item, const Track& track, double cpu, Result& result);

}  // namespace campaign
