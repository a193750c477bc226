#include "snapshot.h"

#include <algorithm>

namespace block_world
{
namespace
{
// Of the file: to be raised whenever what is exchanged changes.
constexpr char kMagic[] = "block_world state\n";
constexpr std::uint32_t kVersion = 4;

/// Tells apart files of processors that order their bytes otherwise.
constexpr std::uint32_t kByteOrder = 0x01020304;

/// Everything before the state itself.
struct Head
{
  std::string magic = kMagic;
  std::uint32_t byte_order = kByteOrder, version = kVersion;
  std::uint64_t size = 0;

  template <class A>
  void exchange(A& archive)
  {
    archive.raw(&magic[0], magic.size());
    archive(byte_order, version, size);
  }
};

constexpr std::size_t kHeadSize = sizeof kMagic - 1 + 2 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t kSumSize = sizeof(std::uint64_t);

/// Checks the frame of a saved state and returns its inner part's size.
std::uint64_t checkFrame(const std::string& bytes)
{
  if (bytes.compare(0, sizeof kMagic - 1, kMagic) != 0)
    throw std::runtime_error("not a saved state of block_world");
  if (bytes.size() < kHeadSize + kSumSize)
    throw std::runtime_error("the saved state is cut short");
  Head head;
  Reader reader(bytes.data(), kHeadSize, 0);
  reader(head);
  if (head.byte_order != kByteOrder)
    throw std::runtime_error("the state was saved on a processor with another order of bytes");
  if (head.version != kVersion)
    throw std::runtime_error("the state has format " + std::to_string(head.version) + ", this program reads format " +
                             std::to_string(kVersion));
  const std::uint64_t inner = bytes.size() - kHeadSize - kSumSize;
  if (head.size != inner)
    throw std::runtime_error(head.size > inner ? "the saved state is cut short" : "the saved state has something after its end");
  std::uint64_t sum = 0;
  Reader tail(bytes.data() + kHeadSize + inner, kSumSize, 0);
  tail(sum);
  if (sum != fnv1a(bytes.data(), kHeadSize + inner))
    throw std::runtime_error("the saved state is damaged: its checksum differs");
  return inner;
}
}  // namespace

/// All but the workspace and what waits to be taken (contacts, inputs applied).
template <class A>
void World::Engine::exchange(A& archive)
{
  archive(now, scene, loaded_, notes, statistics, block_count, bodies, field_, zero_height_, resolution_, dissipative_, links_);
  archive(grid_, pairs_, free_pair_, islands_, promises_, stall_after, input_start_, next_input_);
  archive(initial_total_, thrust_work_, spring_work_, command_work_, damping_loss_, impact_loss_);
}

std::string World::Engine::save() const
{
  // A writer changes nothing.
  Writer inner;
  const_cast<Engine*>(this)->exchange(inner);
  Head head;
  head.size = inner.bytes.size();
  Writer file;
  file(head);
  file.bytes += inner.bytes;
  std::uint64_t sum = fnv1a(file.bytes.data(), file.bytes.size());
  file(sum);
  return file.bytes;
}

World::Engine::Engine(const std::string& saved, std::int64_t seconds_later)
{
  Reader reader(saved.data() + kHeadSize, checkFrame(saved), seconds_later);
  exchange(reader);
  if (reader.left() != 0)
    throw std::runtime_error("the saved state is longer than it should be");
  clearWorkspace();
}

void World::Engine::clearWorkspace()
{
  cache_.assign(bodies.size(), Cached());
  member_of_.assign(bodies.size(), -1);
  body_mark_.assign(bodies.size(), 0);
  pair_mark_.assign(pairs_.size(), 0);
  mark_ = 0;
  detector_.configure(scene.tolerance, resolution_);
}

/// All states, forces in force, inputs to come and parameters that act on the motion; neither time nor what the run has cost.
std::uint64_t World::Engine::stateHash() const
{
  Hasher hasher(input_start_);
  Engine& self = const_cast<Engine&>(*this);  // a hasher changes nothing
  hasher(self.field_, self.scene.rotational_damping_ratio, self.scene.elasticity, self.scene.thrust, self.scene.tolerance,
         self.dissipative_, self.links_);
  for (Body& body : self.bodies)
  {
    MotionState state = body.stateAt(now);
    hasher(body.name, body.shape, body.fixed, body.mass, body.inertia, body.elasticity, body.thrusters, body.levels, body.thrust_until,
           body.wrench_force, body.wrench_torque, body.mouse);
    hasher(state.position, state.angle, state.velocity, state.omega);
  }
  for (std::size_t i = next_input_; i < scene.inputs.size(); ++i)
    hasher(self.scene.inputs[i]);
  return hasher.hash;
}

}  // namespace block_world
