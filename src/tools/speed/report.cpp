#include "report.h"

#include <algorithm>
#include <fstream>
#include <ostream>
#include <sstream>

namespace block_world::speed
{
namespace
{
std::string quoted(const std::string& text)
{
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::string shortNumber(double value, int digits = 2)
{
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

/// Microseconds of CPU time per simulated second.
std::string micros(double seconds)
{
  std::ostringstream text;
  text.precision(seconds < 1e-4 ? 2 : 3);
  const double value = 1e6 * seconds;
  if (value >= 1e5)
    text << value / 1e6 << " s";
  else if (value >= 1e3)
    text << value / 1e3 << " ms";
  else
    text << value << " µs";
  return text.str();
}

/// Results of one engine.
std::vector<const Result*> resultsOf(const CaseResults& results, const std::string& engine)
{
  std::vector<const Result*> found;
  for (const Result& result : results.results)
    if (result.engine == engine)
      found.push_back(&result);
  return found;
}

std::string cell(const CaseResults& results, const std::string& engine)
{
  const std::vector<const Result*> found = resultsOf(results, engine);
  if (found.empty())
    return "-";
  if (!found.front()->cannot.empty())
    return "n/a";
  const Result& best = **std::min_element(found.begin(), found.end(), [](const Result* a, const Result* b) {
    return a->errors.front() < b->errors.front();
  });
  const auto both = [](const Result& result) {
    return shortNumber(result.errors.front()) + " @ " + micros(result.cost);
  };
  const Result& shipped = *found.front();
  const bool same = best.errors.front() == shipped.errors.front();
  return both(shipped) + (same ? std::string() : "<br>" + both(best));
}

/// The cheapest peer: at its default or, of what rests, at 1/60 s with sleeping. Null without peers.
const Result* cheapestPeer(const CaseResults& results)
{
  const std::string& ours = results.results.front().engine;
  const Result* cheapest = nullptr;
  for (const Result& result : results.results)
  {
    const bool counts = result.is_default || (results.of.rests && result.setting.sleeping && result.setting.steps == 1);
    if (result.engine != ours && result.cannot.empty() && counts && (!cheapest || result.cost < cheapest->cost))
      cheapest = &result;
  }
  return cheapest;
}

std::vector<std::string> enginesOf(const std::vector<CaseResults>& all)
{
  std::vector<std::string> names;
  for (const Result& result : all.front().results)
    if (names.empty() || names.back() != result.engine)
      names.push_back(result.engine);
  return names;
}

/// Whether all errors that are asked for are met.
bool exact(const CaseResults& results, const Result& ours)
{
  for (std::size_t i = 0; i < results.of.measures.size(); ++i)
    if (results.of.measures[i].goal && !(ours.errors[i] <= *results.of.measures[i].goal))
      return false;
  return true;
}

/// Ours with the tolerance as shipped, or where that is not exact enough, the coarsest finer one that is. (Settings come from coarse to fine.)
const Result& judged(const CaseResults& results)
{
  const Result& shipped = results.results.front();
  for (const Result* ours : resultsOf(results, shipped.engine))
    if (ours->setting.tolerance <= shipped.setting.tolerance && exact(results, *ours))
      return *ours;
  return shipped;
}
}  // namespace

std::string machine()
{
  std::ifstream file("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0)
    {
      processor = line.substr(line.find(':') + 2);
      break;
    }
#ifdef __VERSION__
  return processor + "; compiler " + __VERSION__;
#else
  return processor;
#endif
}

void writeCsvHeader(std::ostream& out)
{
  out << "engine,version,scene,setting,error,error_name,unit,cpu_s_per_simulated_s,repeats,spread,machine\n";
}

void writeCsv(const CaseResults& results, std::ostream& out)
{
  out.precision(6);
  for (const Result& result : results.results)
    for (std::size_t i = 0; i < results.of.measures.size(); ++i)
    {
      out << result.engine << ',' << quoted(result.version) << ',' << quoted(results.of.name) << ','
          << quoted(result.setting.label + (result.is_default ? " (default)" : "")) << ',';
      if (result.cannot.empty())
        out << result.errors[i];
      else
        out << quoted("n/a: " + result.cannot);
      const Measure& measure = results.of.measures[i];
      out << ',' << quoted(measure.name) << ',' << measure.unit << ',' << result.cost << ',' << result.repeats << ','
          << result.spread << ',' << quoted(machine()) << '\n';
    }
}

void writeTable(const std::vector<CaseResults>& all, std::ostream& out)
{
  const std::vector<std::string> names = enginesOf(all);
  out << "| scene | error |";
  for (const std::string& name : names)
    out << ' ' << name << " |";
  out << " cost of the cheapest peer / ours |\n|---|---|";
  for (std::size_t i = 0; i <= names.size(); ++i)
    out << "---|";
  out << '\n';
  for (const CaseResults& results : all)
  {
    const Measure& measure = results.of.measures.front();
    out << "| " << results.of.name << " | " << measure.name << ", " << measure.unit << " |";
    for (const std::string& name : names)
      out << ' ' << cell(results, name) << " |";
    const Result* peer = cheapestPeer(results);
    out << ' ' << (peer ? shortNumber(peer->cost / results.results.front().cost) : "-") << " |\n";
  }
}

void writeCollisions(const std::vector<CaseResults>& all, std::ostream& out)
{
  for (const CaseResults& results : all)
  {
    if (!results.of.counts_collisions)
      continue;
    const double simulated = static_cast<double>(results.of.frames) / frame_rate;
    const double collisions = static_cast<double>(results.results.front().impacts);
    out << "- " << results.of.name << ", " << shortNumber(collisions / simulated, 4)
        << " collisions per simulated second, CPU time for each:";
    std::string comma;
    for (const Result& result : results.results)
      if (result.is_default && result.cannot.empty())
      {
        out << comma << ' ' << result.engine << ' ' << micros(result.cost * simulated / collisions);
        comma = ",";
      }
    out << '\n';
  }
  out << '\n';
}

std::vector<Goal> goals(const std::vector<CaseResults>& all)
{
  std::vector<Goal> goals;
  for (const CaseResults& results : all)
  {
    const Result& ours = judged(results);
    const std::string& name = results.of.name;
    for (std::size_t i = 0; i < results.of.measures.size(); ++i)
    {
      const Measure& measure = results.of.measures[i];
      if (measure.goal)
        goals.push_back({ name, ours.setting.label, measure.name + ", " + measure.unit, *measure.goal, ours.errors[i],
                          ours.errors[i] <= *measure.goal });
    }
    const Result* peer = cheapestPeer(results);
    if (!peer || results.of.cheaper <= 0.0)
      continue;
    const double asked = 1.0 / results.of.cheaper, ratio = ours.cost / peer->cost;
    goals.push_back({ name, ours.setting.label, "cost, share of " + peer->engine + "'s", asked, ratio, ratio <= asked });
  }
  return goals;
}

void writeGoals(const std::vector<Goal>& goals, std::ostream& out)
{
  out << "| scene | ours | goal | at most | measured | |\n|---|---|---|---|---|---|\n";
  for (const Goal& goal : goals)
    out << "| " << goal.scene << " | " << goal.setting << " | " << goal.what << " | " << shortNumber(goal.asked) << " | "
        << shortNumber(goal.measured, 3) << " | " << (goal.met ? "met" : "**missed**") << " |\n";
}

}  // namespace block_world::speed
