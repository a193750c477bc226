#include "run_log.h"

#include <rosbag/view.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "topics.h"

namespace block_world
{
namespace
{
bool startsWorld(const msg::Input& input)
{
  return input.kind == msg::Input::LOAD_SCENE || input.kind == msg::Input::RESTORE;
}

/// The node that a topic is private to.
std::string nodeOf(const std::string& topic)
{
  return topic.substr(0, topic.rfind('/'));
}
}  // namespace

RunLog::RunLog(const std::string& path, const std::string& node) : path_(path), node_(node)
{
  open();
  chooseNode();
  readInputs();
}

void RunLog::refuse(const std::string& reason) const
{
  throw RunLogError(path_ + ": " + reason);
}

void RunLog::open()
{
  errno = 0;
  std::ifstream file(path_, std::ios::binary);
  if (!file)
    refuse(std::string("cannot be opened: ") + std::strerror(errno));
  std::string start(7, ' ');
  file.read(&start[0], static_cast<std::streamsize>(start.size()));
  if (!file || start != "#ROSBAG")
    refuse("is no bag");
  try
  {
    bag_.open(path_, rosbag::bagmode::Read);
  }
  catch (const rosbag::BagException& error)
  {
    refuse("the bag was cut or never finished (" + std::string(error.what()) +
           "): make what there is readable with: rosbag reindex " + path_);
  }
}

void RunLog::checkVersion(const std::string& topic, const std::string& type, const std::string& md5) const
{
  const bool is_input = type == ros::message_traits::datatype<msg::Input>();
  const std::string own =
      is_input ? ros::message_traits::md5sum<msg::Input>() : ros::message_traits::md5sum<msg::BodyStates>();
  if (md5 != own)
    refuse(topic + " has " + type + " in another version: its md5 is " + md5 + ", this program's is " + own);
}

void RunLog::chooseNode()
{
  std::set<std::string> nodes;
  rosbag::View all(bag_);
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    if (connection->datatype == ros::message_traits::datatype<msg::Input>())
      nodes.insert(nodeOf(connection->topic));
  if (nodes.empty())
    refuse("holds no commands: neither ~inputs, from which to run it, nor the scene in it");
  std::string names;
  for (const std::string& name : nodes)
    names += (names.empty() ? "" : ", ") + name;
  if (node_.empty() && nodes.size() > 1)
    refuse("holds several worlds; choose one with --world: " + names);
  if (!node_.empty() && nodes.count(node_) == 0)
    refuse("there is no world " + node_ + "; there is " + names);
  node_ = node_.empty() ? *nodes.begin() : node_;
  bool has_states = false;
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
  {
    const bool is_states = connection->topic == node_ + "/" + topics::BODIES;
    has_states = has_states || is_states;
    if (is_states || connection->topic == node_ + "/" + topics::INPUTS)
      checkVersion(connection->topic, connection->datatype, connection->md5sum);
  }
  if (!has_states)
    refuse("holds no states to compare with: " + node_ + "/" + topics::BODIES);
}

void RunLog::readInputs()
{
  try
  {
    rosbag::View view(bag_, rosbag::TopicQuery(node_ + "/" + topics::INPUTS));
    for (const rosbag::MessageInstance& message : view)
      inputs_.push_back(*message.instantiate<msg::Input>());
  }
  catch (const ros::Exception& error)
  {
    refuse(std::string("cannot be read: ") + error.what());
  }
  const auto earlier = [](const msg::Input& a, const msg::Input& b) { return a.index < b.index; };
  std::stable_sort(inputs_.begin(), inputs_.end(), earlier);
  // A recorder that subscribed twice was told twice where the world comes from.
  const auto same = [this](const msg::Input& a, const msg::Input& b) {
    if (a.index == b.index && (a.kind != b.kind || a.time_ns != b.time_ns || a.text != b.text || a.data != b.data))
      refuse("holds more than one run of " + node_ + ": two commands are number " + std::to_string(a.index));
    return a.index == b.index;
  };
  inputs_.erase(std::unique(inputs_.begin(), inputs_.end(), same), inputs_.end());
  inputs_.erase(inputs_.begin(), std::find_if(inputs_.begin(), inputs_.end(), startsWorld));
  if (inputs_.empty())
    refuse("no scene: " + node_ + "/" + topics::INPUTS + " has neither LOAD_SCENE nor RESTORE to begin with");
  for (std::size_t i = 1; i < inputs_.size(); ++i)
    if (inputs_[i].index != inputs_[i - 1].index + 1)
      refuse("commands " + std::to_string(inputs_[i - 1].index + 1) + " to " + std::to_string(inputs_[i].index - 1) +
             " are missing, as where the recording began too late");
}

void RunLog::eachState(const std::function<bool(const msg::BodyStates&)>& look) const
{
  try
  {
    rosbag::View view(bag_, rosbag::TopicQuery(node_ + "/" + topics::BODIES));
    for (const rosbag::MessageInstance& message : view)
      if (!look(*message.instantiate<msg::BodyStates>()))
        return;
  }
  catch (const ros::Exception& error)
  {
    refuse(std::string("cannot be read: ") + error.what());
  }
}

}  // namespace block_world
