#include "warnings.h"

#include <ros/console.h>

namespace block_world
{
void Warnings::warn(const std::string& kind, const std::string& text)
{
  const auto now = std::chrono::steady_clock::now();
  const auto found = kinds_.find(kind);
  if (found != kinds_.end() && now - found->second.last < std::chrono::seconds(1))
  {
    ++found->second.held_back;
    return;
  }
  Kind& entry = kinds_[kind];
  if (entry.held_back > 0)
    ROS_WARN_STREAM(text << " (and " << entry.held_back << " more of this kind before)");
  else
    ROS_WARN_STREAM(text);
  entry.last = now;
  entry.held_back = 0;
}

}  // namespace block_world
