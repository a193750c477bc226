#pragma once

#include <ros/node_handle.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <string>
#include <vector>

#include "block_world/world.h"
#include "markers.h"
#include "messages.h"

namespace block_world
{
/// Everything the node sends but /clock. Who subscribes while the world is paused gets the current state at once.
class Publishers
{
public:
  /// stamp = origin + simulated time.
  Publishers(ros::NodeHandle& handle, const World& world, const std::string& frame_id, const std::string& tf_prefix);

  void setOrigin(std::int64_t origin_ns);
  void setPaused(bool paused);

  /// A scene was loaded: logs it as an input, and publishes its blocks.
  void publishScene(std::int64_t now_ns);
  /// Scene text and shapes, where blocks have come or gone.
  void publishBlocks();

  /// The state at now(), with the contacts since the last call.
  void publishState(std::int64_t now_ns, std::vector<ContactEvent> contacts);
  /// Once more after a change at the same instant.
  void publishOverlay(std::int64_t now_ns);
  void forgetImpulses();

  void publishInput(const Command& command, std::int64_t now_ns, bool from_scene);

  msg::BodyStates states(std::int64_t now_ns) const;

private:
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
  msg::Input load_input_;

  ros::Publisher transforms_, markers_, overlays_, bodies_, energy_, contacts_, inputs_, scene_, paused_flag_;
};

}  // namespace block_world
