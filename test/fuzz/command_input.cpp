#include <cmath>

#include "bytes.h"
#include "fuzz.h"

namespace block_world
{
namespace fuzz
{
namespace
{
constexpr int kMostSteps = 24;
constexpr std::int64_t kMostEvents = 200;

const double kSizes[] = { 1.0, 0.5, 2.0, 0.25, 3.0 }, kMasses[] = { 1.0, 0.1, 10.0, 100.0 },
             kElasticities[] = { 1.0, 0.5, 0.0, 0.9, 0.25 }, kStiffnesses[] = { 1.0, 0.0, 10.0, 100.0, 1000.0 },
             kDampings[] = { 0.0, 0.1, 1.0, 10.0 }, kSpans[] = { 0.0, 0.125, 0.5, 1.0, 1.0 / 3.0 },
             kGravities[] = { 9.8, 0.0, 1.0, 20.0 }, kAngles[] = { 0.0, M_PI / 4.0, M_PI / 2.0, 0.3, 1e-9, -0.01 };

std::string nameOf(int index)
{
  return "b" + std::to_string(index);
}

Eigen::Vector2d vector(Bytes& bytes)
{
  const double x = bytes.coordinate();
  return Eigen::Vector2d(x, bytes.coordinate());
}

Block readBlock(Bytes& bytes, int index)
{
  Block block;
  block.name = nameOf(index);
  const std::uint8_t kind = bytes.byte();
  const double width = bytes.of(kSizes), height = bytes.of(kSizes);
  if (kind % 4 == 0)
    block.vertices = { { 0.0, 0.0 }, { width, 0.0 }, { width / 4.0, height } };
  else
    block.size = Eigen::Vector2d(width, height);
  block.fixed = kind % 8 == 7;
  block.position = vector(bytes);
  block.angle = bytes.of(kAngles);
  if (kind & 16)
    block.mass = bytes.of(kMasses);
  if (kind & 32)
    block.elasticity = bytes.of(kElasticities);
  if (kind & 64 && !block.fixed)
  {
    block.velocity = vector(bytes);
    block.omega = bytes.coordinate();
  }
  return block;
}

Scene readScene(Bytes& bytes)
{
  Scene scene;
  const std::uint8_t kind = bytes.byte();
  scene.gravity = bytes.of(kGravities);
  scene.elasticity = bytes.of(kElasticities);
  if (kind & 1)
    scene.damping = bytes.of(kDampings);
  if (kind & 2)
    scene.tolerance = 1e-9;
  if (!(kind & 4))
    scene.walls.bottom = -8.0;
  if (kind & 8)
    scene.walls = Walls{ -8.0, 8.0, -8.0, 8.0 };
  const int count = bytes.below(6);
  // A block that does not fit among the ones before it is left out, else most inputs would end here.
  for (int i = 0; i < count; ++i)
  {
    Scene with = scene;
    with.blocks.push_back(readBlock(bytes, i));
    try
    {
      completeScene(with);
      scene = with;
    }
    catch (const SceneError&)
    {
    }
  }
  if (scene.blocks.size() >= 2 && kind & 16)
  {
    Spring spring;
    spring.from_block = scene.blocks[0].name;
    if (kind & 32)
      spring.to_block = scene.blocks[1].name;
    spring.to_point = kind & 32 ? Eigen::Vector2d(0.125, 0.0) : vector(bytes);
    spring.stiffness = bytes.of(kStiffnesses);
    spring.rest_length = bytes.of(kSpans);
    spring.damping = bytes.of(kDampings);
    scene.springs.push_back(spring);
  }
  return scene;
}

std::string anyName(Bytes& bytes)
{
  return nameOf(bytes.below(8));  // some of them do not exist
}

Command readCommand(Bytes& bytes)
{
  switch (bytes.below(8))
  {
    case 0: {
      ThrustCommand thrust;
      thrust.body = anyName(bytes);
      const int bits = bytes.byte();
      for (int i = 0; i < (bits == 255 ? 5 : 6); ++i)
        thrust.levels.push_back(bits >> i & 1 ? 1.0 : 0.0);
      thrust.duration = bits & 64 ? bytes.risky() : bytes.of(kSpans);
      return thrust;
    }
    case 1: {
      SpringCommand spring;
      const int kind = bytes.byte();
      spring.active = kind % 4 != 3;
      spring.body = kind & 4 ? anyName(bytes) : std::string();
      spring.attach = Eigen::Vector2d(kind & 8 ? 0.125 : 0.0, kind & 16 ? -0.25 : 0.0);
      spring.anchor.x() = bytes.risky();
      spring.anchor.y() = bytes.risky();
      spring.stiffness = bytes.of(kStiffnesses);
      spring.damping = bytes.of(kDampings);
      spring.duration = bytes.of(kSpans);
      return spring;
    }
    case 2: {
      WrenchCommand wrench;
      wrench.body = anyName(bytes);
      wrench.force.x() = bytes.risky();
      wrench.force.y() = bytes.risky();
      wrench.torque = bytes.risky();
      return wrench;
    }
    case 3: {
      SetCommand set;
      const int which = bytes.byte();
      if (which & 1)
        set.gravity = bytes.risky();
      if (which & 2)
        set.elasticity = which & 4 ? bytes.risky() : bytes.of(kElasticities);
      if (which & 8)
        set.damping = which & 4 ? bytes.risky() : bytes.of(kDampings);
      if (which & 16)
        set.thrust = bytes.risky();
      if (which & 32)
        set.mass = which & 4 ? bytes.risky() : bytes.of(kMasses);
      return set;
    }
    case 4: {
      SetStateCommand state;
      state.body = anyName(bytes);
      state.position.x() = bytes.risky();
      state.position.y() = bytes.risky();
      state.angle = bytes.of(kAngles);
      state.velocity = vector(bytes);
      state.omega = bytes.risky();
      return state;
    }
    case 5: {
      SpawnCommand spawn;
      spawn.block = readBlock(bytes, bytes.below(8));
      return spawn;
    }
    case 6:
      return DeleteCommand{ anyName(bytes) };
    default:
      return ResetCommand{};
  }
}

/// Applies a command that was checked before; what the world answers and does must fit together.
std::string applyOne(World& world, const Command& command)
{
  const std::uint64_t hash = world.stateHash();
  const EnergyAccount before = world.energy();
  const Applied promised = world.check(command);
  if (world.stateHash() != hash || world.energy().total != before.total)
    return "check() changes the world";
  const Applied applied = world.apply(command);
  if (applied.ok != promised.ok || applied.reason != promised.reason)
    return "check() says '" + promised.reason + "', apply() '" + applied.reason + "'";
  if (applied.ok != applied.reason.empty())
    return "a reason without a refusal, or the other way round: '" + applied.reason + "'";
  if (!applied.ok && (world.stateHash() != hash || world.energy().total != before.total))
    return "refused, '" + applied.reason + "', but the world is another one";
  return std::string();
}
}  // namespace

std::string runCommands(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  World world(readScene(bytes));
  Invariants invariants;
  std::string wrong = invariants.check(world);
  for (int step = 0; wrong.empty() && !bytes.empty() && step < kMostSteps; ++step)
  {
    if (bytes.one())
    {
      const Time target = world.now() + bytes.of(kSpans);
      const Time reached = world.advance(target, kMostEvents);
      if (reached > target || reached != world.now())
        return "advance() went too far";
    }
    else
    {
      const Command command = readCommand(bytes);
      wrong = applyOne(world, command);
      if (std::holds_alternative<SetStateCommand>(command) || std::holds_alternative<SpawnCommand>(command) ||
          std::holds_alternative<ResetCommand>(command))
        invariants.place();
    }
    if (wrong.empty())
      wrong = invariants.check(world);
  }
  return wrong;
}

}  // namespace fuzz
}  // namespace block_world
