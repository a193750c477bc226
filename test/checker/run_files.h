#pragma once

#include <array>
#include <string>
#include <vector>

#include "report.h"
#include "scene.h"

namespace checker
{
enum class Kind
{
  Impact,
  RestBegin,
  RestEnd,
  Rest
};

/// One row of the contacts file.
struct ContactRow
{
  double time = 0.0;
  Kind kind = Kind::Impact;
  int a = -1, b = -1;
  Vec2 point, normal;  ///< from b to a
  double normal_velocity = 0.0;
  double impulse = 0.0;  ///< N s; of a resting contact the force in N
};

/// One row of the energy file.
struct EnergyRow
{
  double time = 0.0;
  double gravity = 0.0, spring = 0.0, translational = 0.0, rotational = 0.0, total = 0.0;
  double thrust_work = 0.0, spring_work = 0.0, command_work = 0.0, damping_loss = 0.0, impact_loss = 0.0,
         balance_error = 0.0;
};

/// What a run wrote.
struct Run
{
  std::vector<double> times;  ///< of the samples
  std::vector<State> states;  ///< of all blocks at all samples; of fixed blocks their constant pose
  std::vector<EnergyRow> energy;
  std::vector<ContactRow> contacts;
  size_t bodies = 0;

  const State& state(size_t sample, int body) const
  {
    return states[sample * bodies + body];
  }
};

struct RunPaths
{
  std::string states, energy, contacts;
};

/// Reads the three files. What is wrong with single rows goes into the report (file.*); throws std::runtime_error where
/// a file is missing or no table of that kind.
Run readRun(const RunPaths& paths, const Scene& scene, Report& report);

/// The same from text, for tests.
Run parseRun(const std::string& states, const std::string& energy, const std::string& contacts, const Scene& scene,
             Report& report);

/// Checks what `simulate` says in its summary line (summary.*).
void checkSummary(const std::string& text, const Scene& scene, Report& report);

}  // namespace checker
