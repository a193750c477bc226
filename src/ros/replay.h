#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bag_writer.h"
#include "block_world/world.h"
#include "publishers.h"
#include "run_log.h"

namespace block_world
{
/// A logged run, run again: every command at its time, in the order of the log, and every state compared with the
/// logged one.
///
/// A state tells how many commands had acted by then. So where commands and states share one instant, each state is
/// compared after exactly those that the node had applied when it sent it.
class Replay
{
public:
  struct Deviation
  {
    double distance = 0.0;  ///< m, of a block from where it was
    double time = 0.0;      ///< s
    std::string block;
  };

  /// tolerance: m, in place of the scenes' own. Throws RunLogError.
  Replay(const RunLog& log, const std::optional<double>& tolerance);

  /// Writes the new run into a bag as well.
  void writeTo(const std::string& path);

  /// Runs to the next state of the log and compares. Returns what differs, or nothing. Throws RunLogError.
  std::string compare(const msg::BodyStates& logged);

  /// Completes the bag. Throws std::runtime_error.
  void close();

  const World& world() const
  {
    return world_;
  }
  /// States compared so far.
  std::int64_t states() const
  {
    return states_;
  }
  /// States from before the first scene of the log.
  std::int64_t leftOut() const
  {
    return left_out_;
  }
  std::size_t inputsApplied() const
  {
    return next_;
  }
  const Deviation& largest() const
  {
    return largest_;
  }

private:
  World startWorld(const msg::Input& input) const;
  std::string apply(const msg::Input& input);
  std::string advance(std::int64_t time_ns, const std::string& what);
  std::string compareSceneInputs();
  void publish(const msg::Input& input, const Command& command);
  std::string differences(const msg::BodyStates& logged);
  void measure(const msg::BodyStates& logged, const msg::BodyStates& own);
  [[noreturn]] void refuse(const msg::Input& input, const std::string& reason) const;

  const RunLog& log_;
  std::optional<double> tolerance_;
  World world_;
  std::size_t next_ = 1;  ///< of the log's inputs; the first one made the world
  std::int64_t states_ = 0, left_out_ = 0;
  std::vector<msg::Input> logged_scene_inputs_, own_scene_inputs_;
  Deviation largest_;
  std::unique_ptr<BagWriter> bag_;
  std::unique_ptr<Publishers> publishers_;
};

/// How an input is called where it is told about.
std::string describe(const msg::Input& input);

}  // namespace block_world
