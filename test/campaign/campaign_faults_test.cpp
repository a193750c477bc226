// That the campaign can fail: engines with one deliberate fault each (CMakeLists.txt), which a few of its seeds must
// find. The same seeds pass with the engine as it is.

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace
{
namespace fs = std::filesystem;

struct Fault
{
  const char* name;   // of the engine; empty: none
  const char* check;  // one that must find it
  int first, count;   // seeds
};

struct Outcome
{
  int status = -1;
  std::string report;
};

std::string shell(const fs::path& path)
{
  return "'" + path.string() + "'";
}

Outcome runCampaign(const std::string& fault, int first, int count)
{
  const fs::path folder = fs::temp_directory_path() / ("campaign_faults_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string suffix = fault.empty() ? "" : "_" + fault;
  // The faulty programs lie beside the campaign.
  const fs::path built = fs::path(BLOCK_WORLD_CAMPAIGN).parent_path();
  const fs::path simulate = fault.empty() ? fs::path(BLOCK_WORLD_SIMULATE) : built / ("simulate" + suffix);
  const std::string command = shell(built / ("campaign" + suffix)) + " --first " + std::to_string(first) + " --count " +
                              std::to_string(count) + " --jobs 2 --longest 2 --cpu 5 --save " +
                              shell(folder / "failing") + " --simulate " + shell(simulate) + " --checker " +
                              shell(BLOCK_WORLD_CHECKER) + " > " + shell(folder / "report");
  const int status = std::system(command.c_str());
  std::ifstream file(folder / "report");
  std::ostringstream text;
  text << file.rdbuf();
  fs::remove_all(folder);
  return { WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str() };
}

class Faults : public testing::TestWithParam<Fault>
{
};

TEST_P(Faults, AreFound)
{
  const Fault& fault = GetParam();
  const Outcome faulty = runCampaign(fault.name, fault.first, fault.count);
  EXPECT_EQ(faulty.status, 1) << faulty.report;
  EXPECT_NE(faulty.report.find(std::string("  ") + fault.check), std::string::npos) << faulty.report;
  const Outcome sound = runCampaign("", fault.first, fault.count);
  EXPECT_EQ(sound.status, 0) << sound.report;
}

const Fault faults[] = {
  { "pair_skipped", "overlap", 9, 4 },
  { "impulse_wrong", "checker.impact.restitution", 8, 3 },
  { "island_frozen", "energy.balance", 3, 1 },
  { "capture_greedy", "checker.contact.sign", 12, 5 },
};

std::string nameOf(const testing::TestParamInfo<Fault>& info)
{
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Engines, Faults, testing::ValuesIn(faults), nameOf);
}  // namespace
