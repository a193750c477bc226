#include "report.h"

#include <cstdio>
#include <ostream>

#include "scene.h"

namespace checker
{
Check& Report::check(const std::string& name, const std::string& meaning)
{
  for (Check& known : checks_)
  {
    if (known.name() == name)
      return known;
  }
  checks_.emplace_back(name, meaning);
  return checks_.back();
}

const Check* Report::find(const std::string& name) const
{
  for (const Check& known : checks_)
  {
    if (known.name() == name)
      return &known;
  }
  return nullptr;
}

bool Report::passed() const
{
  for (const Check& check : checks_)
  {
    if (check.violations() > 0)
      return false;
  }
  return true;
}

void Report::print(std::ostream& out, const Scene& scene) const
{
  int passed = 0, failed = 0;
  char line[400];
  std::snprintf(line, sizeof line, "%-6s %-26s %9s %7s %10s %10s  %s\n", "", "check", "asked", "failed", "worst",
                "limit", "where, what");
  out << line;
  for (const Check& check : checks_)
  {
    const bool good = check.violations() == 0;
    if (check.count() > 0)
      ++(good ? passed : failed);
    std::string where;
    if (check.count() > 0)
    {
      char time[40];
      std::snprintf(time, sizeof time, "t=%.10g ", check.time());
      where = time;
      for (const int body : { check.a(), check.b() })
        where += body >= 0 ? scene.name(body) + " " : "";
    }
    std::snprintf(line, sizeof line, "%-6s %-26s %9ld %7ld %10.3g %10.3g  %s(%s)\n",
                  check.count() == 0 ? "-" :
                  good               ? "ok" :
                                       "FAILED",
                  check.name().c_str(), check.count(), check.violations(), check.value(), check.limit(), where.c_str(),
                  check.meaning().c_str());
    out << line;
  }
  out << passed << " passed, " << failed << " failed\n";
}

}  // namespace checker
