#include "options.h"

#include <boost/program_options.hpp>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <sstream>

namespace block_world::speed
{
namespace
{
namespace po = boost::program_options;

po::options_description describe(Options& options, std::int64_t& seed)
{
  po::options_description description("options");
  auto add = description.add_options();
  add("help,h", "print this");
  add("list", po::bool_switch(&options.list), "print the names of engines and scenes");
  add("short", po::bool_switch(&options.quick), "few scenes, and --defaults");
  add("defaults", po::bool_switch(&options.plan.only_defaults), "every engine at its default only");
  add("scene", po::value(&options.scenes)->value_name("NAME"), "only this scene; may be given several times");
  add("seed", po::value(&seed)->default_value(0)->value_name("N"),
      "other than 0: random versions of the scenes, the same for the same N");
  add("repeats", po::value(&options.plan.repeats)->default_value(9)->value_name("N"), "timed runs of a setting");
  add("budget", po::value(&options.plan.budget)->default_value(0.4, "0.4")->value_name("S"),
      "CPU time for the runs of one setting of one engine on one scene; finer settings are left out");
  add("csv", po::value(&options.csv)->value_name("FILE"), "all results as CSV");
  add("report", po::value(&options.report)->value_name("FILE"), "tables in Markdown, by default to standard output");
  add("check", po::bool_switch(&options.check), "exit with 1 where a goal is missed");
  return description;
}

[[noreturn]] void refuse(const std::string& option, const std::string& range, double value)
{
  std::ostringstream text;
  text << option << ": must be " << range << ", is " << value;
  throw UsageError(text.str());
}

}  // namespace

std::optional<Options> parseOptions(int argc, const char* const* argv)
{
  Options options;
  std::int64_t seed = 0;
  const po::options_description description = describe(options, seed);
  po::variables_map values;
  try
  {
    // No guessing: a mistyped option is not half of another. No positional words either.
    const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    const po::positional_options_description none;
    po::store(po::command_line_parser(argc, argv).options(description).positional(none).style(style).run(), values);
    po::notify(values);
  }
  catch (const po::error& error)
  {
    throw UsageError(error.what());
  }
  if (values.count("help"))
  {
    std::cout << "usage: speed_against_error [options]\n" << description;
    return std::nullopt;
  }
  if (seed < 0 || seed > std::numeric_limits<unsigned>::max())
    refuse("--seed", "0 to 4294967295", static_cast<double>(seed));
  options.seed = static_cast<unsigned>(seed);
  if (options.plan.repeats < 1)
    refuse("--repeats", "1 or more", options.plan.repeats);
  if (!(options.plan.budget > 0.0 && std::isfinite(options.plan.budget)))
    refuse("--budget", "> 0 s and finite", options.plan.budget);
  options.plan.only_defaults |= options.quick;
  return options;
}

}  // namespace block_world::speed
