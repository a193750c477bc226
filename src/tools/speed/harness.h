#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case.h"
#include "engine.h"

namespace block_world::speed
{
/// How much is run.
struct Plan
{
  int repeats = 9;
  double budget = 0.4;         ///< s of CPU time for the repeats of one setting on one case
  bool only_defaults = false;  ///< no sweep
};

/// What one setting of one engine made of a case.
struct Result
{
  std::string engine, version;
  Setting setting;
  bool is_default = false;
  std::string cannot;          ///< why there is nothing else here; else empty
  std::vector<double> errors;  ///< as the case's measures; infinite where states are not finite
  double cost = 0.0;           ///< s of CPU time per simulated s, median
  double spread = 0.0;         ///< distance of the quartiles over the median
  double least_cost = 0.0;
  int repeats = 0;
  std::int64_t impacts = -1;
};

struct CaseResults
{
  Case of;
  std::vector<Result> results;  ///< by engine, then by setting, as far as the budget went
};

/// CPU time of one run, in s, from the built scene to the last state.
double seconds(const Case& of, const Engine& engine, const Setting& setting);

/// Every engine in every setting. They take turns, so that a busy moment of the machine meets all of them. The first
/// round finds the errors and warms up; the others are timed.
CaseResults measure(const Case& of, const std::vector<Engine>& engines, const Plan& plan);

}  // namespace block_world::speed
