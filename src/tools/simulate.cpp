// Runs a scene file as fast as it can and writes its states, energies and contacts as CSV files, and as a bag.

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "block_world/scene_yaml.h"
#include "block_world/world.h"
#include "progress.h"
#include "simulate_bag.h"
#include "simulate_options.h"
#include "simulate_output.h"

namespace
{
using namespace block_world;

constexpr int done = 0, failed = 1, bad_input = 2;

/// CPU time of this process between start() and stop(), summed up.
class CpuClock
{
public:
  void start()
  {
    start_ = now();
  }
  void stop()
  {
    total_ += now() - start_;
  }
  double milliseconds() const
  {
    return static_cast<double>(total_) / 1e6;
  }

private:
  static std::int64_t now()
  {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<std::int64_t>(time.tv_sec) * 1000000000 + time.tv_nsec;
  }
  std::int64_t start_ = 0, total_ = 0;
};

/// Instant of a sample: the nearest whole nanosecond to number x period, at most the end of the run. Each is rounded by
/// itself, so that sixtieths of a second do not drift.
Time sampleTime(std::int64_t number, const SimulateOptions& options)
{
  const long double exact = static_cast<long double>(number) * options.sample * 1e9L;
  const bool is_last = exact >= static_cast<long double>(options.duration);
  return Time::fromNanoseconds(is_last ? options.duration : std::llround(exact));
}

Sample readSample(const World& world, const Output& output, std::vector<ContactEvent> contacts)
{
  Sample sample;
  sample.time = world.now();
  sample.states.reserve(world.bodyCount());
  for (int body = 0; body < world.bodyCount(); ++body)
    sample.states.push_back(world.state(body));
  if (output.wantsEnergy())
    sample.energy = world.energy();
  if (output.wantsContacts())
  {
    sample.contacts = std::move(contacts);
    sample.resting = world.restingContacts();
  }
  return sample;
}

void printSummary(const World& world, const CpuClock& cpu, double worst_overlap)
{
  const Statistics& statistics = world.statistics();
  std::fprintf(stderr,
               "summary: simulated_s=%.12g engine_cpu_ms=%.3f events=%lld impacts=%lld worst_overlap_m=%.3g "
               "balance_error_J=%.3g mode=%s\n",
               world.now().seconds(), cpu.milliseconds(), static_cast<long long>(statistics.events),
               static_cast<long long>(statistics.impacts), std::max(worst_overlap, statistics.worst_overlap),
               world.energy().balance_error, statistics.mode.c_str());
}

/// The islands that the computing of the whole run was done for, as many as can be read at a glance.
void printCosts(const World& world)
{
  constexpr std::size_t most = 5;
  const std::vector<IslandCost> islands = CostMeter().read(world);
  for (std::size_t i = 0; i < std::min(most, islands.size()); ++i)
    std::fprintf(stderr, "simulate: %s\n", islands[i].describe(world.now().seconds()).c_str());
}

/// Advances from sample to sample to the end; returns the deepest overlap seen at a sample.
double advance(World& world, const SimulateOptions& options, CpuClock& cpu, Output& output, BagOutput& bag)
{
  Progress progress;
  double worst_overlap = 0.0;
  const Time end = Time::fromNanoseconds(options.duration);
  for (std::int64_t number = 0;; ++number)
  {
    cpu.start();
    std::vector<ContactEvent> contacts =
        bag.advance(sampleTime(number, options).nanoseconds(), [&] { progress.show(world); });
    const Sample sample = readSample(world, output, std::move(contacts));
    cpu.stop();
    output.write(world, sample);
    worst_overlap = std::max(worst_overlap, world.overlap());
    if (sample.time >= end || world.now() < sampleTime(number, options))
      return worst_overlap;
    progress.show(world);
  }
}

BagOutput openBag(const std::string& path, World& world)
{
  try
  {
    return BagOutput(path, world);
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(error.what());
  }
}

void run(Scene scene, const SimulateOptions& options, Output& output)
{
  CpuClock cpu;
  cpu.start();
  World world(std::move(scene));
  cpu.stop();
  for (const std::string& note : world.notes())
    std::fprintf(stderr, "simulate: note: %s\n", note.c_str());
  BagOutput bag = openBag(options.bag, world);
  world.keepContacts(output.wantsContacts() || !options.bag.empty());
  const double worst_overlap = advance(world, options, cpu, output, bag);
  output.close();
  bag.close();
  if (options.verbose)
    printCosts(world);
  printSummary(world, cpu, worst_overlap);
  if (world.now() < Time::fromNanoseconds(options.duration))
    throw std::runtime_error(world.statistics().mode);
}

/// The files that a run will write. A file that cannot be opened is the caller's mistake.
Output openOutput(const SimulateOptions& options)
{
  try
  {
    return Output(options.states, options.energy, options.contacts);
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(error.what());
  }
}

int runCommand(int argc, char** argv)
{
  const std::optional<SimulateOptions> options = parseSimulateOptions(argc, argv);
  if (!options)
    return done;
  SceneOverrides overrides;
  overrides.tolerance = options->tolerance;
  Scene scene = loadSceneFile(options->scene, overrides);
  Output output = openOutput(*options);
  run(std::move(scene), *options, output);
  return done;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    return runCommand(argc, argv);
  }
  catch (const UsageError& error)
  {
    std::fprintf(stderr, "simulate: %s\n", error.what());
    return bad_input;
  }
  catch (const SceneFileError& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return bad_input;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "simulate: %s\n", error.what());
    return failed;
  }
}
