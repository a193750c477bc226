#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>
#include <vector>

#include "messages.h"
#include "topics.h"

namespace block_world
{
/// Waits for something that other processes do, up to 10 s of the computer's clock.
inline bool waitFor(const std::function<bool()>& condition, double seconds = 10.0)
{
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end)
  {
    ros::spinOnce();
    if (condition())
      return true;
    ros::WallDuration(0.005).sleep();
  }
  return condition();
}

/// Remembers what comes on a topic.
template <class Message>
class Listener
{
public:
  Listener(const std::string& topic, int queue)
  {
    subscriber_ = handle_.subscribe(topic, queue, &Listener::onMessage, this);
  }

  bool waitForPublisher() const
  {
    return waitFor([this] { return subscriber_.getNumPublishers() > 0; });
  }

  bool waitForCount(std::size_t count) const
  {
    return waitFor([this, count] { return messages.size() >= count; });
  }

  std::vector<Message> messages;

private:
  void onMessage(const typename Message::ConstPtr& message)
  {
    messages.push_back(*message);
  }

  ros::NodeHandle handle_;
  ros::Subscriber subscriber_;
};

/// The services and command topics of a node, by the node's name.
class NodeClient
{
public:
  explicit NodeClient(const std::string& name) : name_("/" + name + "/")
  {
    step_ = handle_.serviceClient<msg::Step>(topic(topics::STEP));
    pause_ = handle_.serviceClient<std_srvs::SetBool>(topic(topics::PAUSE));
    reset_ = handle_.serviceClient<std_srvs::Trigger>(topic(topics::RESET));
    EXPECT_TRUE(waitFor([this] { return step_.exists(); }, 20.0)) << name_ << " is not there";
  }

  std::string topic(const char* name) const
  {
    return name_ + name;
  }

  msg::Step::Response step(const msg::Step::Request& request)
  {
    msg::Step::Response response;
    EXPECT_TRUE(step_.call(request, response)) << name_ << " did not answer";
    return response;
  }

  /// Steps, expects success, and returns the blocks.
  std::vector<msg::BodyState> advance(double duration)
  {
    msg::Step::Request request;
    request.duration = duration;
    const msg::Step::Response response = step(request);
    EXPECT_TRUE(response.success) << response.message;
    return response.state.bodies;
  }

  /// The hash of the present state.
  std::uint64_t hash()
  {
    return step(msg::Step::Request()).state.state_hash;
  }

  void pause(bool paused)
  {
    std_srvs::SetBool service;
    service.request.data = paused;
    EXPECT_TRUE(pause_.call(service) && service.response.success);
  }

  void reset()
  {
    std_srvs::Trigger service;
    EXPECT_TRUE(reset_.call(service) && service.response.success) << service.response.message;
  }

  /// Calls any of the node's services; the caller looks at success.
  template <class Service>
  typename Service::Response call(const char* service, const typename Service::Request& request)
  {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::call(topic(service), const_cast<typename Service::Request&>(request), response))
        << topic(service) << " did not answer";
    return response;
  }

  /// Loads a scene from text and expects success.
  void load(const std::string& text)
  {
    msg::LoadScene::Request request;
    request.text = text;
    const msg::LoadScene::Response response = call<msg::LoadScene>(topics::LOAD_SCENE, request);
    EXPECT_TRUE(response.success) << response.message;
  }

  /// The state that is told now, and its stamp.
  msg::BodyStates state()
  {
    return step(msg::Step::Request()).state;
  }

private:
  std::string name_;
  ros::NodeHandle handle_;
  ros::ServiceClient step_, pause_, reset_;
};

}  // namespace block_world
