// Runs the program simulate: exit status, files, columns, sample times, summary.

#include <gtest/gtest.h>

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

using Row = std::vector<std::string>;

std::string contents(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<Row> rowsOf(const std::string& csv)
{
  std::vector<Row> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);)
  {
    Row row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      row.push_back(cell);
    rows.push_back(row);
  }
  return rows;
}

std::string lastLine(const std::string& text)
{
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

/// A run of the program in a folder of its own.
class Simulate : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string pattern = testing::TempDir() + "simulate_XXXXXX";
    ASSERT_NE(mkdtemp(&pattern[0]), nullptr);
    folder_ = pattern;
  }
  void TearDown() override
  {
    fs::remove_all(folder_);
  }

  std::string path(const std::string& name) const
  {
    return folder_ + "/" + name;
  }

  /// Runs simulate with a shipped scene, or none, and other arguments.
  void run(const std::string& scene, const std::string& arguments = "")
  {
    const std::string file = scene.empty() ? "" : std::string(BLOCK_WORLD_DIR) + "/config/scenes/" + scene + ".yaml";
    runWith(file + " " + arguments);
  }
  void runWith(const std::string& arguments)
  {
    const std::string command = program() + " " + arguments + " > " + path("out") + " 2> " + path("err");
    const int result = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(result)) << command;
    status_ = WEXITSTATUS(result);
    out_ = contents(path("out"));
    err_ = contents(path("err"));
  }

  void expectRefused(const std::string& arguments, const std::string& message)
  {
    runWith(arguments);
    EXPECT_EQ(status_, 2) << arguments;
    EXPECT_EQ(err_, message + "\n");
    EXPECT_EQ(out_, "") << arguments;
  }

  int status_ = -1;
  std::string out_, err_;

private:
  static std::string program()
  {
#ifdef BLOCK_WORLD_SIMULATE
    return BLOCK_WORLD_SIMULATE;
#else
    return (fs::read_symlink("/proc/self/exe").parent_path() / "simulate").string();
#endif
  }

  std::string folder_;
};

TEST_F(Simulate, RefusesBadArguments)
{
  const std::string drop = std::string(BLOCK_WORLD_DIR) + "/config/scenes/drop.yaml";
  expectRefused("", "simulate: which scene? usage: simulate SCENE.yaml [options], see --help");
  expectRefused("/no/such.yaml", "/no/such.yaml: cannot be read: No such file or directory");
  expectRefused(drop + " --duration=-1", "simulate: --duration: must be 0 to 9e9 s, is -1");
  expectRefused(drop + " --duration nan", "simulate: --duration: must be 0 to 9e9 s, is nan");
  expectRefused(drop + " --sample 0", "simulate: --sample: must be 1e-9 s or more, is 0");
  expectRefused(drop + " --tolerance 0", "simulate: --tolerance: must be > 0 and finite, is 0");
  expectRefused(drop + " --tolerance 1", drop + ": tolerance: must be 1e-12 to 1e-2 of the smallest block, here "
                                                "2.5e-13 "
                                                "to 0.0025 m, is 1");
  expectRefused(drop + " --energy /no/such/file", "simulate: /no/such/file: cannot be opened: No such file or "
                                                  "directory");
  expectRefused(drop + " --states /no/such/file", "simulate: /no/such/file: cannot be opened: No such file or "
                                                  "directory");
  for (const std::string wrong : { "--dur 1", "--unknown", "--sample x", "second.yaml", "--duration" })
  {
    runWith(drop + " " + wrong);
    EXPECT_EQ(status_, 2) << wrong;
    EXPECT_EQ(out_, "") << wrong;
    EXPECT_EQ(err_.substr(0, 10), "simulate: ") << wrong;
  }
}

TEST_F(Simulate, RefusesABadScene)
{
  const std::string file = std::string(BLOCK_WORLD_DIR) + "/test/scenes/invalid/mass_negative.yaml";
  expectRefused(file, file + ":6: blocks[1].mass: must be > 0, is -1");
}

TEST_F(Simulate, ADiskThatIsFullIsAFailure)
{
  run("drop", "--duration 1 --states /dev/full");
  EXPECT_EQ(status_, 1);
  EXPECT_EQ(err_, "simulate: /dev/full: cannot be written: No space left on device\n");
}

TEST_F(Simulate, Helps)
{
  runWith("--help");
  EXPECT_EQ(status_, 0);
  for (const char* option : { "SCENE", "--duration", "--sample", "--tolerance", "--states", "--energy", "--contacts", "--verbose" })
    EXPECT_NE(out_.find(option), std::string::npos) << option;
}

TEST_F(Simulate, WritesARowOfStatesPerMovableBlockAndSample)
{
  run("table_slide", "--duration 0.25 --sample 0.1");
  ASSERT_EQ(status_, 0) << err_;
  const std::vector<Row> rows = rowsOf(out_);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0], (Row{ "time", "block", "x", "y", "angle", "vx", "vy", "omega" }));
  EXPECT_EQ(rows[1], (Row{ "0", "box", "-0.5", "1.125", "0", "1", "0", "0" }));
  const std::vector<std::string> times{ "0", "0.10000000000000001", "0.20000000000000001", "0.25" };
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    EXPECT_EQ(rows[i + 1][0], times[i]);
    EXPECT_EQ(rows[i + 1][1], "box");
    EXPECT_EQ(rows[i + 1].size(), 8u);
  }
}

TEST_F(Simulate, LastsTenSecondsAndSamplesEveryTenthByDefault)
{
  run("cradle");
  const std::vector<Row> rows = rowsOf(out_);
  ASSERT_EQ(rows.size(), 1u + 101u * 5u);
  EXPECT_EQ(rows.back()[0], "10");
}

TEST_F(Simulate, SampleTimesAreWholeNanosecondsThatDoNotDrift)
{
  run("drop", "--duration 0.05 --sample 0.016666666666666666");
  const std::vector<Row> rows = rowsOf(out_);
  ASSERT_EQ(rows.size(), 5u);
  const std::vector<double> times{ 0.0, 0.016666667, 0.033333333, 0.05 };
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(std::stod(rows[i + 1][0]), times[i]);
}

TEST_F(Simulate, TheDurationItselfIsTheLastSample)
{
  run("drop", "--duration 0");
  EXPECT_EQ(rowsOf(out_).size(), 2u);
  run("drop", "--duration 0.3 --sample 0.1");
  EXPECT_EQ(rowsOf(out_).size(), 5u);
  run("drop", "--duration 1 --sample 5");
  ASSERT_EQ(rowsOf(out_).size(), 3u);
  EXPECT_EQ(rowsOf(out_).back()[0], "1");
}

TEST_F(Simulate, StatesGoToAFileWhereOneIsNamed)
{
  run("drop", "--duration 1");
  const std::string printed = out_;
  run("drop", "--duration 1 --states " + path("states.csv"));
  EXPECT_EQ(out_, "");
  EXPECT_EQ(contents(path("states.csv")), printed);
}

TEST_F(Simulate, WritesEnergies)
{
  run("drop", "--duration 2 --energy " + path("energy.csv"));
  const std::vector<Row> rows = rowsOf(contents(path("energy.csv")));
  ASSERT_EQ(rows.size(), 22u);
  EXPECT_EQ(rows[0], (Row{ "time", "gravity", "spring", "translational", "rotational", "total", "thrust_work",
                           "spring_work", "command_work", "damping_loss", "impact_loss", "balance_error" }));
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    ASSERT_EQ(rows[i].size(), 12u);
    const auto value = [&](int column) { return std::stod(rows[i][column]); };
    EXPECT_NEAR(value(5), value(1) + value(2) + value(3) + value(4), 1e-12);
    EXPECT_NEAR(value(11), 0.0, 1e-12);
  }
}

TEST_F(Simulate, WritesContactsInTheOrderOfTime)
{
  run("drop", "--duration 2 --contacts " + path("contacts.csv"));
  const std::vector<Row> rows = rowsOf(contents(path("contacts.csv")));
  ASSERT_GT(rows.size(), 10u);
  EXPECT_EQ(rows[0], (Row{ "time", "kind", "a", "b", "x", "y", "nx", "ny", "normal_velocity", "impulse" }));
  double last = 0.0, force = 0.0;
  int impacts = 0, begins = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    ASSERT_EQ(rows[i].size(), 10u);
    EXPECT_GE(std::stod(rows[i][0]), last);
    last = std::stod(rows[i][0]);
    const std::string& kind = rows[i][1];
    impacts += kind == "impact";
    begins += kind == "rest_begin";
    force += kind == "rest" && rows[i][0] == "2" ? std::stod(rows[i][9]) : 0.0;
    // From the floor to the box, or the other way round where the floor comes first.
    const bool floor_is_b = rows[i][3] == "wall_bottom";
    EXPECT_EQ(rows[i][floor_is_b ? 2 : 3], "box");
    EXPECT_NEAR(std::stod(rows[i][7]), floor_is_b ? 1.0 : -1.0, 1e-12);
  }
  EXPECT_GT(impacts, 4);
  EXPECT_EQ(begins, 2);
  EXPECT_NEAR(force, 9.8, 1e-12);
}

TEST_F(Simulate, EndsWithASummary)
{
  run("drop", "--duration 4");
  const std::regex form("summary: simulated_s=4 engine_cpu_ms=[0-9.]+ events=[0-9]+ impacts=[0-9]+ "
                        "worst_overlap_m=[-+0-9.e]+ balance_error_J=[-+0-9.e]+ mode=exact");
  EXPECT_TRUE(std::regex_match(lastLine(err_), form)) << err_;
}

// Of 314 hits all are the light block's and half are the heavy one's.
TEST_F(Simulate, TellsWhatTheComputingWasForIfAsked)
{
  run("pi_collisions", "--duration 10");
  EXPECT_EQ(err_.find("summary: "), 0u) << err_;
  run("pi_collisions", "--duration 10 --verbose");
  const std::regex form("simulate: light: ([0-9]+) % of the computing; [0-9]+ % impacts, 31 a second\n"
                        "simulate: heavy: ([0-9]+) % of the computing; [0-9]+ % impacts, 16 a second\n"
                        "summary: [^\n]*\n");
  std::smatch shares;
  ASSERT_TRUE(std::regex_match(err_, shares, form)) << err_;
  EXPECT_NEAR(std::stoi(shares[1]) + std::stoi(shares[2]), 100, 1);
}

TEST_F(Simulate, TellsOfARaisedTolerance)
{
  std::ofstream(path("far.yaml")) << "tolerance: 1.0e-11\nwalls: {right: 1.0e+6}\nblocks: [{pose: [0, 0, 0]}]\n";
  runWith(path("far.yaml") + " --duration 1");
  EXPECT_EQ(status_, 0);
  EXPECT_EQ(err_.substr(0, err_.find('\n')), "simulate: note: tolerance raised from 1e-11 to 9.31323e-10 m, all that "
                                             "coordinates as large as 1e+06 m can resolve");
}

TEST_F(Simulate, SamplingChangesNoState)
{
  run("six_blocks", "--duration 20 --sample 20");
  const Row coarse = rowsOf(out_).back();
  run("six_blocks", "--duration 20 --sample 0.01");
  EXPECT_EQ(rowsOf(out_).back(), coarse);
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
