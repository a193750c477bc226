// Error against CPU time, here and in the engines people would otherwise use. See doc/speed-against-error.md.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <ostream>
#include <stdexcept>

#include "speed/features.h"
#include "speed/options.h"
#include "speed/report.h"
#include "speed/scenes.h"

namespace
{
using namespace block_world::speed;

constexpr int done = 0, failed = 1, bad_input = 2;

/// A file that cannot be opened is the caller's mistake.
std::ofstream openFile(const std::string& path)
{
  std::ofstream file(path);
  if (!file)
    throw UsageError(path + ": cannot be written");
  return file;
}

void list(const std::vector<Engine>& engines)
{
  for (const Engine& engine : engines)
    std::cout << "engine " << engine.name << ' ' << engine.version << '\n';
  for (const Family& family : families())
    std::cout << "scene " << family.name << (family.quick ? " (also in the short form)" : "") << '\n';
}

std::vector<Family> chosen(const Options& options)
{
  std::vector<Family> all = families();
  for (const std::string& name : options.scenes)
    if (std::none_of(all.begin(), all.end(), [&](const Family& family) { return family.name == name; }))
      throw UsageError("--scene: no scene is called '" + name + "', see --list");
  const auto unwanted = [&](const Family& family) {
    const auto& names = options.scenes;
    return names.empty() ? options.quick && !family.quick :
                           std::find(names.begin(), names.end(), family.name) == names.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  return all;
}

void write(const std::vector<CaseResults>& all, const std::vector<Goal>& goals,
           const std::vector<FeatureCost>& features, const Options& options, std::ostream& out)
{
  out << "# Speed against error: results\n\n" << machine();
  if (options.seed)
    out << "; random versions, seed " << options.seed;
  out << "\n\nEach cell: error @ CPU time per simulated second, as shipped and, below, with the settings that gave the "
         "least "
         "error.\n\n";
  writeTable(all, out);
  out << '\n';
  writeCollisions(all, out);
  out << "## Goals\n\n";
  writeGoals(goals, out);
  out << "\n## What it costs block_world to model more\n\nCPU time per simulated second.\n\n";
  writeFeatures(features, out);
}

int runCommand(int argc, char** argv)
{
  const std::optional<Options> options = parseOptions(argc, argv);
  if (!options)
    return done;
  const std::vector<Engine> all_engines = engines();
  if (options->list)
  {
    list(all_engines);
    return done;
  }
  const std::vector<Family> wanted = chosen(*options);
  std::ofstream csv, report;
  if (!options->csv.empty())
    csv = openFile(options->csv);
  if (!options->report.empty())
    report = openFile(options->report);

  if (csv.is_open())
    writeCsvHeader(csv);
  std::vector<CaseResults> all;
  for (const Family& family : wanted)
  {
    std::fprintf(stderr, "%s\n", family.name.c_str());
    Variation vary(options->seed);
    all.push_back(measure(family.make(vary), all_engines, options->plan));
    if (csv.is_open())
      writeCsv(all.back(), csv);
  }
  const std::vector<Goal> found = goals(all);
  write(all, found, featureCosts(options->plan.repeats), *options, options->report.empty() ? std::cout : report);
  csv.flush();
  report.flush();
  if ((csv.is_open() && !csv) || (report.is_open() && !report))
    throw std::runtime_error("a file could not be written to its end");
  const bool met = std::all_of(found.begin(), found.end(), [](const Goal& goal) { return goal.met; });
  return options->check && !met ? failed : done;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    return runCommand(argc, argv);
  }
  catch (const UsageError& error)
  {
    std::fprintf(stderr, "speed_against_error: %s\n", error.what());
    return bad_input;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "speed_against_error: %s\n", error.what());
    return failed;
  }
}
