#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>

#include <map>
#include <stdexcept>
#include <string>

namespace block_world
{
/// A bag file that is being written. Like rosbag record it is called PATH.active until it is complete; if the program
/// is killed before, rosbag reindex makes use of what was written.
class BagWriter
{
public:
  /// caller: the name of the node that the messages are from. Throws std::runtime_error where the file cannot be
  /// written.
  BagWriter(const std::string& path, const std::string& caller);
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;

  /// Where this fails, the rest is left out and error() says why.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message, bool latched)
  {
    namespace traits = ros::message_traits;
    if (!error_.empty())
      return;
    boost::shared_ptr<ros::M_string>& header = headers_[topic];
    if (!header)
      header = connection(topic, traits::datatype<Message>(), traits::md5sum<Message>(), traits::definition<Message>(),
                          latched);
    try
    {
      bag_.write(topic, time, message, header);
    }
    catch (const rosbag::BagException& error)
    {
      error_ = describe(error.what());
    }
  }

  const std::string& error() const
  {
    return error_;
  }

  /// Gives the complete file its name. Throws std::runtime_error where it could not be written.
  void close();

  const std::string& path() const
  {
    return path_;
  }

private:
  boost::shared_ptr<ros::M_string> connection(const std::string& topic, const char* type, const char* md5,
                                              const char* definition, bool latched) const;
  std::string describe(const std::string& reason) const;

  std::string path_, active_, caller_, error_;
  rosbag::Bag bag_;
  std::map<std::string, boost::shared_ptr<ros::M_string>> headers_;  ///< by topic: what rosbag play goes by
  bool open_ = false;
};

}  // namespace block_world
