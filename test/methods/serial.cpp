#include "methods.h"

namespace block_world
{
namespace methods
{
/// One approaching touch at a time, by equation (11), in the order of the list, until none approaches.
std::vector<double> serial(Impact impact)
{
  std::vector<double> impulses(impact.velocity.size(), 0.0);
  for (int hits = 0; hits < 100000; ++hits)
  {
    const int i = firstApproaching(impact);
    if (i < 0)
      break;
    solveTogether(impact, { i }, impulses);
  }
  return impulses;
}

}  // namespace methods
}  // namespace block_world
