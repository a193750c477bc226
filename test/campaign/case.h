#pragma once

#include <string>
#include <vector>

#include "block_world/world.h"

namespace campaign
{
/// What is simulated and judged: a scene, and commands that a scene file cannot hold (set_state, spawn, delete), given
/// to World::apply at their times.
struct Case
{
  block_world::Scene scene;
  std::vector<block_world::TimedCommand> script;  ///< in the order of their times
  double duration = 0.0;                          ///< s

  bool fitsSceneFile() const
  {
    return script.empty();
  }
};

/// The scene file, and the script where there is one, beside it: what simulate and the campaign read.
void saveCase(const Case& item, const std::string& scene_path);
Case loadCase(const std::string& scene_path, double duration);
std::string scriptPath(const std::string& scene_path);

/// The case after a way through its file, so that what is judged in memory is to the bit what simulate reads.
Case throughFile(const Case& item);

/// The block that a command is for; empty where it is for none or for all.
std::string bodyOf(const block_world::Command& command);

}  // namespace campaign
