#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness.h"

namespace block_world::speed
{
/// What the command line asks for.
struct Options
{
  Plan plan;
  unsigned seed = 0;
  bool quick = false, list = false, check = false;
  std::vector<std::string> scenes;  ///< families; empty: all
  std::string csv, report;          ///< paths; report empty = standard output, csv empty = not wanted
};

/// A command line that cannot be followed.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Nothing where the help was asked for, and printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}  // namespace block_world::speed
