#include <gtest/gtest.h>

#include "exact_cases.h"
#include "motion.h"

// Correct runs pass, and the checks that they are there for were really asked.

namespace exact
{
namespace
{
void expectPass(const Case& item, const std::vector<std::string>& asked)
{
  const checker::Report report = judge(item, build(item));
  EXPECT_TRUE(report.passed()) << failures(report);
  for (const std::string& name : asked)
  {
    ASSERT_NE(report.find(name), nullptr) << name;
    EXPECT_GT(report.find(name)->count(), 0) << name;
  }
}

TEST(Checker, PassesAnElasticDrop)
{
  expectPass(flatDrop(1.0),
             { "replay.linear_momentum", "impact.energy", "energy.conserved", "contact.normal", "overlap.impacts" });
}

TEST(Checker, PassesBouncesThatEndInSliding)
{
  expectPass(flatDrop(0.5),
             { "rest.position", "rest.velocity", "rest.normal_speed", "energy.impact_loss", "rest.announced" });
}

TEST(Checker, PassesASingleImpactOffBothCentres)
{
  for (const double e : { 0.0, 0.5, 1.0 })
    expectPass(offCentreHit(e),
               { "impact.restitution", "impact.impulse", "replay.angular_momentum", "momentum.angular" });
}

TEST(Checker, PassesAnImpactAfterTheElasticityWasSet)
{
  expectPass(cornerOnWall(0.5), { "impact.restitution", "energy.command_work" });
}

TEST(Checker, PassesABounceTooLowToTellFromRest)
{
  expectPass(slowHit(0.005), { "impact.restitution" });
}

TEST(Checker, PassesASmallPullWhereABounceIsCaptured)
{
  const Case item = flatDrop(0.5);
  expectPass(pullAndPush(item, item.rest_from, 0.012), { "contact.sign", "replay.linear_momentum" });
}

TEST(Checker, PassesAStartThatIsSqueezed)
{
  expectPass(squeezedAtTheStart(), { "start.state" });
}

// Turned a little beyond the tolerance it overlaps what squeezed it.
TEST(Checker, PassesAHitAfterASqueeze)
{
  const checker::Report report = judge(squeezedAndHit(), build(squeezedAndHit()));
  for (const char* name : { "impact.restitution", "impact.impulse", "impact.approach" })
  {
    EXPECT_EQ(report.find(name)->count(), 1) << name;
    EXPECT_EQ(report.find(name)->violations(), 0) << failures(report);
  }
}

TEST(Checker, PassesDampedFlight)
{
  expectPass(dampedFlight(), { "flight.position", "energy.damping_loss", "momentum.linear" });
}

TEST(Checker, PassesThrust)
{
  expectPass(thrust(), { "flight.velocity", "energy.thrust_work" });
}

TEST(Checker, PassesAMouseSpringBetweenSamples)
{
  expectPass(mouse(), { "flight.position", "energy.command_work" });
}

TEST(Checker, PassesBlocksTiedByASpring)
{
  expectPass(tiedPair(), { "flight.position", "energy.conserved", "momentum.linear" });
}

TEST(Checker, PassesARestingLoadThatShifts)
{
  expectPass(rockingLoad(), { "rest.position", "rest.velocity" });
}

TEST(Checker, PassesPowersThatChangeMuchBetweenSamples)
{
  expectPass(brakedSlider(), { "energy.damping_loss", "energy.thrust_work", "rest.velocity" });
}

TEST(Checker, PassesForcesWhoseDifferencesCancel)
{
  expectPass(cancellingDifferences(), { "rest.velocity", "rest.position" });
}

TEST(Checker, PassesAForceThatEndsWithAnEventBetweenSamples)
{
  expectPass(brakedIntoWall(), { "rest.bounded" });
}

// Against central differences of the powers along the motion: errors of 1e-6^2 of the third derivatives, and the rounding over 1e-6.
TEST(Checker, RatesOfPowers)
{
  const checker::Scene scene = checker::parseScene(
      "{damping: 0.3, thrusters: {strength: 2}, blocks: [{name: p, size: [1, 2], pose: [0, 0, 0]}, {name: q, size: [2, 1], mass: 3, "
      "pose: [3, 1, 0]}], springs: [{from: {block: p, point: [0.4, 0.3]}, to: {block: q, point: [-0.2, 0.5]}, stiffness: 2, "
      "rest_length: 1, damping: 0.7}, {from: {block: q, point: [0.1, 0.2]}, to: {point: [5, 4]}, stiffness: 3, rest_length: 0, "
      "damping: 0.4}], inputs: [{time: 0, thrust: {block: p, levels: [0.1, 0.2, 0.9, 0.4, 0, 0.7], duration: 9}}, {time: 0, wrench: "
      "{block: q, force: [0.6, -1.1], torque: 0.8}}, {time: 0, spring: {block: p, point: [0.1, -0.3], anchor: [1, -2], stiffness: 4, "
      "damping: 0.9}}]}");
  const checker::Timeline timeline(scene);
  const checker::Motion motion(scene);
  const checker::Drive& drive = timeline.at(0.0);
  const std::vector<State> states = { stateOf(0.1, -0.2, 0.4, 1.1, 0.7, -1.3), stateOf(3.2, 0.9, -0.6, -0.8, 1.4, 0.9) };
  const std::vector<checker::Load> total = { { Vec2(1.7, -0.9), 0.8 }, { Vec2(-2.3, 1.2), -1.9 } };
  const auto power = [&](double t) {
    std::vector<State> moved = states;
    for (int body = 0; body < 2; ++body)
    {
      const Vec2 a = total[body].force / drive.bodies[body].mass;
      const double alpha = total[body].torque / motion.inertia(drive, body);
      moved[body].position += t * (states[body].velocity + 0.5 * t * a);
      moved[body].angle += t * (states[body].omega + 0.5 * t * alpha);
      moved[body].velocity += t * a;
      moved[body].omega += t * alpha;
    }
    std::vector<checker::Load> loads(2);
    return motion.loads(0, drive, moved, loads);
  };
  const checker::Power rates = motion.powerRates(0, drive, states, total), from = power(-1e-6), to = power(1e-6);
  EXPECT_NEAR(rates.thrust, (to.thrust - from.thrust) / 2e-6, 1e-8);
  EXPECT_NEAR(rates.damping, (to.damping - from.damping) / 2e-6, 1e-8);
}

TEST(Checker, PassesALongerSampleInterval)
{
  const checker::Report report = judge(dampedFlight(), build(dampedFlight(), 0.05));
  EXPECT_TRUE(report.passed()) << failures(report);
}

TEST(Checker, ReadsTheSummary)
{
  const checker::Scene scene = checker::parseScene("{tolerance: 1.0e-6, blocks: []}");
  const auto passes = [&](const std::string& line) {
    checker::Report report;
    checker::checkSummary(line, scene, report);
    return report.passed();
  };
  EXPECT_TRUE(passes("note\nsummary: simulated_s=10 worst_overlap_m=9e-7 balance_error_J=1e-15 mode=exact\n"));
  EXPECT_FALSE(passes("summary: simulated_s=10 worst_overlap_m=2e-6 mode=exact\n"));
  EXPECT_FALSE(passes("summary: simulated_s=10 worst_overlap_m=0 mode=stepped island of block1\n"));
  EXPECT_FALSE(passes("summary: simulated_s=10 mode=exact\n"));
  EXPECT_THROW(passes("no such line"), std::runtime_error);
}

TEST(Checker, ReadsScenes)
{
  const checker::Scene scene = checker::parseScene("{count: 2, walls: {left: -6, top: 4}, blocks: [{name: p, vertices: "
                                                   "[[0, 0], [0, 1], [1, 0]], mass: 2, pose: [0, 0, 0]},"
                                                   " {name: q, size: [2, 1], pose: [3, 0, 0], fixed: true}, {name: r, "
                                                   "size: [2, 1], pose: [8, 0, 0]}],"
                                                   " springs: [{from: {block: p}, to: {block: r}}]}");
  ASSERT_EQ(scene.blocks.size(), 2u);
  EXPECT_TRUE(scene.springs.empty());
  EXPECT_NEAR(scene.blocks[0].shape.gyration, 1.0 / 9.0, 1e-15);
  EXPECT_NEAR(scene.blocks[0].shape.vertices[0].sum(), 1.0 / 3.0, 1e-15);
  EXPECT_DOUBLE_EQ(scene.walls[0].offset, -6);
  EXPECT_DOUBLE_EQ(scene.walls[1].offset, -4);
  EXPECT_EQ(scene.index.at("wall_top"), 3);
  EXPECT_NEAR((scene.blocks[1].thrusters[2].direction - Vec2(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((scene.blocks[1].thrusters[2].point - Vec2(0.6, 0)).norm(), 0, 1e-15);
  EXPECT_THROW(checker::parseScene("{blocks: [{name: a, pose: 3}]}"), std::runtime_error);
}

TEST(Checker, RefusesTornFiles)
{
  const Case item = cornerOnWall(0.5);
  const Texts good = write(build(item), checker::parseScene(item.scene));
  for (const size_t length : { size_t(0), size_t(20), good.states.size() - 30 })
  {
    Texts torn = good;
    torn.states.resize(length);
    EXPECT_THROW(judge(item.scene, torn), std::runtime_error) << length;
  }
  Texts words = good;
  words.energy.replace(words.energy.find('\n') + 1, 1, "x");
  EXPECT_THROW(judge(item.scene, words), std::runtime_error);
}

}  // namespace
}  // namespace exact
