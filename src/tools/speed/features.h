#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace block_world::speed
{
/// What it costs us to model more, in s of CPU time per simulated s, medians.
struct FeatureCost
{
  std::string name;
  std::string idle, used;  ///< what the scenes have
  double without_cost = 0.0, idle_cost = 0.0,
         used_cost = 0.0;  ///< of the same scene without, with it idle, with it in use
};
std::vector<FeatureCost> featureCosts(int repeats);
void writeFeatures(const std::vector<FeatureCost>& costs, std::ostream& out);

}  // namespace block_world::speed
