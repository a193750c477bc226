// CPU cost and error of block_world next to Box2D and Chipmunk, at the 1/60 s that all three are used with.
//
// benchmark_peers [--repeats N] [--check]      --check: exit 1 where a target of ours is missed

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "block_world/scene_yaml.h"
#include "peers.h"
#include "reference.h"

namespace
{
using block_world::Scene;
using Bodies = std::vector<reference::Body>;

constexpr int cost_duration = 10;       // s, simulated
constexpr double error_target = 1e-10;  // m
constexpr double reference_trust = 1e-13;

const std::filesystem::path here = std::filesystem::path(__FILE__).parent_path();

struct Case
{
  std::string name;
  Scene scene;
  std::vector<int> error_times;  // whole s; beyond these the scene amplifies rounding
  double speed_target;           // times cheaper than the cheaper peer
  std::function<Bodies(const Scene&, int)> reference;
};

/// Two scan steps must find the same motion, else an impact was missed.
Bodies trustedCollisions(const Scene& scene, int time)
{
  Bodies bodies = reference::collisions(scene, time, 1.0L / 1000);
  const Bodies other = reference::collisions(scene, time, 1.0L / 1700);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if ((bodies[i].position - other[i].position).norm() > reference_trust)
      throw std::runtime_error(scene.name + ": the reference depends on its scan step");
  return bodies;
}

/// The shipped scene, all of its six blocks, without loss or gravity.
Scene sixBlocks()
{
  block_world::SceneOverrides all;
  all.count = 6;
  Scene scene = block_world::loadSceneFile(here / "../../config/scenes/six_blocks.yaml", all);
  scene.gravity = scene.damping = 0.0;
  scene.elasticity = 1.0;
  return scene;
}

std::vector<Case> cases()
{
  return {
    { "flight", block_world::loadSceneFile(here / "flight.yaml"), { 2, 10 }, 2.0, reference::flight },
    { "tumble", block_world::loadSceneFile(here / "tumble.yaml"), { 2, 5 }, 4.0, trustedCollisions },
    { "six blocks", sixBlocks(), { 1, 2 }, 1.3, trustedCollisions },
  };
}

double processSeconds()
{
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU microseconds per simulated second, from the built scene to the last state, every state read at 60 Hz.
double cost(const peers::Engine& engine, const Scene& scene)
{
  const std::unique_ptr<peers::Simulation> simulation = engine.build(scene);
  const int blocks = static_cast<int>(scene.blocks.size());
  double read = 0.0;  // keeps the reads from being optimised away
  const double begin = processSeconds();
  for (int frame = 0; frame < cost_duration * peers::frame_rate; ++frame)
  {
    simulation->nextFrame();
    for (int block = 0; block < blocks; ++block)
      read += simulation->state(block).position.x();
  }
  const double end = processSeconds();
  if (!std::isfinite(read))
    throw std::runtime_error(engine.name + ": not finite");
  return 1e6 * (end - begin) / cost_duration;
}

/// Largest distance of a corner from where it belongs, in m.
double cornerError(const peers::Simulation& simulation, const Bodies& expected)
{
  double error = 0.0;
  for (std::size_t block = 0; block < expected.size(); ++block)
  {
    const block_world::MotionState state = simulation.state(static_cast<int>(block));
    reference::Body body = expected[block];
    body.position = state.position.cast<reference::Real>();
    body.angle = state.angle;
    for (int i = 0; i < 4; ++i)
    {
      const reference::Vector away = reference::corner(body, i) - reference::corner(expected[block], i);
      error = std::max(error, static_cast<double>(away.norm()));
    }
  }
  return error;
}

std::vector<double> errors(const peers::Engine& engine, const Case& test, const std::vector<Bodies>& expected)
{
  const std::unique_ptr<peers::Simulation> simulation = engine.build(test.scene);
  std::vector<double> result;
  int frame = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (; frame < test.error_times[i] * peers::frame_rate; ++frame)
      simulation->nextFrame();
    result.push_back(cornerError(*simulation, expected[i]));
  }
  return result;
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Runs the engines in turn, so that a busy moment of the machine meets all of them.
std::vector<double> medianCosts(const std::vector<peers::Engine>& engines, const Scene& scene, int repeats)
{
  std::vector<std::vector<double>> costs(engines.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < engines.size(); ++i)
      costs[i].push_back(cost(engines[i], scene));
  std::vector<double> medians;
  for (const std::vector<double>& each : costs)
    medians.push_back(median(each));
  return medians;
}

/// Prints one scene's rows; engines[0] is ours. True where our targets are met.
bool run(const Case& test, const std::vector<peers::Engine>& engines, int repeats)
{
  std::vector<Bodies> expected;
  for (const int time : test.error_times)
    expected.push_back(test.reference(test.scene, time));
  const std::vector<double> costs = medianCosts(engines, test.scene, repeats);
  bool met = costs[0] * test.speed_target <= *std::min_element(costs.begin() + 1, costs.end());
  for (std::size_t i = 0; i < engines.size(); ++i)
  {
    std::printf("| %-10s | %-11s | %9.2f | %6.2f |", test.name.c_str(), engines[i].name.c_str(), costs[i],
                costs[i] / costs[0]);
    const std::vector<double> error = errors(engines[i], test, expected);
    for (std::size_t k = 0; k < error.size(); ++k)
      std::printf(" %.1e at %2d s |", error[k], test.error_times[k]);
    std::printf("\n");
    if (i == 0)
      met = met && *std::max_element(error.begin(), error.end()) <= error_target;
  }
  std::printf("%s", met ? "" : "  target missed: ");
  if (!met)
    std::printf("%g times cheaper than the cheaper peer, error at most %g m\n", test.speed_target, error_target);
  return met;
}

}  // namespace

int main(int argc, char** argv)
try
{
  int repeats = 21;
  bool check = false;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    if (option == "--check")
      check = true;
    else if (option == "--repeats" && i + 1 < argc)
      repeats = std::max(1, std::atoi(argv[++i]));
    else
      throw std::runtime_error("usage: benchmark_peers [--repeats N] [--check]");
  }
  const std::vector<peers::Engine> engines = { { "block_world", peers::buildBlockWorld },
                                               { "Box2D 2.4", peers::buildBox2d },
                                               { "Chipmunk 7", peers::buildChipmunk } };
  std::printf("CPU us per simulated second over %d s, median of %d; ratio to block_world; largest corner error in "
              "m\n\n",
              cost_duration, repeats);
  std::printf("| scene      | engine      |   us / s  | ratio  | error           | error           |\n");
  std::printf("|------------|-------------|-----------|--------|-----------------|-----------------|\n");
  bool met = true;
  for (const Case& test : cases())
    met = run(test, engines, repeats) && met;
  return check && !met ? 1 : 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "benchmark_peers: %s\n", error.what());
  return 2;
}
