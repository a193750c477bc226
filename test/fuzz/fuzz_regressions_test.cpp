#include "fuzz.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

// Inputs that the fuzz targets once failed on, each named after what was wrong.

namespace block_world
{
namespace
{
namespace files = std::filesystem;

std::vector<std::string> inputsFor(const std::string& target)
{
  std::vector<std::string> found;
  for (const auto& entry : files::directory_iterator(std::string(BLOCK_WORLD_DIR) + "/test/fuzz/regressions/" + target))
    found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string caseName(const testing::TestParamInfo<std::string>& info)
{
  return files::path(info.param).stem().string();
}

class SceneInput : public testing::TestWithParam<std::string>
{
};
class CommandInput : public testing::TestWithParam<std::string>
{
};

template <class Run>
void replay(const std::string& path, const Run& run)
{
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path;
  const std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  EXPECT_EQ(run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), "");
}

TEST_P(SceneInput, IsRefusedOrRuns)
{
  replay(GetParam(), fuzz::runScene);
}

TEST_P(CommandInput, KeepsWhatHolds)
{
  replay(GetParam(), fuzz::runCommands);
}

INSTANTIATE_TEST_SUITE_P(Regressions, SceneInput, testing::ValuesIn(inputsFor("scene")), caseName);
INSTANTIATE_TEST_SUITE_P(Regressions, CommandInput, testing::ValuesIn(inputsFor("commands")), caseName);

}  // namespace
}  // namespace block_world
