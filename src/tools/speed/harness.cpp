#include "harness.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace block_world::speed
{
namespace
{
double processSeconds()
{
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void read(const Simulation& simulation, int frame, Recording& recording)
{
  for (int block = 0; block < recording.blocks; ++block)
    recording.states[static_cast<std::size_t>(frame) * recording.blocks + block] = simulation.state(block);
}

/// CPU time from the built scene to the last state.
double simulate(Simulation& simulation, int frames, Recording& recording)
{
  recording.states.resize(static_cast<std::size_t>(frames + 1) * recording.blocks);
  read(simulation, 0, recording);
  const double begin = processSeconds();
  for (int frame = 1; frame <= frames; ++frame)
  {
    simulation.nextFrame();
    read(simulation, frame, recording);
  }
  return processSeconds() - begin;
}

struct Timed
{
  Run run;
  double seconds = 0.0;
};

Timed simulate(const Case& of, const Engine& engine, const Setting& setting)
{
  Timed timed;
  std::int64_t impacts = 0;
  for (const Scene& scene : of.scenes)
  {
    const std::unique_ptr<Simulation> simulation = engine.build(scene, setting);
    Recording recording;
    recording.blocks = static_cast<int>(scene.blocks.size());
    timed.seconds += simulate(*simulation, of.frames, recording);
    impacts = simulation->impacts() < 0 ? -1 : impacts + simulation->impacts();
    timed.run.recordings.push_back(std::move(recording));
  }
  timed.run.impacts = impacts;
  return timed;
}

bool isFinite(const Run& run)
{
  for (const Recording& recording : run.recordings)
    for (const MotionState& state : recording.states)
      if (!state.position.allFinite() || !std::isfinite(state.angle) || !state.velocity.allFinite() ||
          !std::isfinite(state.omega))
        return false;
  return true;
}

std::vector<double> errorsOf(const Case& of, const Run& run)
{
  const bool finite = isFinite(run);
  std::vector<double> errors;
  for (const Measure& measure : of.measures)
    errors.push_back(finite ? measure.of(run) : std::numeric_limits<double>::infinity());
  return errors;
}

/// One setting of one engine, from round to round.
struct Contestant
{
  const Engine* engine = nullptr;
  Result result;
  double first = 0.0;  ///< s of CPU time in the first round
  std::vector<double> seconds;
};

bool alike(const Setting& a, const Setting& b)
{
  return a.iterations == b.iterations && a.effort == b.effort && a.sleeping == b.sleeping;
}

/// Seconds of one run, from what the next coarser steps took; 0 where there are none.
double expectedSeconds(const std::vector<Contestant>& field, const Engine& engine, const Setting& setting)
{
  double seconds = 0.0;
  for (const Contestant& other : field)
    if (other.engine == &engine && alike(other.result.setting, setting) && other.result.cannot.empty())
      seconds = other.first * setting.steps / other.result.setting.steps;
  return seconds;
}

/// A single run that is expected to take longer than so many budgets is left out.
constexpr double longest = 5.0;

/// The first round.
std::vector<Contestant> enter(const Case& of, const std::vector<Engine>& engines, const Plan& plan)
{
  std::vector<Contestant> field;
  for (const Engine& engine : engines)
  {
    const std::string cannot = engine.cannot(of.scenes.front());
    for (const Setting& setting : engine.settings)
    {
      const bool is_default = &setting == &engine.settings.front();
      if (!is_default && (plan.only_defaults || !cannot.empty() ||
                          (setting.steps > 1 && expectedSeconds(field, engine, setting) > longest * plan.budget)))
        continue;
      Contestant contestant;
      contestant.engine = &engine;
      contestant.result.engine = engine.name;
      contestant.result.version = engine.version;
      contestant.result.setting = setting;
      contestant.result.is_default = is_default;
      contestant.result.cannot = cannot;
      if (cannot.empty())
      {
        const Timed timed = simulate(of, engine, setting);
        contestant.first = timed.seconds;
        contestant.result.errors = errorsOf(of, timed.run);
        contestant.result.impacts = timed.run.impacts;
      }
      field.push_back(std::move(contestant));
    }
  }
  return field;
}

/// What others have driven out of the caches comes back in a run that does not count, where that is a matter of
/// microseconds.
double warmSeconds(const Case& of, const Contestant& contestant)
{
  constexpr double brief = 0.01;
  const Setting& setting = contestant.result.setting;
  if (contestant.first < brief)
    simulate(of, *contestant.engine, setting);
  return simulate(of, *contestant.engine, setting).seconds;
}

void summarise(const Case& of, Contestant& contestant)
{
  std::vector<double>& seconds = contestant.seconds;
  if (seconds.empty())
    seconds.push_back(contestant.first);
  std::sort(seconds.begin(), seconds.end());
  const std::size_t count = seconds.size();
  const double simulated = static_cast<double>(of.frames) / frame_rate * static_cast<double>(of.scenes.size());
  const double median = seconds[count / 2];
  contestant.result.cost = median / simulated;
  contestant.result.least_cost = seconds.front() / simulated;
  contestant.result.spread = (seconds[count * 3 / 4] - seconds[count / 4]) / median;
  contestant.result.repeats = static_cast<int>(count);
}

}  // namespace

double seconds(const Case& of, const Engine& engine, const Setting& setting)
{
  return simulate(of, engine, setting).seconds;
}

CaseResults measure(const Case& of, const std::vector<Engine>& engines, const Plan& plan)
{
  std::vector<Contestant> field = enter(of, engines, plan);
  for (int repeat = 0; repeat < plan.repeats; ++repeat)
    for (Contestant& contestant : field)
      if (contestant.result.cannot.empty() && contestant.first * (repeat + 1) < plan.budget)
        contestant.seconds.push_back(warmSeconds(of, contestant));
  CaseResults results{ of, {} };
  for (Contestant& contestant : field)
  {
    if (contestant.result.cannot.empty())
      summarise(of, contestant);
    results.results.push_back(std::move(contestant.result));
  }
  return results;
}

}  // namespace block_world::speed
