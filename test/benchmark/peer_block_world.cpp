#include "peers.h"

namespace peers
{
namespace
{
class BlockWorld : public Simulation
{
public:
  explicit BlockWorld(const block_world::Scene& scene) : world_(scene)
  {
  }

  void nextFrame() override
  {
    ++frame_;
    world_.advance(block_world::Time::fromNanoseconds((frame_ * 1000000000 + frame_rate / 2) / frame_rate));
  }

  block_world::MotionState state(int block) const override
  {
    return world_.state(block);
  }

private:
  block_world::World world_;
  std::int64_t frame_ = 0;
};
}  // namespace

std::unique_ptr<Simulation> buildBlockWorld(const block_world::Scene& scene)
{
  return std::make_unique<BlockWorld>(scene);
}

}  // namespace peers
