#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "block_world/scene.h"
#include "reference.h"
#include "recording.h"

namespace block_world::speed
{
/// Something that can be wrong with a run; the larger, the worse.
struct Measure
{
  std::string name, unit;
  std::function<double(const Run&)> of;
  std::optional<double> goal = std::nullopt;  ///< what ours shall not exceed
};

/// A scene, or many alike, with what is measured on it.
struct Case
{
  std::string name;
  std::vector<Scene> scenes;
  int frames = 0;
  std::vector<Measure> measures;  ///< the first is the one that is plotted
  double cheaper =
      0.0;             ///< how many times below the cheapest peer at its default our cost shall be; 0: nothing is asked
  bool rests = false;  ///< the cheapest peer is looked for among those with sleeping, too
  bool counts_collisions = false;  ///< what a collision costs is told
};

/// Largest distance of a corner from where it belongs, over all frames from first on.
Measure cornerError(const Path& path, int first = 0);
/// The same at one frame.
Measure cornerErrorAt(const Path& path, int frame);
/// |last / first - 1| of the kinetic energy.
Measure energyChange(const Scene& scene);
/// Largest rise of the total energy above its lowest value before, over that of the start.
Measure energyGain(const Scene& scene);
/// Deepest overlap of blocks and walls over all frames.
Measure overlap(const Scene& scene);

}  // namespace block_world::speed
