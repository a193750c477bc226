#pragma once

#include <ros/node_handle.h>

#include <string>

#include "bag_writer.h"

namespace block_world
{
/// Where a world's messages go.
struct Outlets
{
  ros::NodeHandle* handle = nullptr;  ///< to subscribers; none where there is no master
  BagWriter* bag = nullptr;           ///< into a bag; none where nothing is recorded
  std::string name;                   ///< of the node, with its namespace
};

/// The messages of one topic.
template <class Message>
class Outlet
{
public:
  using Greet = ros::SubscriberStatusCallback;

  /// topic: private to the node, or with a leading slash. greet: called for every new subscriber, may be empty.
  void open(const Outlets& outlets, const std::string& topic, int queue, const Greet& greet = Greet())
  {
    open(outlets, topic, queue, greet, false);
  }
  void openLatched(const Outlets& outlets, const std::string& topic, int queue)
  {
    open(outlets, topic, queue, Greet(), true);
  }

  /// Whether anybody gets what is sent.
  bool isWanted() const
  {
    return bag_ != nullptr || latched_ || publisher_.getNumSubscribers() > 0;
  }

  /// time: of the message in the bag.
  void send(const Message& message, const ros::Time& time)
  {
    if (publisher_)
      publisher_.publish(message);
    if (bag_ != nullptr)
      bag_->write(topic_, time, message, latched_);
  }

private:
  void open(const Outlets& outlets, const std::string& topic, int queue, const Greet& greet, bool latched)
  {
    topic_ = topic[0] == '/' ? topic : outlets.name + "/" + topic;
    bag_ = outlets.bag;
    latched_ = latched;
    if (outlets.handle != nullptr)
      publisher_ = outlets.handle->advertise<Message>(topic, queue, greet, ros::SubscriberStatusCallback(),
                                                      ros::VoidConstPtr(), latched);
  }

  std::string topic_;
  ros::Publisher publisher_;
  BagWriter* bag_ = nullptr;
  bool latched_ = false;
};

}  // namespace block_world
