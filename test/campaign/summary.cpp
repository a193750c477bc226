#include "summary.h"

#include <algorithm>
#include <map>

namespace campaign
{
namespace
{
double median(std::vector<double> values)
{
  if (values.empty())
    return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The result with the largest value.
template <class Value>
const Result& worst(const std::vector<Result>& results, Value Result::*value)
{
  return *std::max_element(results.begin(), results.end(),
                           [&](const Result& p, const Result& q) { return p.*value < q.*value; });
}

double share(const std::vector<Result>& results, bool Result::*what)
{
  const auto count = std::count_if(results.begin(), results.end(), [&](const Result& r) { return r.*what; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(results.size());
}

void printWorst(const char* what, const std::vector<Result>& results, double Result::*value, std::FILE* out)
{
  const Result& result = worst(results, value);
  std::fprintf(out, "  %-46s %9.3g  seed %llu\n", what, result.*value, static_cast<unsigned long long>(result.seed));
}

void printKinds(const std::vector<Result>& results, std::FILE* out)
{
  std::map<std::string, std::vector<std::uint64_t>> kinds;
  for (const Result& result : results)
    for (const Failure& failure : result.failures)
      kinds[failure.check].push_back(result.seed);
  for (const auto& [check, seeds] : kinds)
  {
    std::fprintf(out, "  %-28s %4zu  seeds", check.c_str(), seeds.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(seeds.size(), 12); ++i)
      std::fprintf(out, " %llu", static_cast<unsigned long long>(seeds[i]));
    std::fprintf(out, "%s\n", seeds.size() > 12 ? " ..." : "");
  }
}
}  // namespace

void printFailure(const Result& result, std::FILE* out)
{
  std::fprintf(out, "seed %llu failed%s%s\n", static_cast<unsigned long long>(result.seed),
               result.saved.empty() ? "" : ": ", result.saved.c_str());
  for (const Failure& failure : result.failures)
    std::fprintf(out, "  %s at %.9g s: %s\n", failure.check.c_str(), failure.time, failure.detail.c_str());
  std::fflush(out);
}

void printSummary(const std::vector<Result>& results, std::FILE* out)
{
  if (results.empty())
    return;
  std::vector<double> impacts, compared;
  double events = 0.0, hits = 0.0, stuck = 0.0, cpu = 0.0;
  long bad = 0;
  for (const Result& r : results)
  {
    impacts.push_back(static_cast<double>(r.impacts));
    compared.push_back(r.compared);
    events += static_cast<double>(r.events);
    hits += static_cast<double>(r.impacts);
    stuck += r.failed("stuck");
    cpu += r.cpu;
    bad += !r.failures.empty();
  }
  std::fprintf(out, "%zu scenes, %ld failed, %.0f stuck; %.4g events, %.4g impacts, a scene has %.0f (median)\n",
               results.size(), bad, stuck, events, hits, median(impacts));
  std::fprintf(out,
               "%.0f %% of the scenes come to rest somewhere, %.0f %% have simultaneous hits, %.0f %% must keep their "
               "energy, "
               "%.0f %% their momentum,\n%.0f %% were judged by the checker, copies were compared for %.0f %% of the "
               "time (median),\nin %.1f %% they parted, and so did copies that began a little off\n",
               share(results, &Result::rests), share(results, &Result::hits_together),
               share(results, &Result::keeps_energy), share(results, &Result::keeps_momentum),
               share(results, &Result::in_files), 100.0 * median(compared), share(results, &Result::discontinuous));
  printWorst("deepest overlap, tolerances", results, &Result::overlap, out);
  printWorst("largest rise of energy less work, of its scale", results, &Result::gain, out);
  printWorst("largest balance error, of the scale", results, &Result::balance, out);
  printWorst("largest change of momentum, of the scale", results, &Result::momentum, out);
  printWorst("copies' departure in those of disturbed ones", results, &Result::departure, out);
  printWorst("slowest run, s of CPU time", results, &Result::cpu, out);
  std::fprintf(out, "  %-46s %9.3g\n", "all runs, s of CPU time", cpu);
  printKinds(results, out);
}

}  // namespace campaign
