#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <deque>
#include <string>
#include <vector>

#include "block_world/world.h"

namespace block_world
{
/// Walls, in the world frame, and blocks, each locked to its own TF frame: they need to be sent on change only. The
/// stamp 0 keeps them valid however late they are received.
visualization_msgs::MarkerArray sceneMarkers(const World& world, const std::string& frame_id,
                                             const std::string& tf_prefix);

/// What changes with every state: spring lines, thruster flames, forces of resting contacts and recent impulses.
class Overlay
{
public:
  /// Lengths of arrows are chosen for the world as it is now.
  explicit Overlay(const World& world);

  /// Impacts among the contacts are shown for a moment from now on.
  void remember(const std::vector<ContactEvent>& contacts);
  void forgetImpulses();

  /// All in the world frame; what is not there is deleted from the view.
  visualization_msgs::MarkerArray markers(const World& world, const std_msgs::Header& header);

private:
  visualization_msgs::Marker springs(const World& world) const;
  visualization_msgs::Marker flames(const World& world) const;
  visualization_msgs::Marker forces(const World& world) const;
  visualization_msgs::Marker impulses(const World& world);

  double size_;          ///< m, a typical block's
  double metre_per_n_;   ///< length of a force's arrow
  double metre_per_ns_;  ///< length of an impulse's arrow
  std::deque<ContactEvent> impacts_;
};

}  // namespace block_world
