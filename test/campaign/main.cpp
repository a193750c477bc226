// Random scenes, simulated and judged. A seed is a scene, the same on every machine.

#include <sys/stat.h>
#include <unistd.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "apart.h"
#include "generator.h"
#include "judge.h"
#include "shrink.h"
#include "summary.h"

namespace
{
using namespace campaign;
namespace po = boost::program_options;

struct Options
{
  std::uint64_t first = 1;
  int count = 20, jobs = 1;
  double longest = 1e9;
  bool shrink = false;
  double shrink_seconds = 60.0;
  std::string save = "campaign_failures", scene;
  Tools tools;
};

/// The options, or nothing where help was asked for.
std::optional<Options> parse(int argc, char** argv)
{
  Options options;
  po::options_description description("options");
  auto add = description.add_options();
  add("help,h", "print this");
  add("first", po::value(&options.first), "first seed");
  add("count", po::value(&options.count), "how many");
  add("jobs", po::value(&options.jobs), "how many at a time");
  add("longest", po::value(&options.longest), "s, cuts scenes that take longer");
  add("cpu", po::value(&options.tools.cpu), "s of CPU time that a run may take, else it is stuck");
  add("simulate", po::value(&options.tools.simulate),
      "the program simulate; with it and the checker, runs are judged through files too");
  add("checker", po::value(&options.tools.checker), "the program checker");
  add("save", po::value(&options.save), "folder for the scenes of failing seeds");
  add("shrink", po::bool_switch(&options.shrink), "make failing scenes smaller before saving them");
  add("shrink-seconds", po::value(&options.shrink_seconds), "time for each");
  add("scene", po::value(&options.scene),
      "judge this scene file (with its script beside it) for --longest s instead of seeds");
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, description), values);
  po::notify(values);
  if (options.tools.simulate.empty() != options.tools.checker.empty())
    throw po::error("--simulate and --checker go together");
  if (!values.count("help"))
    return options;
  std::cout << "usage: campaign --first 1 --count 1000 --jobs 2 [options]\n"
            << description << "Exit status: 0 nothing wrong, 1 something, 2 cannot run.\n";
  return std::nullopt;
}

/// A folder for the files of one process, gone with it.
class Scratch
{
public:
  Scratch() : path_((std::filesystem::temp_directory_path() / ("campaign_" + std::to_string(getpid()))).string())
  {
    std::filesystem::create_directories(path_);
  }
  ~Scratch()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const
  {
    return path_;
  }

private:
  std::string path_;
};

/// Enough for all runs of a case, of which each has its own limit.
double limitOf(const Tools& tools)
{
  return 30.0 * tools.cpu;
}

Result judgeApart(const Case& item, const Tools& tools)
{
  return apart([&] { return judge(item, tools); }, limitOf(tools));
}

Case shrunk(const Case& item, const Result& result, const Options& options, const std::string& folder, Failure& left)
{
  const Failure& failure = result.failures.front();
  Tools tools = options.tools.forCheck(failure.check);
  tools.folder = folder;
  Shrinker shrinker(
      item, failure, [&](const Case& candidate) { return judgeApart(candidate, tools); }, options.shrink_seconds);
  const Case small = shrinker.shrink();
  left = shrinker.failure();
  return small;
}

Result judgeSeed(std::uint64_t seed, const Options& options)
{
  const Scratch scratch;
  Tools tools = options.tools;
  tools.folder = scratch.path();
  Case item = options.scene.empty() ? generate(seed) : loadCase(options.scene, options.longest);
  item.duration = std::min(item.duration, options.longest);
  // Apart once more, so that what crashes can be shrunk and saved.
  Result result = judgeApart(item, tools);
  result.seed = seed;
  if (result.failures.empty())
    return result;
  std::filesystem::create_directories(options.save);
  result.saved = options.save + "/seed_" + std::to_string(seed) + ".yaml";
  saveCase(item, result.saved);
  if (options.shrink)
  {
    Failure left;
    const Case small = shrunk(item, result, options, scratch.path(), left);
    result.saved = options.save + "/seed_" + std::to_string(seed) + "_small.yaml";
    saveCase(small, result.saved);
    result.saved += " --duration " + shown(small.duration);
    left.check = "shrunk." + left.check;
    result.failures.push_back(left);
  }
  return result;
}

int run(const Options& options)
{
  std::vector<Result> results;
  const int count = options.scene.empty() ? options.count : 1;
  const double cpu = 2.0 * limitOf(options.tools) + options.shrink_seconds;
  eachApart(
      count, options.jobs, [&](int i) { return judgeSeed(options.first + static_cast<std::uint64_t>(i), options); },
      cpu,
      [&](int i, Result result) {
        result.seed = options.first + static_cast<std::uint64_t>(i);
        if (!result.failures.empty())
          printFailure(result, stdout);
        results.push_back(result);
      });
  std::sort(results.begin(), results.end(), [](const Result& p, const Result& q) { return p.seed < q.seed; });
  printSummary(results, stdout);
  return std::any_of(results.begin(), results.end(), [](const Result& r) { return !r.failures.empty(); }) ? 1 : 0;
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const std::optional<Options> options = parse(argc, argv);
    return options ? run(*options) : 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "campaign: %s\n", error.what());
    return 2;
  }
}
