#pragma once

#include <block_world/BlockWorldConfig.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <boost/thread/recursive_mutex.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace block_world
{
/// The private parameters that may be changed while the node runs, by dynamic_reconfigure.
///
/// The server writes all of its values to the parameter server. What it has written there goes when the node goes, and
/// what was there before is put back: the next node begins with its own scene's values.
class LiveParameters
{
public:
  /// Makes of the values asked for those that hold from now on.
  using Change = std::function<void(BlockWorldConfig& values)>;

  LiveParameters(const ros::NodeHandle& handle, const BlockWorldConfig& values, const Change& change);
  ~LiveParameters();

  /// The values have changed by other means.
  void update(const BlockWorldConfig& values);

private:
  void remember();

  ros::NodeHandle handle_;
  std::map<std::string, std::unique_ptr<XmlRpc::XmlRpcValue>> before_;  ///< null: there was none
  boost::recursive_mutex mutex_;
  std::unique_ptr<dynamic_reconfigure::Server<BlockWorldConfig>> server_;
};

}  // namespace block_world
