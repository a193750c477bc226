#include "drag.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
geometry_msgs::Point toPoint(const Eigen::Vector2d& point)
{
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  return message;
}

/// Angle from one direction to another.
double turn(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

}  // namespace

Drag::Drag(WorldClient& world) : world_(world)
{
}

bool Drag::isIdle() const
{
  return holds_ == Holds::Nothing;
}

void Drag::press(const Eigen::Vector2d& point)
{
  release();
  holds_ = world_.isPaused() ? Holds::Block : Holds::Spring;
  mouse_ = toPoint(point);
  asked_ = mouse_;
  world_.pull("", geometry_msgs::Point(), mouse_);
}

void Drag::onInput(const msg::Input& input)
{
  if (!asked_ || input.kind != msg::Input::SPRING || input.from_scene || !input.spring.active ||
      input.spring.anchor.x != asked_->x || input.spring.anchor.y != asked_->y)
    return;
  const Eigen::Vector2d now(mouse_.x, mouse_.y);
  mouse_ = *asked_;
  asked_.reset();
  if (holds_ != Holds::Spring)
    world_.release(input.spring.body);  // the spring was only to pick; or the mouse was let go before the answer
  if (holds_ == Holds::Nothing)
    return;
  body_ = input.spring.body;
  attach_ = input.spring.attach;
  for (const msg::BodyState& state : world_.bodies().bodies)
    if (state.name == body_)
      goal_ = state;
  move(now, false);
}

void Drag::move(const Eigen::Vector2d& point, bool rotate)
{
  if (holds_ == Holds::Block)
    moveBlock(point, rotate);
  mouse_ = toPoint(point);
  if (holds_ == Holds::Spring && !body_.empty())
    sendPull();
}

void Drag::moveBlock(const Eigen::Vector2d& point, bool rotate)
{
  // What is gone on by itself is no longer the user's to put somewhere.
  if (!world_.isPaused())
    return release();
  const Eigen::Vector2d before(mouse_.x, mouse_.y), centre(goal_.x, goal_.y);
  if (body_.empty() || goal_.name != body_ || point == before)
    return;
  if (rotate)
  {
    goal_.angle += turn(before - centre, point - centre);
  }
  else
  {
    goal_.x += point.x() - before.x();
    goal_.y += point.y() - before.y();
  }
  goal_sent_ = false;
  sendState();
}

/// Where the block would overlap the world refuses, and the block stays where it is until the mouse is in a free place.
void Drag::sendState()
{
  if (!goal_sent_ && world_.isPaused())
    goal_sent_ = world_.setState(goal_, [this](bool) { sendState(); });
}

void Drag::sendPull()
{
  world_.pull(body_, attach_, mouse_);
}

void Drag::refresh()
{
  if (holds_ == Holds::Spring && !body_.empty())
    sendPull();
}

void Drag::release()
{
  if (holds_ == Holds::Spring && !body_.empty())
    world_.release(body_);
  holds_ = Holds::Nothing;
  body_.clear();
}

}  // namespace block_world
