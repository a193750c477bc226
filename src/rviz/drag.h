#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>

#include "world_client.h"

namespace block_world
{
/// What the mouse holds: in a running world a spring from a block to the mouse, in a paused one the block itself.
class Drag
{
public:
  explicit Drag(WorldClient& world);

  bool isIdle() const;
  void press(const Eigen::Vector2d& point);
  void move(const Eigen::Vector2d& point, bool rotate);
  void release();

  /// Repeats what would end by itself. To be called several times in the world's hold time.
  void refresh();

  /// Tells which block was picked.
  void onInput(const msg::Input& input);

private:
  enum class Holds
  {
    Nothing,
    Spring,
    Block
  };

  void moveBlock(const Eigen::Vector2d& point, bool rotate);
  void sendPull();
  void sendState();

  WorldClient& world_;
  Holds holds_ = Holds::Nothing;
  geometry_msgs::Point mouse_;
  /// The world picks the block nearest to the press and answers with an input that repeats the point of the press.
  std::optional<geometry_msgs::Point> asked_;
  std::string body_;  ///< empty until picked
  geometry_msgs::Point attach_;
  msg::BodyState goal_;
  bool goal_sent_ = true;
};

}  // namespace block_world
