#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "block_world/world.h"

namespace block_world
{
/// The bag that --bag asks for: what the node would have recorded of the same run.
class BagOutput
{
public:
  /// An empty path: no bag. Throws std::runtime_error where it cannot be written, or where this program was built
  /// without ROS.
  BagOutput(const std::string& path, World& world);
  ~BagOutput();

  /// Advances the world to a time, calling `busy` now and then, and writes the states that are due on the way; returns
  /// the contacts met.
  std::vector<ContactEvent> advance(std::int64_t target, const std::function<void()>& busy);

  /// Writes the last state. Throws std::runtime_error where the bag could not be written.
  void close();

private:
  struct Recorder;
  World& world_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace block_world
