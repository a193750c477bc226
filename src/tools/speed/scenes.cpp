#include "scenes.h"

namespace block_world::speed
{
std::vector<Family> families()
{
  std::vector<Family> all;
  addSingles(all);
  addContacts(all);
  addCrowds(all);
  return all;
}

Block box(double width, double height, double x, double y, double angle)
{
  Block block;
  block.size = Eigen::Vector2d(width, height);
  block.position = { x, y };
  block.angle = angle;
  return block;
}

Block moving(Block block, double vx, double vy, double omega)
{
  block.velocity = { vx, vy };
  block.omega = omega;
  return block;
}

Scene finished(Scene scene, const std::string& name)
{
  scene.name = name;
  for (std::size_t i = 0; i < scene.blocks.size(); ++i)
    scene.blocks[i].name = "block" + std::to_string(i + 1);
  completeScene(scene);
  return scene;
}

}  // namespace block_world::speed
