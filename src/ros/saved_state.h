#pragma once

#include <cstdint>
#include <string>

#include "block_world/world.h"

// Saved states as files, and in a node's time.
namespace block_world
{
struct RestoredWorld
{
  World world;
  std::int64_t time_ns;  ///< where it begins
};

/// A saved world moved by whole seconds to the first instant not before a time. Throws std::runtime_error.
RestoredWorld restoreNotBefore(const std::string& saved, std::int64_t time_ns);

/// Throws std::runtime_error with the reason, without the path.
std::string readFile(const std::string& path);
/// What is there is replaced once all is written, else left as it is. Throws std::runtime_error with the reason.
void writeFile(const std::string& path, const std::string& bytes);
}  // namespace block_world
