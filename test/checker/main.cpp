#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "check.h"

namespace
{
const char usage[] = "usage: checker SCENE.yaml --states S.csv --energy E.csv --contacts C.csv [--summary LOG] "
                     "[--tolerance M]\n"
                     "Judges a run of `simulate SCENE.yaml --sample 0.001 --states S.csv --energy E.csv --contacts "
                     "C.csv 2>LOG`.\n"
                     "Exit status: 0 all checks passed, 1 some failed, 2 the input cannot be read.\n";

std::map<std::string, std::string> parseArguments(int argc, char** argv)
{
  std::map<std::string, std::string> options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    if (word.compare(0, 2, "--") != 0)
    {
      if (!options.emplace("scene", word).second)
        throw std::runtime_error("two scenes given");
      continue;
    }
    if (word != "--states" && word != "--energy" && word != "--contacts" && word != "--summary" &&
        word != "--tolerance")
      throw std::runtime_error("unknown option " + word);
    if (++i == argc)
      throw std::runtime_error(word + " needs a value");
    options[word.substr(2)] = argv[i];
  }
  for (const char* needed : { "scene", "states", "energy", "contacts" })
  {
    if (options.count(needed) == 0)
      throw std::runtime_error(std::string("missing: ") + needed);
  }
  return options;
}

std::string readText(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw std::runtime_error(path + ": cannot be read");
  return text.str();
}

int run(std::map<std::string, std::string> options)
{
  checker::Scene scene = checker::readScene(options["scene"]);
  if (options.count("tolerance") > 0)
    scene.tolerance = std::stod(options["tolerance"]);
  checker::Report report;
  const checker::Run run =
      checker::readRun({ options["states"], options["energy"], options["contacts"] }, scene, report);
  checker::checkRun(scene, run, report);
  if (options.count("summary") > 0)
    checker::checkSummary(readText(options["summary"]), scene, report);
  report.print(std::cout, scene);
  return report.passed() ? 0 : 1;
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || std::string(argv[1]) == "--help")
  {
    (argc < 2 ? std::cerr : std::cout) << usage;
    return argc < 2 ? 2 : 0;
  }
  try
  {
    return run(parseArguments(argc, argv));
  }
  catch (const std::exception& error)
  {
    std::cerr << "checker: " << error.what() << "\n";
    return 2;
  }
}
