#include <algorithm>
#include <cmath>

#include "block_world/scene_yaml.h"
#include "fuzz.h"

namespace block_world
{
namespace fuzz
{
namespace
{
constexpr std::size_t kMostBlocks = 12;
constexpr std::int64_t kMostEvents = 300;

/// Whether a number of the scene is so far from 1 that products of four of them may leave the range of doubles, or that
/// sums of energies drown in rounding: such a scene must not crash, but need not come out right.
bool isExtreme(double value)
{
  return value != 0.0 && !(std::abs(value) > 1e-4 && std::abs(value) < 1e4);
}

bool isExtreme(const Eigen::Vector2d& vector)
{
  return isExtreme(vector.x()) || isExtreme(vector.y());
}

bool isExtreme(const Block& block)
{
  return isExtreme(block.mass) || isExtreme(block.position) || isExtreme(block.angle) || isExtreme(block.velocity) ||
         isExtreme(block.omega) ||
         std::any_of(block.vertices.begin(), block.vertices.end(),
                     [](const Eigen::Vector2d& v) { return v.norm() > 1e4 || v.norm() < 1e-2; });
}

bool isExtreme(const Spring& spring)
{
  return isExtreme(spring.from_point) || isExtreme(spring.to_point) || isExtreme(spring.stiffness) ||
         isExtreme(spring.rest_length) || isExtreme(spring.damping);
}

bool isExtreme(const Scene& scene)
{
  for (const auto& wall : { scene.walls.left, scene.walls.right, scene.walls.bottom, scene.walls.top })
    if (wall && isExtreme(*wall))
      return true;
  return isExtreme(scene.gravity) || isExtreme(scene.damping) || isExtreme(scene.rotational_damping_ratio) ||
         isExtreme(scene.thrust) || !scene.inputs.empty() ||
         std::any_of(scene.blocks.begin(), scene.blocks.end(), [](const Block& block) { return isExtreme(block); }) ||
         std::any_of(scene.springs.begin(), scene.springs.end(),
                     [](const Spring& spring) { return isExtreme(spring); });
}

}  // namespace

std::string runScene(const std::uint8_t* data, std::size_t size)
{
  Scene scene;
  try
  {
    scene = loadSceneText(std::string(reinterpret_cast<const char*>(data), size));
  }
  catch (const SceneFileError&)
  {
    return std::string();  // the one way in which a text may be refused
  }
  const std::string written = writeScene(scene);
  try
  {
    if (writeScene(loadSceneText(written)) != written)
      return "written and loaded, the scene is another one: " + written;
  }
  catch (const SceneFileError& error)
  {
    return "written, the scene does not load: " + std::string(error.what()) + "\n" + written;
  }
  if (scene.blocks.size() > kMostBlocks)
    return std::string();
  World world(scene);
  Invariants invariants;
  const bool extreme = isExtreme(world.scene());
  std::string wrong = extreme ? std::string() : invariants.check(world);
  world.advance(Time::fromSeconds(1.0), kMostEvents);
  if (wrong.empty() && !extreme)
    wrong = invariants.check(world);
  return wrong;
}

}  // namespace fuzz
}  // namespace block_world
