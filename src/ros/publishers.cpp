#include "publishers.h"

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

Publishers::Publishers(const Outlets& outlets, const World& world, const std::string& frame_id,
                       const std::string& tf_prefix)
  : world_(world), overlay_(world), frame_id_(frame_id), tf_prefix_(tf_prefix)
{
  const auto bind = [this](void (Publishers::*greet)(const ros::SingleSubscriberPublisher&)) {
    return [this, greet](const ros::SingleSubscriberPublisher& subscriber) { (this->*greet)(subscriber); };
  };
  transforms_.open(outlets, "/tf", STATE_QUEUE, bind(&Publishers::onTransformSubscriber));
  bodies_.open(outlets, topics::BODIES, STATE_QUEUE, bind(&Publishers::onBodiesSubscriber));
  energy_.open(outlets, topics::ENERGY, STATE_QUEUE, bind(&Publishers::onEnergySubscriber));
  contacts_.open(outlets, topics::CONTACTS, STATE_QUEUE);
  inputs_.open(outlets, topics::INPUTS, INPUT_QUEUE, bind(&Publishers::onInputsSubscriber));
  overlays_.open(outlets, topics::OVERLAY, DISPLAY_QUEUE, bind(&Publishers::onOverlaySubscriber));
  markers_.openLatched(outlets, topics::MARKERS, DISPLAY_QUEUE);
  scene_.openLatched(outlets, topics::SCENE, DISPLAY_QUEUE);
  paused_flag_.openLatched(outlets, topics::PAUSED, DISPLAY_QUEUE);
}

void Publishers::setOrigin(std::int64_t origin_ns)
{
  origin_ns_ = origin_ns;
}

void Publishers::setPaused(bool paused, std::int64_t now_ns)
{
  paused_ = paused;
  std_msgs::Bool flag;
  flag.data = paused;
  paused_flag_.send(flag, stamp(origin_ns_, now_ns));
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
  msg::Input input;
  input.kind = msg::Input::LOAD_SCENE;
  input.text = writeScene(world_.scene());
  publishWorld(input, now_ns);
}

void Publishers::publishRestored(const std::string& saved, std::int64_t now_ns)
{
  msg::Input input;
  input.kind = msg::Input::RESTORE;
  input.data.assign(saved.begin(), saved.end());
  publishWorld(input, now_ns);
}

void Publishers::publishWorld(const msg::Input& input, std::int64_t now_ns)
{
  world_input_ = input;
  log(world_input_, now_ns);
  publishBlocks(now_ns);
}

void Publishers::log(msg::Input& input, std::int64_t now_ns)
{
  input.header = header(now_ns);
  input.time_ns = now_ns;
  input.index = input_index_++;
  inputs_.send(input, input.header.stamp);
}

void Publishers::publishBlocks(std::int64_t now_ns)
{
  std_msgs::String text;
  text.data = writeScene(world_.scene());
  scene_.send(text, stamp(origin_ns_, now_ns));
  overlay_ = Overlay(world_);
  markers_.send(sceneMarkers(world_, frame_id_, tf_prefix_), stamp(origin_ns_, now_ns));
}

void Publishers::publishState(std::int64_t now_ns, std::vector<ContactEvent> contacts)
{
  state_ns_ = now_ns;
  started_ = true;
  overlay_.remember(contacts);
  publishTransforms(now_ns);
  const ros::Time time = stamp(origin_ns_, now_ns);
  if (bodies_.isWanted())
    bodies_.send(states(now_ns), time);
  if (energy_.isWanted())
  {
    msg::Energy message = energy(world_);
    message.header = header(now_ns);
    energy_.send(message, time);
  }
  if (contacts_.isWanted())
    publishContacts(now_ns, contacts);
}

void Publishers::publishOverlay(std::int64_t now_ns)
{
  if (overlays_.isWanted())
    overlays_.send(overlay_.markers(world_, header(now_ns)), stamp(origin_ns_, now_ns));
}

void Publishers::forgetImpulses()
{
  overlay_.forgetImpulses();
}

void Publishers::publishInput(const Command& command, std::int64_t now_ns, bool from_scene)
{
  msg::Input input = toInput(command);
  input.from_scene = from_scene;
  log(input, now_ns);
}

msg::BodyStates Publishers::states(std::int64_t now_ns) const
{
  msg::BodyStates message = bodyStates(world_);
  message.header = header(now_ns);
  message.time_ns = now_ns;
  message.inputs = input_index_;
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
  if (transforms_.isWanted())
    transforms_.send(transforms(), transform_stamp_);
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
  contacts_.send(message, message.header.stamp);
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
    subscriber.publish(world_input_);
}

}  // namespace block_world
