#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "harness.h"

namespace block_world::speed
{
/// Processor and compiler.
std::string machine();

/// The line of names, then one row for each measure of each setting.
void writeCsvHeader(std::ostream& out);
void writeCsv(const CaseResults& results, std::ostream& out);

/// A Markdown table: each engine's error and cost at its default, and its least error with that one's cost.
void writeTable(const std::vector<CaseResults>& all, std::ostream& out);

/// What a collision costs each engine at its default, in the cases where that is asked: a list.
void writeCollisions(const std::vector<CaseResults>& all, std::ostream& out);

/// What is asked of us, all of it of one setting.
struct Goal
{
  std::string scene, setting, what;
  double asked = 0.0, measured = 0.0;
  bool met = false;
};
std::vector<Goal> goals(const std::vector<CaseResults>& all);
void writeGoals(const std::vector<Goal>& goals, std::ostream& out);

}  // namespace block_world::speed
