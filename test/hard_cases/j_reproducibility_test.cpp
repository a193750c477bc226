// J. The same run, bit for bit: whoever looks, in however many steps, whenever it begins; and the mirror's image of it.

#include <algorithm>
#include <map>

#include "simultaneous_scenes.h"

namespace block_world
{
namespace
{
/// Six blocks with gravity, a spring, damping and inputs: free flight, bounces, sliding and rest.
Scene makeBusy()
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
  scene.springs = { spring };
  SpringCommand pull;
  pull.body = "block2";
  pull.attach = Vector2d(0.2, 1.0);
  pull.anchor = Vector2d(0.0, 3.0);
  pull.stiffness = 30.0;
  pull.duration = 2.0;
  scene.inputs = { { Time::fromSeconds(0.7), ThrustCommand{ "block3", { 0, 0, 1, 0, 0, 0 }, 1.1 } },
                   { Time::fromSeconds(1.3), pull } };
  return scene;
}

const std::vector<std::string> all_shipped{ "contact_forces", "cradle",      "drop",       "ladder",
                                            "pi_collisions",  "pile",        "six_blocks", "springs",
                                            "stack",          "table_slide", "thrusters" };

std::vector<Scene> makeScenes()
{
  std::vector<Scene> scenes{ makeBusy() };
  for (const std::string& name : all_shipped)
    scenes.push_back(shipped(name));
  return scenes;
}

// J1: twice.
TEST(SameBits, Twice)
{
  for (const Scene& scene : makeScenes())
  {
    World one(scene), two(scene);
    for (const double t : { 1.0, 2.5, 5.0 })
    {
      run(one, t);
      run(two, t);
      EXPECT_EQ(one.stateHash(), two.stateHash()) << scene.name;
      EXPECT_EQ(one.energy().total, two.energy().total) << scene.name;
    }
    EXPECT_EQ(one.statistics().events, two.statistics().events) << scene.name;
  }
}

// J1: looked at a thousand times a second or not at all.
TEST(SameBits, WhoeverLooks)
{
  for (const Scene& scene : makeScenes())
  {
    World unseen(scene), seen(scene);
    for (int i = 1; i <= 4000; ++i)
    {
      seen.advance(Time::fromNanoseconds(1000000ll * i));
      seen.energy();
      seen.overlap();
      seen.restingContacts();
      seen.takeContacts();
      seen.springs();
    }
    run(unseen, 4.0);
    EXPECT_EQ(unseen.stateHash(), seen.stateHash()) << scene.name;
    EXPECT_EQ(unseen.statistics().events, seen.statistics().events) << scene.name;
    // Looking sums up the work so far anew each time, in whatever parts the arcs have.
    EXPECT_NEAR(unseen.energy().balance_error, seen.energy().balance_error, 1e-12) << scene.name;
  }
}

TEST(SameBits, InFewEventsAtATime)
{
  for (const Scene& scene : makeScenes())
  {
    World whole(scene), parts(scene);
    const Time end = Time::fromSeconds(4.0);
    whole.advance(end);
    bool early = false;
    while (parts.advance(end, 7) < end)
    {
      early = true;
      ASSERT_LT(parts.now(), end);
    }
    EXPECT_EQ(early, whole.statistics().events > 7) << scene.name;
    EXPECT_EQ(whole.stateHash(), parts.stateHash()) << scene.name;
    EXPECT_EQ(whole.statistics().events, parts.statistics().events) << scene.name;
  }
}

TEST(SameBits, NoEventsAllowed)
{
  World world(makeBusy());
  const std::uint64_t hash = world.stateHash();
  EXPECT_LT(world.advance(Time::fromSeconds(5.0), 0), Time::fromSeconds(5.0));
  EXPECT_EQ(world.statistics().events, 0);
  EXPECT_EQ(world.stateHash(), hash);
}

// J4: reset a million seconds later; whole seconds are kept apart from their fraction, so the bits are the same.
TEST(SameBits, WheneverItBegins)
{
  for (const Scene& scene : makeScenes())
  {
    World fresh(scene), old(scene);
    for (const Block& block : scene.blocks)  // an empty world ages fast
      old.apply(DeleteCommand{ block.name });
    run(old, 1e6);
    ASSERT_TRUE(old.apply(ResetCommand()).ok);
    run(fresh, 4.0);
    run(old, 1e6 + 4.0);
    ASSERT_EQ(old.bodyCount(), fresh.bodyCount());
    for (int i = 0; i < fresh.bodyCount(); ++i)
      expectState(old.state(i), fresh.state(i), 0.0);
  }
}

TEST(SameBits, WheneverItIsLoaded)
{
  for (const Scene& scene : makeScenes())
  {
    World early(scene), late(scene, Time::fromSeconds(1e6));
    EXPECT_EQ(late.now(), Time::fromSeconds(1e6));
    run(early, 4.0);
    run(late, 1e6 + 4.0);
    EXPECT_EQ(late.stateHash(), early.stateHash()) << scene.name;
    EXPECT_EQ(late.takeInputs().size(), early.takeInputs().size()) << scene.name;
    EXPECT_EQ(late.energy().balance_error, early.energy().balance_error) << scene.name;
  }
}

/// Runs a scene and its image in a mirror; at a time short of any amplification the images must agree.
void expectMirrored(const Scene& scene, double seconds, double error)
{
  World world(scene), image(mirrored(scene));
  run(world, seconds);
  run(image, seconds);
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    MotionState wanted = world.state(i);
    wanted.position.x() *= -1.0;
    wanted.angle *= -1.0;
    wanted.velocity.x() *= -1.0;
    wanted.omega *= -1.0;
    expectState(image.state(i), wanted, error);
  }
  EXPECT_EQ(world.statistics().impacts, image.statistics().impacts) << scene.name;
}

// J3: nothing prefers left or right, nor the block listed first. All of section B.
TEST(Mirror, Impacts)
{
  for (const Collision& collision : makeCollisions())
  {
    SCOPED_TRACE(collision.what);
    expectMirrored(collision.scene, collision.seconds, 1e-14);
  }
}

// J3: amplified by what follows the first contact, at most by the factors of sections A and D.
TEST(Mirror, BouncesAndSliding)
{
  expectMirrored(makeScene(9.8, 0.8, { moving(makeBox("a", { 0.5, 0.3 }, { 0, 1 }, 0.2), { 0.25, 0 }) }, onFloor()),
                 1.0, 20.0 * 8.0 * 1.1e-16);
  expectMirrored(shipped("ladder"), 0.6, 1e-14);
  expectMirrored(shipped("table_slide"), 1.5, 26.0 * 8.0 * 1.1e-16);
  expectMirrored(shipped("drop"), 3.0, 1.1e-16);
}

/// The world's bodies in the order of the blocks of `scene`, whatever the order in which it lists them.
void expectSameStates(World& found, World& wanted, double error)
{
  for (int i = 0; i < wanted.bodyCount(); ++i)
  {
    SCOPED_TRACE(wanted.name(i));
    expectState(found.state(found.find(wanted.name(i))), wanted.state(i), error);
  }
}

/// How many contacts of each kind there were.
std::map<ContactKind, int> countContacts(World& world)
{
  std::map<ContactKind, int> count;
  for (const ContactEvent& contact : world.takeContacts())
    ++count[contact.kind];
  return count;
}

/// Runs a scene as it is and with its blocks listed backwards; up to a time short of any amplification they must agree,
/// event by event.
void expectOrderDoesNotMatter(Scene scene, double seconds, double error)
{
  World world(scene);
  std::reverse(scene.blocks.begin(), scene.blocks.end());
  World reversed(scene);
  run(world, seconds);
  run(reversed, seconds);
  EXPECT_EQ(world.statistics().impacts, reversed.statistics().impacts);
  EXPECT_EQ(countContacts(world), countContacts(reversed));
  expectSameStates(reversed, world, error);
}

// J2: sums of impulses and forces are taken in another order, so states differ by roundings.
TEST(Order, OfTheBlocksThatCollide)
{
  for (const Collision& collision : makeCollisions())
  {
    SCOPED_TRACE(collision.what);
    expectOrderDoesNotMatter(collision.scene, collision.seconds, 1e-13);
  }
}

// Off the table, speeds are by now amplified a hundredfold.
TEST(Order, OfTheBlocksThatRestAndSlide)
{
  expectOrderDoesNotMatter(shipped("stack"), 2.0, 0.0);
  expectOrderDoesNotMatter(shipped("table_slide"), 1.0, 1e-13);
  expectOrderDoesNotMatter(shipped("thrusters"), 5.0, 1e-14);
}

// Five seconds of flights and some ten impacts, each of which turns errors into ten times as much at the corners.
TEST(Order, OfTheBlocksThatTumble)
{
  expectOrderDoesNotMatter(shipped("six_blocks"), 5.0, 1e-11);
}

}  // namespace
}  // namespace block_world
