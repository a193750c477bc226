#include "block_world/cost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "block_world/world.h"

namespace block_world
{
namespace
{
constexpr std::array<const char*, kCostKinds> kNames{ "impacts", "contacts that change", "ends of arcs", "looks at pairs", "looks at cells",
                                                      "commands" };

std::size_t mainPart(const Cost& cost)
{
  const auto more = [](const Cost::Part& p, const Cost::Part& q) { return p.units < q.units; };
  return std::max_element(cost.parts.begin(), cost.parts.end(), more) - cost.parts.begin();
}

std::string percent(double share)
{
  return std::to_string(std::lround(100.0 * share)) + " %";
}

/// The names, as many as a line holds.
std::string listed(const std::vector<std::string>& names)
{
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  return names.size() > kMost ? text + " and " + std::to_string(names.size() - kMost) + " more" : text;
}
}  // namespace

std::int64_t Cost::units() const
{
  std::int64_t sum = 0;
  for (const Part& part : parts)
    sum += part.units;
  return sum;
}

Cost& Cost::operator+=(const Cost& other)
{
  for (std::size_t i = 0; i < kCostKinds; ++i)
  {
    parts[i].count += other.parts[i].count;
    parts[i].units += other.parts[i].units;
  }
  return *this;
}

Cost& Cost::operator-=(const Cost& other)
{
  for (std::size_t i = 0; i < kCostKinds; ++i)
  {
    parts[i].count -= other.parts[i].count;
    parts[i].units -= other.parts[i].units;
  }
  return *this;
}

std::string mainKind(const Cost& cost)
{
  const std::size_t kind = mainPart(cost);
  const std::int64_t units = cost.units();
  return percent(units > 0 ? static_cast<double>(cost.parts[kind].units) / static_cast<double>(units) : 0.0) + " " + kNames[kind];
}

std::string IslandCost::describe(double seconds) const
{
  const std::string what = listed(blocks) + ": " + percent(share) + " of the computing; " + mainKind(cost);
  if (!(seconds > 0.0))
    return what;
  const double rate = static_cast<double>(first.parts[mainPart(cost)].count) / seconds;
  char text[32];
  std::snprintf(text, sizeof text, rate >= 10.0 && rate < 1e7 ? "%.0f" : "%.2g", rate);
  return what + ", " + text + " a second" + (blocks.size() > 1 ? " of " + blocks.front() : "");
}

std::vector<IslandCost> CostMeter::read(const World& world)
{
  std::map<std::string, Cost> now;
  std::vector<Cost> fresh(world.bodyCount());
  bool another = false;
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    fresh[i] = now[world.name(i)] = world.cost(i);
    const auto seen = seen_.find(world.name(i));
    another = another || (seen != seen_.end() && fresh[i].units() < seen->second.units());
  }
  std::vector<IslandCost> islands;
  std::int64_t all = 0;
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const auto seen = seen_.find(world.name(i));
    if (seen != seen_.end() && !another)
      fresh[i] -= seen->second;
    all += fresh[i].units();
  }
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    std::vector<int> bodies = world.island(i);
    if (bodies.front() != i)
      continue;
    std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) { return fresh[a].units() > fresh[b].units(); });
    IslandCost island;
    island.first = fresh[bodies.front()];
    for (int body : bodies)
    {
      island.blocks.push_back(world.name(body));
      island.cost += fresh[body];
    }
    if (island.cost.units() == 0)
      continue;
    island.share = static_cast<double>(island.cost.units()) / static_cast<double>(all);
    islands.push_back(island);
  }
  std::stable_sort(islands.begin(), islands.end(),
                   [](const IslandCost& a, const IslandCost& b) { return a.cost.units() > b.cost.units(); });
  seen_.swap(now);
  return islands;
}

}  // namespace block_world
