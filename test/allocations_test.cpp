// A world that has been running for a while needs no more memory: whatever it works with it keeps. So that no pause, no
// fragmented heap and no slow growth comes of running for long.

#include <cstdlib>

#include "hard_cases/hard_cases.h"

namespace
{
bool counting = false;
std::int64_t counted = 0;

void count()
{
  if (counting)
    ++counted;
}
}  // namespace

// Every way to get memory, new and Eigen's included, ends in one of these of the C library.
extern "C"
{
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size)
{
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size)
{
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size)
{
  count();
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size)
{
  count();
  return __libc_memalign(alignment, size);
}
}

namespace block_world
{
namespace
{
/// Allocations while the world advances from `warm` to `end`, in steps between which it is read.
std::int64_t allocations(World& world, double warm, double end, int looks = 10)
{
  run(world, warm);
  world.takeContacts();
  std::int64_t during = 0;
  for (int i = 1; i <= looks; ++i)
  {
    const Time next = Time::fromSeconds(warm + (end - warm) * i / looks);
    counted = 0;
    counting = true;
    world.advance(next);
    counting = false;
    during += counted;
  }
  return during;
}

TEST(Allocations, AreCounted)
{
  counted = 0;
  counting = true;
  const std::vector<double> one(3);
  const Eigen::VectorXd another = Eigen::VectorXd::Zero(3);
  counting = false;
  EXPECT_EQ(counted, 2);
  EXPECT_EQ(one[0], another[0]);
}

/// Boxes at about 1 m/s in a closed room, of which they fill a fifth.
Scene makeGas(int side_by_side)
{
  Random random(9);
  const double cell = std::sqrt(0.5 * 0.3 / 0.2);
  std::vector<Block> blocks;
  for (int i = 0; i < side_by_side * side_by_side; ++i)
  {
    const Vector2d place(cell * (i % side_by_side + 0.5), cell * (i / side_by_side + 0.5));
    const Vector2d velocity = random.vector(1.0);
    blocks.push_back(moving(makeBox("b" + std::to_string(i), { 0.5, 0.3 }, place, random.in(-pi, pi)), velocity,
                            random.in(-1.0, 1.0)));
  }
  return makeScene(0.0, 1.0, blocks, Walls{ 0.0, cell * side_by_side, 0.0, cell * side_by_side });
}

TEST(Allocations, Gas)
{
  World world(makeGas(10));
  world.keepContacts(false);
  EXPECT_EQ(allocations(world, 20.0, 40.0), 0);
  EXPECT_GT(world.statistics().impacts, 5000);
}

TEST(Allocations, SixBlocks)
{
  Scene scene = shipped("six_blocks");
  scene.gravity = 9.8;
  scene.elasticity = 1.0;
  World world(scene);
  world.keepContacts(false);
  EXPECT_EQ(allocations(world, 10.0, 40.0), 0);
  EXPECT_GT(world.statistics().impacts, 200);
}

/// Boxes of 1 to 10 kg fall over one another into a bin, and again and again: how many touch at once, and in which islands, is at its
/// most late, so that the same heaps before are the warming up. It takes two, as an island's memory stays with its bodies.
TEST(Allocations, SettlingHeap)
{
  Random random(4);
  std::vector<Block> blocks;
  for (int i = 0; i < 12; ++i)
  {
    const Vector2d size(random.in(0.4, 1.0), random.in(0.4, 1.0)), place(1.5 * (i % 4) - 2.25, 1.0 + 1.5 * (i / 4));
    blocks.push_back(withMass(makeBox("b" + std::to_string(i), size, place, random.in(-pi, pi)), random.in(1.0, 10.0)));
  }
  World world(makeScene(9.8, 0.3, blocks, Walls{ -3.2, 3.2, 0.0, {} }));
  world.keepContacts(false);
  for (const double end : { 6.0, 12.0 })
  {
    run(world, end);
    ASSERT_TRUE(world.apply(ResetCommand()).ok);
  }
  const std::int64_t before = world.statistics().events;
  EXPECT_EQ(allocations(world, 12.0, 18.0), 0);
  EXPECT_GT(world.statistics().events, before + 1000);
  EXPECT_FALSE(world.restingContacts().empty());
}

TEST(Allocations, BlockOnASpring)
{
  World world(shipped("springs"));
  world.keepContacts(false);
  EXPECT_EQ(allocations(world, 5.0, 20.0), 0);
}

/// A row of boxes along the floor against a wall: a thruster drives the last one into it again and again.
TEST(Allocations, RowPushedByAThruster)
{
  std::vector<Block> blocks;
  for (int i = 0; i < 5; ++i)
    blocks.push_back(makeBox("b" + std::to_string(i), { 0.5, 0.5 }, { 0.25 + 0.6 * i, 0.25 }));
  Scene scene = makeScene(9.8, 1.0, blocks, Walls{ 0.0, {}, 0.0, {} });
  World world(scene);
  world.keepContacts(false);
  ThrustCommand thrust;
  thrust.body = "b4";
  thrust.levels = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0 };
  thrust.duration = 1e6;
  ASSERT_TRUE(world.apply({ thrust }).ok);
  EXPECT_EQ(allocations(world, 5.0, 20.0), 0);
  EXPECT_GT(world.statistics().impacts, 50);
}

TEST(Allocations, DigitsOfPi)
{
  World world(shipped("pi_collisions"));
  world.keepContacts(false);
  EXPECT_EQ(allocations(world, 2.0, 10.0), 0);
  EXPECT_EQ(world.statistics().impacts, 314);
}

// Contacts that are asked for: the copy is the caller's, the world's own memory stays.
TEST(Allocations, ContactsTaken)
{
  World world(makeGas(4));
  for (int i = 1; i <= 100; ++i)
  {
    run(world, 0.2 * i);
    world.takeContacts();
  }
  std::int64_t taken = 0, during = 0;
  for (int i = 101; i <= 200; ++i)
  {
    counted = 0;
    counting = true;
    run(world, 0.2 * i);
    counting = false;
    during += counted;
    taken += static_cast<std::int64_t>(world.takeContacts().size());
  }
  EXPECT_EQ(during, 0);
  EXPECT_GT(taken, 500);
}

}  // namespace
}  // namespace block_world
