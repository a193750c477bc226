#include "publishers.h"

#include <std_msgs/Bool.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <utility>

#include "block_world/scene_yaml.h"
#include "conversions.h"
#include "topics.h"

namespace block_world
{
namespace
{
// Messages that wait for a slow subscriber. A long step sends its states in one burst; inputs are a log.
constexpr int STATE_QUEUE = 1000, INPUT_QUEUE = 10000, DISPLAY_QUEUE = 1;
}  // namespace

Publishers::Publishers(ros::NodeHandle& handle, const World& world, const std::string& frame_id,
                       const std::string& tf_prefix)
  : world_(world), overlay_(world), frame_id_(frame_id), tf_prefix_(tf_prefix)
{
  const auto bind = [this](void (Publishers::*greet)(const ros::SingleSubscriberPublisher&)) {
    return [this, greet](const ros::SingleSubscriberPublisher& subscriber) { (this->*greet)(subscriber); };
  };
  transforms_ = handle.advertise<tf2_msgs::TFMessage>("/tf", STATE_QUEUE, bind(&Publishers::onTransformSubscriber));
  bodies_ = handle.advertise<msg::BodyStates>(topics::BODIES, STATE_QUEUE, bind(&Publishers::onBodiesSubscriber));
  energy_ = handle.advertise<msg::Energy>(topics::ENERGY, STATE_QUEUE, bind(&Publishers::onEnergySubscriber));
  contacts_ = handle.advertise<msg::Contacts>(topics::CONTACTS, STATE_QUEUE);
  inputs_ = handle.advertise<msg::Input>(topics::INPUTS, INPUT_QUEUE, bind(&Publishers::onInputsSubscriber));
  overlays_ = handle.advertise<visualization_msgs::MarkerArray>(topics::OVERLAY, DISPLAY_QUEUE,
                                                                bind(&Publishers::onOverlaySubscriber));
  markers_ = handle.advertise<visualization_msgs::MarkerArray>(topics::MARKERS, DISPLAY_QUEUE, true);
  scene_ = handle.advertise<std_msgs::String>(topics::SCENE, DISPLAY_QUEUE, true);
  paused_flag_ = handle.advertise<std_msgs::Bool>(topics::PAUSED, DISPLAY_QUEUE, true);
}

void Publishers::setOrigin(std::int64_t origin_ns)
{
  origin_ns_ = origin_ns;
}

void Publishers::setPaused(bool paused)
{
  paused_ = paused;
  std_msgs::Bool flag;
  flag.data = paused;
  paused_flag_.publish(flag);
}

std_msgs::Header Publishers::header(std::int64_t now_ns) const
{
  std_msgs::Header header;
  header.stamp = stamp(origin_ns_, now_ns);
  header.frame_id = frame_id_;
  return header;
}

void Publishers::publishScene(std::int64_t now_ns)
{
  load_input_ = msg::Input();
  load_input_.kind = msg::Input::LOAD_SCENE;
  load_input_.text = writeScene(world_.scene());
  load_input_.header = header(now_ns);
  load_input_.time_ns = now_ns;
  load_input_.index = input_index_++;
  inputs_.publish(load_input_);
  publishBlocks();
}

void Publishers::publishBlocks()
{
  std_msgs::String text;
  text.data = writeScene(world_.scene());
  scene_.publish(text);
  overlay_ = Overlay(world_);
  markers_.publish(sceneMarkers(world_, frame_id_, tf_prefix_));
}

void Publishers::publishState(std::int64_t now_ns, std::vector<ContactEvent> contacts)
{
  state_ns_ = now_ns;
  started_ = true;
  overlay_.remember(contacts);
  publishTransforms(now_ns);
  if (bodies_.getNumSubscribers() > 0)
    bodies_.publish(states(now_ns));
  if (energy_.getNumSubscribers() > 0)
  {
    msg::Energy message = energy(world_);
    message.header = header(now_ns);
    energy_.publish(message);
  }
  if (contacts_.getNumSubscribers() > 0)
    publishContacts(now_ns, contacts);
}

void Publishers::publishOverlay(std::int64_t now_ns)
{
  if (overlays_.getNumSubscribers() > 0)
    overlays_.publish(overlay_.markers(world_, header(now_ns)));
}

void Publishers::forgetImpulses()
{
  overlay_.forgetImpulses();
}

void Publishers::publishInput(const Command& command, std::int64_t now_ns, bool from_scene)
{
  msg::Input input = toInput(command);
  input.header = header(now_ns);
  input.time_ns = now_ns;
  input.index = input_index_++;
  input.from_scene = from_scene;
  inputs_.publish(input);
}

msg::BodyStates Publishers::states(std::int64_t now_ns) const
{
  msg::BodyStates message = bodyStates(world_);
  message.header = header(now_ns);
  return message;
}

tf2_msgs::TFMessage Publishers::transforms() const
{
  tf2_msgs::TFMessage message;
  message.transforms.resize(world_.bodyCount());
  for (int body = 0; body < world_.bodyCount(); ++body)
  {
    geometry_msgs::TransformStamped& transform = message.transforms[body];
    transform.header.stamp = transform_stamp_;
    transform.header.frame_id = frame_id_;
    transform.child_frame_id = tf_prefix_ + world_.name(body);
    transform.transform = toTransform(world_.state(body));
  }
  return message;
}

void Publishers::publishTransforms(std::int64_t now_ns)
{
  // tf2 ignores a second transform with the same stamp, so a state that has changed while time stands still (a reset in
  // a paused world) is stamped a nanosecond later.
  transform_stamp_ = std::max(stamp(origin_ns_, now_ns), transform_stamp_ + ros::Duration(0, 1));
  if (transforms_.getNumSubscribers() > 0)
    transforms_.publish(transforms());
}

void Publishers::publishContacts(std::int64_t now_ns, const std::vector<ContactEvent>& contacts)
{
  msg::Contacts message;
  for (const ContactEvent& contact : contacts)
    message.contacts.push_back(toMessage(world_, contact));
  for (const ContactEvent& contact : world_.restingContacts())
    message.contacts.push_back(toMessage(world_, contact));
  if (message.contacts.empty())
    return;
  message.header = header(now_ns);
  contacts_.publish(message);
}

void Publishers::onTransformSubscriber(const ros::SingleSubscriberPublisher& subscriber)
{
  // A running world sends the next state in a moment; the present one could reach the subscriber twice.
  if (started_ && paused_)
    subscriber.publish(transforms());
}

void Publishers::onBodiesSubscriber(const ros::SingleSubscriberPublisher& subscriber)
{
  if (started_ && paused_)
    subscriber.publish(states(state_ns_));
}

void Publishers::onEnergySubscriber(const ros::SingleSubscriberPublisher& subscriber)
{
  if (!started_ || !paused_)
    return;
  msg::Energy message = energy(world_);
  message.header = header(state_ns_);
  subscriber.publish(message);
}

void Publishers::onOverlaySubscriber(const ros::SingleSubscriberPublisher& subscriber)
{
  if (started_ && paused_)
    subscriber.publish(overlay_.markers(world_, header(state_ns_)));
}

void Publishers::onInputsSubscriber(const ros::SingleSubscriberPublisher& subscriber)
{
  if (started_)
    subscriber.publish(load_input_);
}

}  // namespace block_world
