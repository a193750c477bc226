#include "saved_state.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace block_world
{
namespace
{
constexpr std::int64_t SECOND = 1000000000;  // ns

struct Close
{
  void operator()(std::FILE* file) const
  {
    std::fclose(file);
  }
};
using File = std::unique_ptr<std::FILE, Close>;

File open(const std::string& path, const char* mode)
{
  File file(std::fopen(path.c_str(), mode));
  if (!file)
    throw std::runtime_error(std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}
}  // namespace

RestoredWorld restoreNotBefore(const std::string& saved, std::int64_t time_ns)
{
  const Time then = World::restore(saved).now();
  const std::int64_t then_ns = then.nanoseconds();
  if (Time::fromNanoseconds(then_ns) != then)
    throw std::runtime_error("the state was saved at no whole nanosecond, which a node cannot do with");
  const std::int64_t span = time_ns - then_ns;
  const std::int64_t seconds = span / SECOND + (span % SECOND > 0 ? 1 : 0);  // rounded up
  return { World::restore(saved, seconds), then_ns + seconds * SECOND };
}

std::string readFile(const std::string& path)
{
  const File file = open(path, "rb");
  std::string bytes;
  char buffer[65536];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get()))
    bytes.append(buffer, count);
  if (std::ferror(file.get()))
    throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  return bytes;
}

void writeFile(const std::string& path, const std::string& bytes)
{
  const std::string unfinished = path + ".active";
  File file = open(unfinished, "wb");
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  if (std::fclose(file.release()) != 0 || !written || std::rename(unfinished.c_str(), path.c_str()) != 0)
  {
    const int error = errno;
    std::remove(unfinished.c_str());
    throw std::runtime_error(std::string("cannot be written: ") + std::strerror(error));
  }
}

}  // namespace block_world
