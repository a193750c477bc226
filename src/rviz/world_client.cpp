#include "world_client.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "topics.h"

namespace block_world
{
namespace
{
constexpr int POLL_MS = 10;
constexpr int COMMAND_QUEUE = 100;
constexpr int STATE_QUEUE = 100;
constexpr std::chrono::milliseconds PATIENCE(2000);
constexpr double STEP_DURATION = 1.0 / 60.0;
// s of the computer's clock; what is held is repeated several times in it.
constexpr double HOLD = 0.5;

const char* const SET_PARAMETERS = "set_parameters";
const char* const PARAMETER_UPDATES = "parameter_updates";

/// Of the parameters that dynamic_reconfigure knows.
const std::set<std::string> WHOLE_NUMBERS = { "count" };

}  // namespace

WorldClient::WorldClient()
{
  handle_.setCallbackQueue(queue_.get());
  QObject::connect(&timer_, &QTimer::timeout, [this] { poll(); });
  timer_.start(POLL_MS);
}

void WorldClient::connect(const std::string& world)
{
  subscribers_.clear();
  queue_->clear();
  thrust_ = spring_ = ros::Publisher();
  paused_ = false;
  bodies_ = msg::BodyStates();
  parameters_.clear();
  unsent_.clear();
  name_ = world;
  try
  {
    connectTopics(world + "/");
    name_ = handle_.resolveName(world);
  }
  catch (const ros::InvalidNameException& error)
  {
    subscribers_.clear();
    tell(error.what());
  }
}

void WorldClient::connectTopics(const std::string& prefix)
{
  thrust_ = handle_.advertise<msg::Thrust>(prefix + topics::THRUST, COMMAND_QUEUE);
  spring_ = handle_.advertise<msg::SpringForce>(prefix + topics::SPRING, COMMAND_QUEUE);

  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  subscribers_ = { handle_.subscribe(prefix + topics::ENERGY, STATE_QUEUE, &WorldClient::onEnergy, this, hints),
                   handle_.subscribe(prefix + topics::BODIES, 1, &WorldClient::onBodies, this, hints),
                   handle_.subscribe(prefix + topics::INPUTS, STATE_QUEUE, &WorldClient::onInput, this, hints),
                   handle_.subscribe(prefix + topics::PAUSED, 1, &WorldClient::onPaused, this, hints),
                   handle_.subscribe(prefix + PARAMETER_UPDATES, 1, &WorldClient::onParameters, this, hints) };

  pause_.connect(handle_, prefix + topics::PAUSE, queue_);
  reset_.connect(handle_, prefix + topics::RESET, queue_);
  step_.connect(handle_, prefix + topics::STEP, queue_);
  set_state_.connect(handle_, prefix + topics::SET_STATE, queue_);
  set_parameters_.connect(handle_, prefix + SET_PARAMETERS, queue_);
}

void WorldClient::poll()
{
  queue_->callAvailable();
  pause_.expire(PATIENCE);
  reset_.expire(PATIENCE);
  step_.expire(PATIENCE);
  set_state_.expire(PATIENCE);
  set_parameters_.expire(PATIENCE);
}

std::string WorldClient::name() const
{
  return name_;
}

bool WorldClient::isThere() const
{
  return !subscribers_.empty() && subscribers_.front().getNumPublishers() > 0;
}

bool WorldClient::isPaused() const
{
  return paused_;
}

const msg::BodyStates& WorldClient::bodies() const
{
  return bodies_;
}

void WorldClient::onEnergy(const msg::Energy::ConstPtr& message)
{
  if (on_energy)
    on_energy(*message);
}

void WorldClient::onBodies(const msg::BodyStates::ConstPtr& message)
{
  bodies_ = *message;
}

void WorldClient::onInput(const msg::Input::ConstPtr& message)
{
  if (on_input)
    on_input(*message);
}

void WorldClient::onPaused(const std_msgs::Bool::ConstPtr& message)
{
  paused_ = message->data;
}

/// While the user's own change is on its way, what the world says is older than what the user sees.
void WorldClient::onParameters(const dynamic_reconfigure::Config::ConstPtr& message)
{
  if (set_parameters_.isFree())
    takeParameters(*message);
}

void WorldClient::takeParameters(const dynamic_reconfigure::Config& config)
{
  for (const dynamic_reconfigure::DoubleParameter& parameter : config.doubles)
    parameters_[parameter.name] = parameter.value;
  for (const dynamic_reconfigure::IntParameter& parameter : config.ints)
    parameters_[parameter.name] = parameter.value;
  if (on_parameters)
    on_parameters(parameters_);
}

void WorldClient::setParameter(const std::string& name, double value)
{
  unsent_[name] = value;
  if (set_parameters_.isFree())
    sendParameters();
}

void WorldClient::sendParameters()
{
  dynamic_reconfigure::Reconfigure::Request request;
  for (const auto& [name, value] : unsent_)
  {
    if (WHOLE_NUMBERS.count(name) > 0)
    {
      request.config.ints.emplace_back();
      request.config.ints.back().name = name;
      request.config.ints.back().value = static_cast<int>(std::lround(value));
    }
    else
    {
      request.config.doubles.emplace_back();
      request.config.doubles.back().name = name;
      request.config.doubles.back().value = value;
    }
  }
  unsent_.clear();
  set_parameters_.start(request, [this](const dynamic_reconfigure::Reconfigure::Response* response) {
    if (!response)
      tell("no answer from " + name_ + "/" + SET_PARAMETERS);
    if (!unsent_.empty())
      sendParameters();
    else if (response)
      takeParameters(response->config);
    else if (on_parameters)
      on_parameters(parameters_);
  });
}

double WorldClient::holdTime() const
{
  const auto factor = parameters_.find("real_time_factor");
  return HOLD * (factor == parameters_.end() ? 1.0 : std::max(factor->second, 1.0));
}

void WorldClient::thrust(const std::string& body, const std::vector<double>& levels)
{
  msg::Thrust message;
  message.body = body;
  message.levels = levels;
  const bool on = std::any_of(levels.begin(), levels.end(), [](double level) { return level > 0.0; });
  message.duration = on ? holdTime() : 0.0;
  if (thrust_)
    thrust_.publish(message);
}

void WorldClient::pull(const std::string& body, const geometry_msgs::Point& attach, const geometry_msgs::Point& anchor)
{
  msg::SpringForce message;
  message.active = true;
  message.body = body;
  message.attach = attach;
  message.anchor = anchor;
  message.duration = holdTime();
  if (spring_)
    spring_.publish(message);
}

void WorldClient::release(const std::string& body)
{
  msg::SpringForce message;
  message.body = body;
  if (spring_)
    spring_.publish(message);
}

void WorldClient::togglePause()
{
  std_srvs::SetBool::Request request;
  request.data = !paused_;
  call(pause_, request);
}

void WorldClient::reset()
{
  call(reset_, std_srvs::Trigger::Request());
}

void WorldClient::step()
{
  msg::Step::Request request;
  request.duration = STEP_DURATION;
  call(step_, request);
}

template <class Service>
void WorldClient::call(ServiceCall<Service>& service, const typename Service::Request& request)
{
  if (!service.isFree())
    return;
  service.start(request, [this](const typename Service::Response* response) {
    tell(response ? response->message : "no answer from " + name_);
  });
}

bool WorldClient::setState(const msg::BodyState& state, const std::function<void(bool)>& on_answer)
{
  if (!set_state_.isFree())
    return false;
  SetState::Request request;
  request.state = state;
  set_state_.start(request, [this, on_answer](const SetState::Response* response) {
    tell(response ? response->message : "no answer from " + name_);
    on_answer(response && response->success);
  });
  return true;
}

void WorldClient::tell(const std::string& text) const
{
  if (on_answer && !text.empty())
    on_answer(QString::fromStdString(text));
}

}  // namespace block_world
