#include "features.h"

#include <algorithm>
#include <array>
#include <ostream>

#include "harness.h"
#include "scenes.h"

namespace block_world::speed
{
namespace
{
constexpr int frames = 10 * frame_rate;

/// A scene without a feature, with the feature idle, and with the feature in use; and how often each is stopped a
/// frame.
struct Feature
{
  std::string name, idle, used;
  std::array<Scene, 3> scenes;
  std::array<int, 3> stops = { 1, 1, 1 };
};

/// One block in a box, without loss.
Scene tumbling()
{
  Scene scene;
  scene.walls = { -3.0, 3.0, -3.0, 3.0 };
  scene.blocks = { moving(box(1.0, 3.0, 0.2, -0.1, 0.4), 2.1, 1.3, 1.7) };
  return scene;
}

Feature damping()
{
  Feature feature{ "damping", "a ratio, but no damping", "0.02 N s/m", { tumbling(), tumbling(), tumbling() } };
  feature.scenes[1].rotational_damping_ratio = 0.5;
  feature.scenes[2].damping = 0.02;
  return feature;
}

/// One block that bounces upright, without loss.
Scene bouncing()
{
  Scene scene;
  scene.gravity = 9.8;
  scene.walls.bottom = 0.0;
  scene.blocks = { moving(box(0.5, 0.25, 0.0, 1.0), 0.5, 0.0) };
  return scene;
}

/// One that rests far away.
Block resting()
{
  Block block = box(1.0, 1.0, 50.0, 0.5);
  block.elasticity = 0.3;
  return block;
}

Feature spring()
{
  Feature feature{
    "spring", "slack, at a block that rests far away", "at the block", { bouncing(), bouncing(), bouncing() }
  };
  for (Scene& scene : feature.scenes)
    scene.blocks.push_back(resting());
  Spring spring;
  spring.from_block = "block2";
  spring.to_point = { 50.0, 2.5 };
  spring.stiffness = 5.0;
  spring.rest_length = 2.0;
  feature.scenes[1].springs = { spring };
  spring.from_block = "block1";
  spring.to_point = { 0.0, 2.5 };
  feature.scenes[2].springs = { spring };
  return feature;
}

Feature thruster()
{
  Feature feature{ "thruster", "commanded to level 0", "two at 2 % of 1.5 N", { tumbling(), tumbling(), tumbling() } };
  ThrustCommand thrust;
  thrust.body = "block1";
  thrust.duration = 100.0;
  thrust.levels = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  feature.scenes[1].inputs = { { Time(), thrust } };
  thrust.levels[3] = 0.02;
  thrust.levels[0] = 0.02;
  feature.scenes[2].inputs = { { Time(), thrust } };
  return feature;
}

Feature restingContact()
{
  Feature feature{ "resting contact",
                   "a block rests far away",
                   "the block slides instead of bouncing",
                   { bouncing(), bouncing(), bouncing() } };
  feature.scenes[1].blocks.push_back(resting());
  feature.scenes[2].blocks[0].position.y() = 0.125;
  return feature;
}

Feature sampling()
{
  Feature feature{ "sampling", "at 600 Hz", "at 6000 Hz", { tumbling(), tumbling(), tumbling() } };
  feature.stops = { 1, 10, 100 };
  return feature;
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The three take turns.
FeatureCost costOf(const Feature& feature, int repeats)
{
  const Engine engine = blockWorld();
  std::array<std::vector<double>, 3> costs;
  for (int repeat = 0; repeat <= repeats; ++repeat)
    for (int i = 0; i < 3; ++i)
    {
      Case of;
      of.frames = frames;
      of.scenes = { finished(feature.scenes[i], feature.name) };
      Setting setting = engine.settings.front();
      setting.steps = feature.stops[i];
      const double cost = seconds(of, engine, setting) * frame_rate / frames;
      if (repeat > 0)  // the first warms up
        costs[i].push_back(cost);
    }
  return { feature.name, feature.idle, feature.used, median(costs[0]), median(costs[1]), median(costs[2]) };
}

}  // namespace

std::vector<FeatureCost> featureCosts(int repeats)
{
  std::vector<FeatureCost> costs;
  for (const Feature& feature : { damping(), spring(), thruster(), restingContact(), sampling() })
    costs.push_back(costOf(feature, repeats));
  return costs;
}

void writeFeatures(const std::vector<FeatureCost>& costs, std::ostream& out)
{
  const auto micros = [](double seconds) { return 1e6 * seconds; };
  out.precision(3);
  out << "| feature | without, µs | there but idle, µs | | in use, µs | |\n|---|---|---|---|---|---|\n";
  for (const FeatureCost& cost : costs)
    out << "| " << cost.name << " | " << micros(cost.without_cost) << " | " << micros(cost.idle_cost) << " | "
        << cost.idle << " | " << micros(cost.used_cost) << " | " << cost.used << " |\n";
}

}  // namespace block_world::speed
