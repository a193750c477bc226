#include <ros/ros.h>

#include <csignal>
#include <memory>

#include "node.h"
#include "parameters.h"

namespace
{
std::unique_ptr<block_world::Node> makeNode(const ros::NodeHandle& handle)
{
  const block_world::Parameters parameters = block_world::readParameters(handle);
  for (const std::string& name : block_world::unknownParameters(handle))
    ROS_WARN_STREAM("unknown parameter " << name << ": not used");
  const block_world::SceneSource source = block_world::readSource(parameters);
  return std::make_unique<block_world::Node>(handle, parameters, source,
                                             block_world::buildScene(source, parameters.count, parameters.set));
}

void endNode(int)
{
  block_world::Node::end();
}
}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "block_world");
  // Outlives the try: with the last handle gone, ROS would be shut down and its log closed.
  const ros::NodeHandle handle("~");
  std::unique_ptr<block_world::Node> node;
  try
  {
    node = makeNode(handle);
  }
  catch (const std::runtime_error& error)
  {
    // A parameter or a scene: the text names it, the place in it and the reason.
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  // From here on signals end the loop and not ROS, so that the node can tidy up while it is still connected.
  std::signal(SIGINT, endNode);
  std::signal(SIGTERM, endNode);
  node->run();
  return 0;
}
