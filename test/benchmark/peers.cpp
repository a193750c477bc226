#include "peers.h"

namespace peers
{
double inertia(const block_world::Block& block)
{
  return block.mass * block.size->squaredNorm() / 12.0;
}

DampingRates dampingRates(const block_world::Scene& scene, const block_world::Block& block)
{
  return { scene.damping / block.mass, scene.damping * scene.rotational_damping_ratio / inertia(block) };
}

std::vector<WallLine> wallLines(const block_world::Walls& walls)
{
  const double far = 100.0;
  std::vector<WallLine> lines;
  if (walls.left)
    lines.push_back({ { *walls.left, -far }, { *walls.left, far } });
  if (walls.right)
    lines.push_back({ { *walls.right, -far }, { *walls.right, far } });
  if (walls.bottom)
    lines.push_back({ { -far, *walls.bottom }, { far, *walls.bottom } });
  if (walls.top)
    lines.push_back({ { -far, *walls.top }, { far, *walls.top } });
  return lines;
}

}  // namespace peers
