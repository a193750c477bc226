#include "simulate_options.h"

#include <boost/program_options.hpp>

#include <cmath>
#include <iostream>
#include <sstream>

namespace block_world
{
namespace
{
namespace po = boost::program_options;

// Whole nanoseconds of longer runs would not fit into 64 bits.
constexpr double longest = 9e9;

[[noreturn]] void refuseOption(const std::string& option, const std::string& range, double value)
{
  std::ostringstream text;
  text << option << ": must be " << range << ", is " << value;
  throw UsageError(text.str());
}

po::options_description describeOptions(SimulateOptions& options, double& duration)
{
  po::options_description description("options");
  auto add = description.add_options();
  add("help,h", "print this");
  add("duration", po::value(&duration)->default_value(10.0, "10")->value_name("S"), "simulated seconds");
  add("sample", po::value(&options.sample)->default_value(0.1, "0.1")->value_name("S"),
      "seconds from one row of states to the next");
  add("tolerance", po::value<double>()->value_name("M"),
      "how near counts as touching, in place of the scene's, in metres");
  add("states", po::value(&options.states)->value_name("FILE"), "states as CSV, by default to standard output");
  add("energy", po::value(&options.energy)->value_name("FILE"), "energies as CSV");
  add("contacts", po::value(&options.contacts)->value_name("FILE"), "impacts and resting contacts as CSV");
  add("bag", po::value(&options.bag)->value_name("FILE.bag"),
      "the node's topics as a bag, for replay.launch and replay");
  add("verbose,v", po::bool_switch(&options.verbose), "tell which blocks the computing was done for, and why");
  return description;
}

void checkRanges(const SimulateOptions& options, double duration)
{
  if (!(duration >= 0.0 && duration <= longest))
    refuseOption("--duration", "0 to 9e9 s", duration);
  if (!(options.sample >= 1e-9 && std::isfinite(options.sample)))
    refuseOption("--sample", "1e-9 s or more", options.sample);
  if (options.tolerance && !(*options.tolerance > 0.0 && std::isfinite(*options.tolerance)))
    refuseOption("--tolerance", "> 0 and finite", *options.tolerance);
}

}  // namespace

std::optional<SimulateOptions> parseSimulateOptions(int argc, const char* const* argv)
{
  SimulateOptions options;
  double duration = 0.0;
  const po::options_description shown = describeOptions(options, duration);
  po::options_description all(shown);
  all.add_options()("scene", po::value(&options.scene));
  po::positional_options_description positional;
  positional.add("scene", 1);

  po::variables_map values;
  try
  {
    // No guessing: a mistyped option is not half of another.
    const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(), values);
    po::notify(values);
  }
  catch (const po::error& error)
  {
    throw UsageError(error.what());
  }
  if (values.count("help"))
  {
    std::cout << "usage: simulate SCENE.yaml [options]\n" << shown;
    return std::nullopt;
  }
  if (options.scene.empty())
    throw UsageError("which scene? usage: simulate SCENE.yaml [options], see --help");
  if (values.count("tolerance"))
    options.tolerance = values["tolerance"].as<double>();
  checkRanges(options, duration);
  options.duration = std::llround(duration * 1e9);
  return options;
}

}  // namespace block_world
