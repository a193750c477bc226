#include <numeric>

#include "methods.h"

namespace block_world
{
namespace methods
{
/// Simultaneous: one problem for all touches, each of which has to leave with e times the speed of its approach, or
/// faster.
std::vector<double> newton(Impact impact)
{
  std::vector<int> all(impact.velocity.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> impulses(all.size(), 0.0);
  solveTogether(impact, all, impulses);
  return impulses;
}

}  // namespace methods
}  // namespace block_world
