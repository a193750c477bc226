// Runs of simulate, judged by the checker, which shares no code with the engine: its exit status is the verdict.

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace
{
struct Case
{
  const char* scene;  // below the source directory
  const char* duration;
};

std::string shell(const std::filesystem::path& path)
{
  return "'" + path.string() + "'";
}

class Judged : public testing::TestWithParam<Case>
{
};

TEST_P(Judged, PassesTheChecker)
{
  namespace fs = std::filesystem;
  const fs::path scene = fs::path(BLOCK_WORLD_DIR) / GetParam().scene;
  const fs::path folder = fs::temp_directory_path() / ("judged_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string files = " --states " + shell(folder / "states.csv") + " --energy " + shell(folder / "energy.csv") +
                            " --contacts " + shell(folder / "contacts.csv");
  const std::string simulate = std::string(BLOCK_WORLD_SIMULATE) + " " + shell(scene) + " --duration " + GetParam().duration +
                               " --sample 0.001" + files + " 2> " + shell(folder / "log");
  const std::string checker = std::string(BLOCK_WORLD_CHECKER) + " " + shell(scene) + files + " --summary " + shell(folder / "log");
  EXPECT_EQ(std::system(simulate.c_str()), 0);
  EXPECT_EQ(std::system(checker.c_str()), 0);
  fs::remove_all(folder);
}

const Case cases[] = {
  { "config/scenes/six_blocks.yaml", "20" },         { "config/scenes/contact_forces.yaml", "20" },
  { "config/scenes/springs.yaml", "10" },            { "config/scenes/drop.yaml", "5" },
  { "config/scenes/stack.yaml", "5" },               { "config/scenes/cradle.yaml", "5" },
  { "config/scenes/table_slide.yaml", "3" },         { "config/scenes/ladder.yaml", "3" },
  { "test/scenes/stack_knocked_over.yaml", "30" },
};

std::string nameOf(const testing::TestParamInfo<Case>& info)
{
  return std::filesystem::path(info.param.scene).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Scenes, Judged, testing::ValuesIn(cases), nameOf);

TEST(Campaign, OneStartOfEachKind)
{
  const std::string command = std::string("/usr/bin/python3 '") + BLOCK_WORLD_DIR + "/test/campaign/six_blocks_campaign.py' --simulate '" +
                              BLOCK_WORLD_SIMULATE + "' --checker '" + BLOCK_WORLD_CHECKER + "' --starts 1 --jobs 2";
  EXPECT_EQ(std::system(command.c_str()), 0);
}
}  // namespace
