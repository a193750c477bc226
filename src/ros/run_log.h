#pragma once

#include <rosbag/bag.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "messages.h"

namespace block_world
{
/// A bag that cannot be replayed; what() names it and says why.
class RunLogError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What a bag tells of one world's run: the commands, and the states to compare with.
class RunLog
{
public:
  /// node: which world, where the bag has several. Throws RunLogError.
  RunLog(const std::string& path, const std::string& node);

  /// Commands without gaps in the order of their index; the first one is a scene or a restored state.
  const std::vector<msg::Input>& inputs() const
  {
    return inputs_;
  }

  /// Goes through the states in the order in which the node sent them, until told to stop. Throws RunLogError.
  void eachState(const std::function<bool(const msg::BodyStates&)>& look) const;

  /// Name of the node, with its namespace.
  const std::string& node() const
  {
    return node_;
  }
  const std::string& path() const
  {
    return path_;
  }

private:
  void open();
  void chooseNode();
  void checkVersion(const std::string& topic, const std::string& type, const std::string& md5) const;
  void readInputs();
  [[noreturn]] void refuse(const std::string& reason) const;

  std::string path_, node_;
  rosbag::Bag bag_;
  std::vector<msg::Input> inputs_;
};

}  // namespace block_world
