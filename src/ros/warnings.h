#pragma once

#include <chrono>
#include <map>
#include <string>

namespace block_world
{
/// Warnings about bad input, once per kind and second of the computer's clock. (ROS_WARN_THROTTLE counts in simulated
/// time, which stands still in a paused world.)
class Warnings
{
public:
  /// Kinds must be few: each is remembered.
  void warn(const std::string& kind, const std::string& text);

private:
  struct Kind
  {
    std::chrono::steady_clock::time_point last;
    long held_back = 0;
  };
  std::map<std::string, Kind> kinds_;
};

}  // namespace block_world
