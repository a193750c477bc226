#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace block_world
{
/// What the command line asks for.
struct SimulateOptions
{
  std::string scene;
  std::int64_t duration = 0;                  ///< ns
  double sample = 0.0;                        ///< s
  std::optional<double> tolerance;            ///< m, in place of the scene's
  std::string states, energy, contacts, bag;  ///< paths; states empty = standard output, others empty = not wanted
  bool verbose = false;                       ///< tell what the computing was done for
};

/// A command line that cannot be followed.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Nothing where the help was asked for, and printed. Throws UsageError.
std::optional<SimulateOptions> parseSimulateOptions(int argc, const char* const* argv);

}  // namespace block_world
