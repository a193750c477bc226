#include <algorithm>
#include <cmath>

#include "engine.h"

namespace block_world::speed
{
namespace
{
class BlockWorld : public Simulation
{
public:
  BlockWorld(const Scene& scene, int samples) : samples_(samples), rate_(frame_rate * samples), world_(scene)
  {
    world_.keepContacts(false);
  }

  void nextFrame() override
  {
    // Sixtieths of a second are no whole nanoseconds, which would cost 3e-10 s.
    for (int i = 0; i < samples_; ++i)
    {
      if (++sample_ == rate_)
      {
        sample_ = 0;
        second_ = second_ + 1.0;
      }
      world_.advance(second_ + static_cast<double>(sample_) / rate_);
    }
  }

  MotionState state(int block) const override
  {
    return world_.state(block);
  }

  std::int64_t impacts() const override
  {
    return world_.statistics().impacts;
  }

private:
  int samples_, rate_, sample_ = 0;  ///< a frame, a second, since the last whole second
  Time second_;
  World world_;
};

std::unique_ptr<Simulation> build(const Scene& scene, const Setting& setting)
{
  // A hundredth of the smallest block is the most that a scene may have.
  double smallest = HUGE_VAL;
  for (const Block& block : scene.blocks)
    smallest = std::min(smallest, block.size->minCoeff());
  Scene with_tolerance = scene;
  with_tolerance.tolerance = std::min(setting.tolerance, 0.01 * smallest);
  return std::make_unique<BlockWorld>(with_tolerance, setting.steps);
}

}  // namespace

Engine blockWorld()
{
  Engine engine{ "block_world", BLOCK_WORLD_VERSION, {}, build, [](const Scene&) { return std::string(); } };
  for (const auto& [label, tolerance] :
       { std::pair("1e-6 m", 1e-6), std::pair("1e-3 m", 1e-3), std::pair("1e-9 m", 1e-9), std::pair("1e-12 m", 1e-12) })
  {
    Setting setting;
    setting.label = std::string("tolerance ") + label;
    setting.tolerance = tolerance;
    engine.settings.push_back(setting);
  }
  return engine;
}

}  // namespace block_world::speed
