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

// No true course stalls; an engine that takes no more than 100 events within 1e-12 s for true does where 500 hits come.
TEST(Stall, EndsSimulateAndIsExplained)
{
  const fs::path folder = fs::temp_directory_path() / ("campaign_stall_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "storm.yaml")
      << "tolerance: 1.0e-12\nwalls: {left: -0.500000001, right: 0.500000001}\n"
         "blocks: [{name: rattler, size: [1, 1], pose: [0, 0, 0], velocity: [1.0e+6, 0, 0]}, {pose: [0, 5, 0]}]\n";
  const fs::path simulate = fs::path(BLOCK_WORLD_CAMPAIGN).parent_path() / "simulate_time_stops";
  const std::string command = shell(simulate) + " " + shell(folder / "storm.yaml") + " --states /dev/null 2> " +
                              shell(folder / "errors");
  const int status = std::system(command.c_str());
  std::ifstream file(folder / "errors");
  std::string summary, reason;
  std::getline(file, summary);
  std::getline(file, reason);
  fs::remove_all(folder);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 1);
  const std::string stall = "stalled at 'rattler': 100 events within 1e-12 s, ";
  EXPECT_EQ(summary.find("summary: simulated_s="), 0u) << summary;
  EXPECT_NE(summary.find("mode=" + stall), std::string::npos) << summary;
  EXPECT_EQ(reason.find("simulate: " + stall), 0u) << reason;
  EXPECT_NE(reason.find(" % impacts"), std::string::npos) << reason;
}
}  // namespace
