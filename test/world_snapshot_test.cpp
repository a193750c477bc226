// A world saved and restored goes on bit for bit; and its hash tells of everything that acts on the motion.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include <unistd.h>

#include "world_testing.h"

namespace block_world
{
namespace
{
const std::vector<std::string> all_shipped{ "contact_forces", "cradle",      "drop",       "ladder",
                                            "pi_collisions",  "pile",        "six_blocks", "springs",
                                            "stack",          "table_slide", "thrusters" };

/// Everything at once: gravity, damping, a damped spring between blocks and one to the world, thrust that is still on,
/// a wrench, a mouse spring that ends, timed inputs to come.
World makeBusy()
{
  Scene scene = loadSceneFile(std::string(BLOCK_WORLD_DIR) + "/config/scenes/six_blocks.yaml", { 6, {} });
  scene.gravity = 9.8;
  scene.elasticity = 0.5;
  scene.damping = 0.05;
  Spring spring;
  spring.from_block = "block1";
  spring.to_block = "block4";
  spring.stiffness = 2.0;
  spring.rest_length = 1.0;
  spring.damping = 0.1;
  Spring hook = spring;
  hook.from_block = "block5";
  hook.to_block.clear();
  hook.to_point = Vector2d(1.0, 8.0);
  scene.springs = { spring, hook };
  scene.inputs = { { Time::fromSeconds(3.3), ThrustCommand{ "block3", { 0, 0, 1, 0, 0, 0 }, 1.1 } },
                   { Time::fromSeconds(4.1), SetCommand{ 5.0, {}, 0.1, {}, {} } } };
  World world(scene);
  world.advance(Time::fromNanoseconds(1234567891));
  SpringCommand pull;
  pull.body = "block2";
  pull.attach = Vector2d(0.2, 1.0);
  pull.anchor = Vector2d(0.0, 3.0);
  pull.stiffness = 30.0;
  pull.damping = 0.3;
  pull.duration = 2.5;
  EXPECT_TRUE(world.apply(pull).ok);
  EXPECT_TRUE(world.apply(ThrustCommand{ "block1", { 0, 0.5, 0, 1, 0, 0 }, 2.0 }).ok);
  EXPECT_TRUE(world.apply(WrenchCommand{ "block6", Vector2d(0.3, 0.1), 0.2 }).ok);
  EXPECT_TRUE(world.apply(SetCommand{ {}, {}, {}, {}, 1.5 }).ok);
  const Applied spawned = world.apply(SpawnCommand{ makeBox("extra", Vector2d(0.3, 0.3), Vector2d(0.0, 5.6)) });
  EXPECT_TRUE(spawned.ok) << spawned.reason;
  return world;
}

std::vector<std::function<World()>> makeWorlds()
{
  std::vector<std::function<World()>> makers{ makeBusy };
  for (const std::string& name : all_shipped)
    makers.push_back([name] { return World(shipped(name)); });
  return makers;
}

void expectSame(const std::vector<ContactEvent>& one, const std::vector<ContactEvent>& two, const std::string& where)
{
  ASSERT_EQ(one.size(), two.size()) << where;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].time, two[i].time) << where;
    EXPECT_EQ(one[i].kind, two[i].kind) << where;
    EXPECT_EQ(one[i].a, two[i].a) << where;
    EXPECT_EQ(one[i].b, two[i].b) << where;
    EXPECT_EQ(one[i].point, two[i].point) << where;
    EXPECT_EQ(one[i].impulse, two[i].impulse) << where;
  }
}

void writeFile(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string readFile(const std::string& path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string refusal(const std::string& bytes)
{
  try
  {
    World::restore(bytes);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return std::string();
}

// In the middle of flights, slides, bounces, rests and heaps; the whole saved state at the end is compared, not the
// hash alone.
TEST(Snapshot, GoesOnBitForBit)
{
  for (const auto& make : makeWorlds())
  {
    World whole = make();
    for (int k = 1; k <= 12; ++k)
    {
      const std::string where = whole.scene().name + ", part " + std::to_string(k);
      World restored = World::restore(whole.save());
      EXPECT_EQ(restored.stateHash(), whole.stateHash()) << where;
      EXPECT_EQ(restored.save(), whole.save()) << where;
      whole.takeContacts();
      whole.takeInputs();
      const Time next = whole.now() + 0.437;
      whole.advance(next);
      restored.advance(next);
      EXPECT_EQ(restored.save(), whole.save()) << where;
      EXPECT_EQ(restored.energy().balance_error, whole.energy().balance_error) << where;
      EXPECT_EQ(restored.takeInputs().size(), whole.takeInputs().size()) << where;
      expectSame(restored.takeContacts(), whole.takeContacts(), where);
    }
  }
}

TEST(Snapshot, TakesCommandsLikeTheOriginal)
{
  World original = makeBusy();
  World restored = World::restore(original.save());
  for (World* world : { &original, &restored })
  {
    EXPECT_TRUE(world->apply(DeleteCommand{ "extra" }).ok);
    world->advance(world->now() + 1.0);
    EXPECT_TRUE(world->apply(ResetCommand()).ok);
    world->advance(world->now() + 5.0);
  }
  EXPECT_EQ(restored.save(), original.save());
}

// 10 s are 5 s, saved, and 5 s more in another process: this very program, run again for the test below.
TEST(Snapshot, InANewProcess)
{
  const std::string path = testing::TempDir() + "block_world_snapshot_" + std::to_string(getpid());
  for (const auto& make : makeWorlds())
  {
    World world = make();
    world.advance(Time::fromSeconds(5.0));
    writeFile(path, world.save());
    const std::string command = "BLOCK_WORLD_STATE=" + path + " /proc/" + std::to_string(getpid()) +
                                "/exe --gtest_filter=Snapshot.TheNewProcess >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    world.advance(Time::fromSeconds(10.0));
    EXPECT_EQ(readFile(path + ".end"), world.save()) << world.scene().name;
  }
  std::remove(path.c_str());
  std::remove((path + ".end").c_str());
}

TEST(Snapshot, TheNewProcess)
{
  const char* const path = std::getenv("BLOCK_WORLD_STATE");
  if (path == nullptr)
    return;
  World world = World::restore(readFile(path));
  world.advance(Time::fromSeconds(10.0));
  writeFile(std::string(path) + ".end", world.save());
}

// Whole seconds later or earlier changes no bit of the motion.
TEST(Snapshot, LaterByWholeSeconds)
{
  for (const auto& make : makeWorlds())
  {
    World world = make();
    world.advance(world.now() + 1.3);
    for (const std::int64_t shift : { -1000000, 3, 1000000000 })
    {
      World here = World::restore(world.save());
      World later = World::restore(world.save(), shift);
      EXPECT_EQ(later.now() - here.now(), static_cast<double>(shift));
      here.advance(here.now() + 4.0);
      later.advance(later.now() + 4.0);
      EXPECT_EQ(later.stateHash(), here.stateHash()) << world.scene().name;
      EXPECT_EQ(later.statistics().events, here.statistics().events) << world.scene().name;
    }
  }
}

TEST(Snapshot, RefusesWhatIsDamagedOrForeign)
{
  const Scene scene = makeScene(9.8, 0.5, { makeBox("box", Vector2d(1.0, 1.0), Vector2d::Zero()) });
  const std::string good = World(scene).save();
  ASSERT_EQ(refusal(good), "");
  for (std::size_t size = 0; size < good.size(); ++size)
    ASSERT_NE(refusal(good.substr(0, size)), "") << "cut at " << size;
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const int bit : { 0, 7 })
    {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ (1 << bit));
      ASSERT_NE(refusal(bad), "") << "byte " << i;
    }
  EXPECT_NE(refusal(good + "x"), "");
  EXPECT_EQ(refusal("name: a scene\n"), "not a saved state of block_world");
}

/// A world in which everything acts.
struct Acting
{
  Scene scene;
  ThrustCommand thrust{ "b", { 0.5 }, 1.0 };
  WrenchCommand wrench{ "a", Vector2d(1.0, 2.0), 3.0 };
  SpringCommand mouse{ true, "b", Vector2d(0.1, 0.2), Vector2d(1.0, 6.0), 3.0, 0.1, 2.0 };

  Acting()
  {
    scene = makeScene(9.8, 0.5,
                      { moving(makeBox("a", Vector2d(1.0, 2.0), Vector2d(-2.0, 5.0), 0.1), Vector2d(0.1, 0.2), 0.3),
                        moving(makeBox("b", Vector2d(1.0, 2.0), Vector2d(2.0, 5.0), 0.1), Vector2d(0.1, 0.2), 0.3) },
                      { -5.0, 5.0, 0.0, 10.0 });
    scene.damping = 0.25;
    scene.blocks[1].elasticity = 0.5;
    scene.blocks[1].thrusters = { Thruster{ Vector2d(0.1, 0.2), Vector2d(0.0, 1.0), 2.0 } };
    scene.springs = { Spring{ "a", Vector2d::Zero(), "b", Vector2d::Zero(), 1.0, 1.0, 0.1 } };
    scene.inputs = { { Time::fromNanoseconds(1000000000), WrenchCommand{ "b", Vector2d(1.0, 2.0), 3.0 } } };
  }

  std::uint64_t hash() const
  {
    World world(scene);
    EXPECT_TRUE(world.apply(thrust).ok);
    EXPECT_TRUE(world.apply(wrench).ok);
    EXPECT_TRUE(world.apply(mouse).ok);
    return world.stateHash();
  }
};

// Each state, each parameter and each force in force, moved by the least amount, gives a hash of its own.
TEST(Hash, TellsOfEveryBit)
{
  double& (*const parts[])(Acting&) = {
    [](Acting& p) -> double& { return p.scene.gravity; },
    [](Acting& p) -> double& { return p.scene.elasticity; },
    [](Acting& p) -> double& { return p.scene.damping; },
    [](Acting& p) -> double& { return p.scene.rotational_damping_ratio; },
    [](Acting& p) -> double& { return p.scene.tolerance; },
    [](Acting& p) -> double& { return p.scene.thrust; },
    [](Acting& p) -> double& { return *p.scene.walls.left; },
    [](Acting& p) -> double& { return *p.scene.walls.right; },
    [](Acting& p) -> double& { return *p.scene.walls.bottom; },
    [](Acting& p) -> double& { return *p.scene.walls.top; },
    [](Acting& p) -> double& { return p.scene.blocks[0].position.x(); },
    [](Acting& p) -> double& { return p.scene.blocks[1].position.y(); },
    [](Acting& p) -> double& { return p.scene.blocks[0].angle; },
    [](Acting& p) -> double& { return p.scene.blocks[0].velocity.x(); },
    [](Acting& p) -> double& { return p.scene.blocks[1].velocity.y(); },
    [](Acting& p) -> double& { return p.scene.blocks[1].omega; },
    [](Acting& p) -> double& { return p.scene.blocks[0].mass; },
    [](Acting& p) -> double& { return *p.scene.blocks[1].elasticity; },
    [](Acting& p) -> double& { return p.scene.blocks[0].size->y(); },
    [](Acting& p) -> double& { return (*p.scene.blocks[1].thrusters)[0].point.x(); },
    [](Acting& p) -> double& { return (*p.scene.blocks[1].thrusters)[0].strength; },
    [](Acting& p) -> double& { return p.scene.springs[0].rest_length; },
    [](Acting& p) -> double& { return p.scene.springs[0].damping; },
    [](Acting& p) -> double& { return p.scene.springs[0].from_point.x(); },
    [](Acting& p) -> double& { return p.scene.springs[0].to_point.y(); },
    [](Acting& p) -> double& { return std::get<WrenchCommand>(p.scene.inputs[0].command).torque; },
    [](Acting& p) -> double& { return p.thrust.levels[0]; },
    [](Acting& p) -> double& { return p.thrust.duration; },
    [](Acting& p) -> double& { return p.wrench.force.x(); },
    [](Acting& p) -> double& { return p.wrench.force.y(); },
    [](Acting& p) -> double& { return p.wrench.torque; },
    [](Acting& p) -> double& { return p.mouse.attach.x(); },
    [](Acting& p) -> double& { return p.mouse.attach.y(); },
    [](Acting& p) -> double& { return p.mouse.anchor.x(); },
    [](Acting& p) -> double& { return p.mouse.anchor.y(); },
    [](Acting& p) -> double& { return p.mouse.stiffness; },
    [](Acting& p) -> double& { return p.mouse.damping; },
    [](Acting& p) -> double& { return p.mouse.duration; },
    [](Acting& p) -> double& { return p.scene.springs[0].stiffness; },
  };
  std::set<std::uint64_t> hashes{ Acting().hash() };
  EXPECT_FALSE(hashes.insert(Acting().hash()).second);
  int number = 0;
  for (const auto& part : parts)
  {
    Acting acting;
    part(acting) = std::nextafter(part(acting), HUGE_VAL);
    EXPECT_TRUE(hashes.insert(acting.hash()).second) << "part " << number << " does not show";
    ++number;
  }
  Acting later;
  later.scene.inputs[0].time = Time::fromNanoseconds(1000000001);
  EXPECT_TRUE(hashes.insert(later.hash()).second);
}

}  // namespace
}  // namespace block_world
