#include <algorithm>

#include "methods.h"

namespace block_world
{
namespace methods
{
/// One approaching touch at a time, together with all touches at its two bodies that do not open, until none
/// approaches.
std::vector<double> hybrid(Impact impact)
{
  std::vector<double> impulses(impact.velocity.size(), 0.0);
  for (int rounds = 0; rounds < 100000; ++rounds)
  {
    const int focus = firstApproaching(impact);
    if (focus < 0)
      break;
    const auto shares = [&](int i) {
      return std::any_of(impact.at[i].begin(), impact.at[i].end(), [&](int body) {
        return std::count(impact.at[focus].begin(), impact.at[focus].end(), body) > 0;
      });
    };
    std::vector<int> together;
    for (std::size_t i = 0; i < impact.velocity.size(); ++i)
      if (impact.velocity[i] < slow && shares(static_cast<int>(i)))
        together.push_back(static_cast<int>(i));
    solveTogether(impact, together, impulses);
  }
  return impulses;
}

}  // namespace methods
}  // namespace block_world
