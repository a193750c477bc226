#include "engine.h"

#include <sstream>

namespace block_world::speed
{
std::vector<Engine> engines()
{
  std::vector<Engine> all = { blockWorld() };
#ifdef BLOCK_WORLD_WITH_BOX2D
  all.push_back(box2d());
#endif
#ifdef BLOCK_WORLD_WITH_CHIPMUNK
  all.push_back(chipmunk());
#endif
#ifdef BLOCK_WORLD_WITH_BULLET
  all.push_back(bullet());
#endif
#ifdef BLOCK_WORLD_WITH_ODE
  all.push_back(ode());
#endif
  return all;
}

std::vector<Setting> sweep(const std::vector<Quality>& qualities)
{
  std::vector<Setting> settings;
  for (const Quality& quality : qualities)
    for (const int steps : { 1, 4, 17, 167, 1667 })
    {
      if (steps > 1 && !quality.finer)
        continue;
      std::ostringstream label;
      label << "1/" << steps * frame_rate << " s; " << quality.label;
      settings.push_back({ label.str(), steps, quality.iterations, quality.effort, quality.sleeping, 0.0 });
    }
  return settings;
}

double inertia(const Block& block)
{
  return block.mass * block.size->squaredNorm() / 12.0;
}

DampingRates dampingRates(const Scene& scene, const Block& block)
{
  return { scene.damping / block.mass, scene.damping * scene.rotational_damping_ratio / inertia(block) };
}

std::vector<Block> wallBlocks(const Walls& walls)
{
  const double thick = 2.0, far = 200.0;
  std::vector<Block> blocks;
  const auto add = [&](double x, double y, double width, double height) {
    Block block;
    block.fixed = true;
    block.size = Eigen::Vector2d(width, height);
    block.position = { x, y };
    blocks.push_back(block);
  };
  if (walls.left)
    add(*walls.left - thick / 2, 0.0, thick, far);
  if (walls.right)
    add(*walls.right + thick / 2, 0.0, thick, far);
  if (walls.bottom)
    add(0.0, *walls.bottom - thick / 2, far, thick);
  if (walls.top)
    add(0.0, *walls.top + thick / 2, far, thick);
  return blocks;
}

int indexOf(const Scene& scene, const std::string& block)
{
  for (std::size_t i = 0; i < scene.blocks.size(); ++i)
    if (scene.blocks[i].name == block)
      return static_cast<int>(i);
  return -1;
}

}  // namespace block_world::speed
