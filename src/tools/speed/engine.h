#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "block_world/scene.h"
#include "block_world/world.h"

/// The same scene in every engine, frame by frame at 60 Hz, as a user of that engine would write it.
namespace block_world::speed
{
constexpr int frame_rate = 60;

class Simulation
{
public:
  virtual ~Simulation() = default;
  /// Advances by 1/60 s.
  virtual void nextFrame() = 0;
  virtual MotionState state(int block) const = 0;
  /// Pairs hit so far, where the engine counts them; else -1.
  virtual std::int64_t impacts() const
  {
    return -1;
  }
};

/// One way to run an engine. What an engine has no use for stays as it is.
struct Setting
{
  std::string label;
  int steps = 1;           ///< per frame; ours, which has none, stops as often
  int iterations = 0;      ///< 0: the engine's solver does not iterate
  int effort = 0;          ///< 0: as shipped; from 1 on what is documented for accuracy
  bool sleeping = false;   ///< bodies at rest are taken out of the simulation
  double tolerance = 0.0;  ///< m, ours
};

struct Engine
{
  std::string name, version;
  std::vector<Setting> settings;  ///< the first is the default; then from coarse to fine
  std::unique_ptr<Simulation> (*build)(const Scene&, const Setting&);
  std::string (*cannot)(const Scene&);  ///< why the engine cannot do this scene; empty where it can
};

/// Ours first, then those that were found when this was built.
std::vector<Engine> engines();

Engine blockWorld();
Engine box2d();
Engine chipmunk();
Engine bullet();
Engine ode();

// ---------------------------------------------------------------- what the peers' files share

/// What tells a peer's settings apart besides the step.
struct Quality
{
  std::string label;
  int iterations = 0;
  int effort = 0;
  bool sleeping = false;
  bool finer = true;  ///< worth a sweep of the step, not only 1/60 s
};
/// Every quality with steps from 1/60 s to about 1/100000 s.
std::vector<Setting> sweep(const std::vector<Quality>& qualities);

/// Rates of decay, 1/s: damping k / m and k r / I.
struct DampingRates
{
  double linear = 0.0, angular = 0.0;
};
DampingRates dampingRates(const Scene& scene, const Block& block);

/// Moment of inertia of a rectangle.
double inertia(const Block& block);

/// The present walls as fixed blocks, thick and long enough never to be passed.
std::vector<Block> wallBlocks(const Walls& walls);

/// Index of a block by name.
int indexOf(const Scene& scene, const std::string& block);

}  // namespace block_world::speed
