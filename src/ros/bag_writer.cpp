#include "bag_writer.h"

#include <boost/make_shared.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace block_world
{
namespace
{
// Bytes; what is not yet in a complete chunk is lost where the program is killed. Some tenths of a second of six
// blocks.
constexpr std::uint32_t CHUNK = 128 * 1024;
}  // namespace

BagWriter::BagWriter(const std::string& path, const std::string& caller)
  : path_(path), active_(path + ".active"), caller_(caller)
{
  try
  {
    bag_.open(active_, rosbag::bagmode::Write);
    bag_.setChunkThreshold(CHUNK);
  }
  catch (const rosbag::BagException& error)
  {
    throw std::runtime_error(describe(error.what()));
  }
  open_ = true;
}

BagWriter::~BagWriter()
{
  try
  {
    close();
  }
  catch (const std::runtime_error& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
  }
}

boost::shared_ptr<ros::M_string> BagWriter::connection(const std::string& topic, const char* type, const char* md5,
                                                       const char* definition, bool latched) const
{
  const auto header = boost::make_shared<ros::M_string>();
  *header = { { "topic", topic },      { "type", type },
              { "md5sum", md5 },       { "message_definition", definition },
              { "callerid", caller_ }, { "latching", latched ? "1" : "0" } };
  return header;
}

void BagWriter::close()
{
  if (!open_)
    return;
  open_ = false;
  try
  {
    bag_.close();
  }
  catch (const rosbag::BagException& error)
  {
    if (error_.empty())
      error_ = describe(error.what());
  }
  if (error_.empty() && std::rename(active_.c_str(), path_.c_str()) != 0)
    error_ = describe(std::string("cannot be given this name: ") + std::strerror(errno));
  if (!error_.empty())
    throw std::runtime_error(error_);
}

std::string BagWriter::describe(const std::string& reason) const
{
  return path_ + ": the bag cannot be written: " + reason;
}

}  // namespace block_world
