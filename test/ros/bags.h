#pragma once

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "messages.h"

// Bags for tests, and the programs that work on them.
namespace block_world
{
struct Outcome
{
  int status = -1;
  std::string text;  ///< standard output and error
};

inline Outcome runCommand(const std::string& command)
{
  Outcome outcome;
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline Outcome replay(const std::string& bag, const std::string& options = "")
{
  return runCommand(std::string(BLOCK_WORLD_REPLAY) + " '" + bag + "' " + options);
}

inline bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// Copies a bag message by message; change may alter an input, or leave it out by returning false.
inline void copyBag(const std::string& from, const std::string& to, const std::function<bool(msg::Input&)>& change)
{
  rosbag::Bag source(from), target(to, rosbag::bagmode::Write);
  for (const rosbag::MessageInstance& message : rosbag::View(source))
  {
    const msg::Input::ConstPtr input = message.instantiate<msg::Input>();
    if (!input)
    {
      target.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
      continue;
    }
    msg::Input changed = *input;
    if (change(changed))
      target.write(message.getTopic(), message.getTime(), changed, message.getConnectionHeader());
  }
}

}  // namespace block_world
