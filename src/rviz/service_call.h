#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <boost/make_shared.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace block_world
{
/// Calls a service without making the caller wait. The call runs in a thread of its own, which may hang for as long as
/// the other side does; the answer comes through a callback queue, in the thread that works on that queue.
template <class Service>
class ServiceCall
{
public:
  using Response = typename Service::Response;
  /// Gets nothing where there was no answer.
  using Answer = std::function<void(const Response*)>;

  void connect(ros::NodeHandle& handle, const std::string& name, const std::shared_ptr<ros::CallbackQueue>& queue)
  {
    client_ = handle.serviceClient<Service>(name);
    queue_ = queue;
    current_ = boost::make_shared<Call>();
  }

  /// One call at a time: false while an answer is to come.
  bool isFree() const
  {
    return !current_->answer;
  }

  void start(const typename Service::Request& request, const Answer& answer)
  {
    current_ = boost::make_shared<Call>();
    current_->service.request = request;
    current_->answer = answer;
    started_ = std::chrono::steady_clock::now();
    std::thread(&ServiceCall::run, client_, current_, queue_).detach();
  }

  /// Gives up on a call that has had no answer for so long.
  void expire(std::chrono::milliseconds patience)
  {
    if (!isFree() && std::chrono::steady_clock::now() > started_ + patience)
      current_->finish(nullptr);
  }

private:
  struct Call : public ros::CallbackInterface
  {
    CallResult call() override
    {
      finish(answered ? &service.response : nullptr);
      return Success;
    }

    /// An answer that comes after one has been given up on is passed over.
    void finish(const Response* response)
    {
      Answer once;
      std::swap(once, answer);
      if (once)
        once(response);
    }

    Service service;
    Answer answer;
    bool answered = false;
  };

  static void run(ros::ServiceClient client, boost::shared_ptr<Call> call, std::shared_ptr<ros::CallbackQueue> queue)
  {
    call->answered = client.call(call->service);
    queue->addCallback(call);
  }

  ros::ServiceClient client_;
  std::shared_ptr<ros::CallbackQueue> queue_;
  boost::shared_ptr<Call> current_ = boost::make_shared<Call>();
  std::chrono::steady_clock::time_point started_;
};

}  // namespace block_world
