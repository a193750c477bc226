#pragma once

#include <ros/node_handle.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <string>
#include <vector>

#include "block_world/world.h"
#include "markers.h"
#include "messages.h"
#include "outlet.h"

namespace block_world
{
/// Everything the node sends but /clock and /diagnostics, to subscribers, into a bag, or to both. Who subscribes while
/// the world is paused gets the current state at once.
class Publishers
{
public:
  /// stamp = origin + simulated time.
  Publishers(const Outlets& outlets, const World& world, const std::string& frame_id, const std::string& tf_prefix);

  void setOrigin(std::int64_t origin_ns);
  void setPaused(bool paused, std::int64_t now_ns);

  /// A scene was loaded: logs it as an input, and publishes its blocks.
  void publishScene(std::int64_t now_ns);
  /// The same of a state that was restored.
  void publishRestored(const std::string& saved, std::int64_t now_ns);
  /// Scene text and shapes, where blocks have come or gone.
  void publishBlocks(std::int64_t now_ns);

  /// The state at now(), with the contacts since the last call.
  void publishState(std::int64_t now_ns, std::vector<ContactEvent> contacts);
  /// Once more after a change at the same instant.
  void publishOverlay(std::int64_t now_ns);
  void forgetImpulses();

  void publishInput(const Command& command, std::int64_t now_ns, bool from_scene);

  msg::BodyStates states(std::int64_t now_ns) const;

private:
  void publishWorld(const msg::Input& input, std::int64_t now_ns);
  void log(msg::Input& input, std::int64_t now_ns);
  std_msgs::Header header(std::int64_t now_ns) const;
  tf2_msgs::TFMessage transforms() const;
  void publishTransforms(std::int64_t now_ns);
  void publishContacts(std::int64_t now_ns, const std::vector<ContactEvent>& contacts);

  void onTransformSubscriber(const ros::SingleSubscriberPublisher& subscriber);
  void onBodiesSubscriber(const ros::SingleSubscriberPublisher& subscriber);
  void onEnergySubscriber(const ros::SingleSubscriberPublisher& subscriber);
  void onOverlaySubscriber(const ros::SingleSubscriberPublisher& subscriber);
  void onInputsSubscriber(const ros::SingleSubscriberPublisher& subscriber);

  const World& world_;
  Overlay overlay_;
  std::string frame_id_, tf_prefix_;
  std::int64_t origin_ns_ = 0;
  std::int64_t state_ns_ = 0;
  ros::Time transform_stamp_;
  bool paused_ = false;
  bool started_ = false;
  std::uint64_t input_index_ = 0;
  msg::Input world_input_;  ///< where the present world comes from

  Outlet<tf2_msgs::TFMessage> transforms_;
  Outlet<msg::BodyStates> bodies_;
  Outlet<msg::Energy> energy_;
  Outlet<msg::Contacts> contacts_;
  Outlet<msg::Input> inputs_;
  Outlet<std_msgs::String> scene_;
  Outlet<std_msgs::Bool> paused_flag_;
  Outlet<visualization_msgs::MarkerArray> markers_, overlays_;
};

}  // namespace block_world
