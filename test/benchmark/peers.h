#pragma once

#include <memory>
#include <string>
#include <vector>

#include "block_world/scene.h"
#include "block_world/world.h"

/// The same scene in every engine, frame by frame at 60 Hz, as a user of that engine would write it.
namespace peers
{
constexpr int frame_rate = 60;

class Simulation
{
public:
  virtual ~Simulation() = default;
  /// Advances by 1/60 s.
  virtual void nextFrame() = 0;
  virtual block_world::MotionState state(int block) const = 0;
};

struct Engine
{
  std::string name;
  std::unique_ptr<Simulation> (*build)(const block_world::Scene&);
};

std::unique_ptr<Simulation> buildBlockWorld(const block_world::Scene& scene);
std::unique_ptr<Simulation> buildBox2d(const block_world::Scene& scene);
std::unique_ptr<Simulation> buildChipmunk(const block_world::Scene& scene);

/// Rates of decay, 1/s: damping k v / m and k r omega / I.
struct DampingRates
{
  double linear = 0.0, angular = 0.0;
};
DampingRates dampingRates(const block_world::Scene& scene, const block_world::Block& block);

/// Moment of inertia of a rectangle.
double inertia(const block_world::Block& block);

/// The ends of the present walls, each wall long enough never to be passed at its side.
struct WallLine
{
  Eigen::Vector2d from, to;
};
std::vector<WallLine> wallLines(const block_world::Walls& walls);

}  // namespace peers
