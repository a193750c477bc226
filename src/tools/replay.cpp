// Runs the scene and the commands of a bag again and compares every state with the recorded one, bit for bit.

#include <boost/program_options.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "progress.h"
#include "replay.h"
#include "run_log.h"

namespace
{
using namespace block_world;
namespace po = boost::program_options;

constexpr int identical = 0, different = 1, bad_input = 2;

struct ReplayOptions
{
  std::string bag, out, world;
  std::optional<double> until, tolerance;  ///< s; m
};

/// Nothing where the help was asked for, and printed. Throws po::error.
std::optional<ReplayOptions> parseOptions(int argc, const char* const* argv)
{
  ReplayOptions options;
  double until = 0.0, tolerance = 0.0;
  po::options_description shown("options");
  auto add = shown.add_options();
  add("help,h", "print this");
  add("out", po::value(&options.out)->value_name("NEW.bag"), "write the new run into a bag as well");
  add("until", po::value(&until)->value_name("S"), "compare the states up to this simulated time only");
  add("tolerance", po::value(&tolerance)->value_name("M"),
      "to explore: another contact tolerance than the scene's; differences are measured and are no failure");
  add("world", po::value(&options.world)->value_name("NAME"), "which node, where the bag has several: /a/block_world");
  po::options_description all(shown);
  all.add_options()("bag", po::value(&options.bag));
  po::positional_options_description positional;
  positional.add("bag", 1);

  po::variables_map values;
  const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(), values);
  po::notify(values);
  if (values.count("help"))
  {
    std::cout << "usage: replay RUN.bag [options]\n" << shown;
    return std::nullopt;
  }
  if (options.bag.empty())
    throw po::error("which bag? usage: replay RUN.bag [options], see --help");
  if (values.count("until"))
    options.until = until;
  if (values.count("tolerance"))
    options.tolerance = tolerance;
  if (options.until && !(until >= 0.0))
    throw po::error("--until: must be 0 s or more");
  if (options.tolerance && !(tolerance > 0.0 && std::isfinite(tolerance)))
    throw po::error("--tolerance: must be > 0 m and finite");
  return options;
}

void printEnd(const Replay& replay, const std::string& first)
{
  if (replay.leftOut() > 0)
    std::printf("%lld states from before the first scene in the bag are left out\n",
                static_cast<long long>(replay.leftOut()));
  const long long states = replay.states();
  if (first.empty())
    std::printf("%lld states identical, %zu commands, %.9g s\n", states, replay.inputsApplied(),
                replay.world().now().seconds());
  else
    std::printf("%s: %s\n", states > 0 ? "first difference" : "difference", first.c_str());
}

void printDeviation(const Replay& replay, const std::string& first)
{
  const Replay::Deviation& largest = replay.largest();
  std::printf("%lld states compared, largest deviation %.3g m", static_cast<long long>(replay.states()),
              largest.distance);
  if (largest.distance > 0.0)
    std::printf(" (%s at %.9g s)", largest.block.c_str(), largest.time);
  std::printf("\n%s%s", first.empty() ? "" : ("first: " + first).c_str(), first.empty() ? "" : "\n");
}

int run(const ReplayOptions& options)
{
  const RunLog log(options.bag, options.world);
  Replay replay(log, options.tolerance);
  if (!options.out.empty())
    replay.writeTo(options.out);
  std::string first;
  {
    Progress progress;
    log.eachState([&](const msg::BodyStates& state) {
      if (options.until && static_cast<double>(state.time_ns) * 1e-9 > *options.until)
        return false;
      const std::int64_t before = replay.states();
      const std::string difference = replay.compare(state);
      if (first.empty())
        first = difference;
      progress.show(replay.world());
      // A state that was not reached leaves nothing to compare the next ones with.
      const bool reached = difference.empty() || replay.states() > before;
      return options.tolerance || !options.out.empty() ? reached : difference.empty();
    });
  }
  replay.close();
  if (replay.states() == 0 && first.empty())
    throw RunLogError(options.bag + ": no states to compare with");
  if (options.tolerance)
    printDeviation(replay, first);
  else
    printEnd(replay, first);
  return first.empty() || options.tolerance ? identical : different;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const std::optional<ReplayOptions> options = parseOptions(argc, argv);
    return options ? run(*options) : identical;
  }
  catch (const po::error& error)
  {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return bad_input;
  }
  catch (const RunLogError& error)
  {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return bad_input;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return different;
  }
}
