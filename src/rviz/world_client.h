#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QString>
#include <QTimer>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <block_world/SetState.h>

#include "messages.h"
#include "service_call.h"

namespace block_world
{
/// All that the plugins say to a block world and hear from it. Messages and answers come in the thread of Qt, by a
/// timer of the computer's clock, and nothing ever waits for the world.
class WorldClient
{
public:
  WorldClient();

  /// The node's name, relative to the namespace of rviz or absolute. Forgets what the former world has
  /// said. A name that is none leaves it without a world.
  void connect(const std::string& world);

  /// The node's name in full.
  std::string name() const;
  /// A world publishes its states there.
  bool isThere() const;
  bool isPaused() const;
  const msg::BodyStates& bodies() const;

  /// Called with every message; those that are not set are not called. The texts are what services have to say.
  std::function<void(const msg::Energy&)> on_energy;
  std::function<void(const msg::Input&)> on_input;
  std::function<void(const std::map<std::string, double>&)> on_parameters;
  std::function<void(const QString&)> on_answer;

  /// A thrust or pull that is not repeated ends by itself after this, in s of simulated time: should rviz die, nothing
  /// is held for ever.
  double holdTime() const;
  void thrust(const std::string& body, const std::vector<double>& levels);
  /// An empty body lets the world pick the nearest one.
  void pull(const std::string& body, const geometry_msgs::Point& attach, const geometry_msgs::Point& anchor);
  void release(const std::string& body);

  void togglePause();
  void reset();
  void step();
  /// False, and nothing is sent, while an earlier call waits for its answer.
  bool setState(const msg::BodyState& state, const std::function<void(bool)>& on_answer);
  /// Values that cannot be sent at once follow later, the last one of each name.
  void setParameter(const std::string& name, double value);

private:
  void connectTopics(const std::string& prefix);
  void poll();
  void onEnergy(const msg::Energy::ConstPtr& message);
  void onBodies(const msg::BodyStates::ConstPtr& message);
  void onInput(const msg::Input::ConstPtr& message);
  void onPaused(const std_msgs::Bool::ConstPtr& message);
  void onParameters(const dynamic_reconfigure::Config::ConstPtr& message);
  void takeParameters(const dynamic_reconfigure::Config& config);
  void sendParameters();
  template <class Service>
  void call(ServiceCall<Service>& service, const typename Service::Request& request);
  void tell(const std::string& text) const;

  std::shared_ptr<ros::CallbackQueue> queue_ = std::make_shared<ros::CallbackQueue>();
  ros::NodeHandle handle_;
  std::string name_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher thrust_, spring_;
  ServiceCall<std_srvs::SetBool> pause_;
  ServiceCall<std_srvs::Trigger> reset_;
  ServiceCall<msg::Step> step_;
  ServiceCall<SetState> set_state_;
  ServiceCall<dynamic_reconfigure::Reconfigure> set_parameters_;

  bool paused_ = false;
  msg::BodyStates bodies_;
  std::map<std::string, double> parameters_;  ///< as the world has told them
  std::map<std::string, double> unsent_;
  QTimer timer_;
};

}  // namespace block_world
