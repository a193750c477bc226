#pragma once

#include <cmath>
#include <deque>
#include <iosfwd>
#include <string>

namespace checker
{
/// One question asked many times: keeps the answer that came nearest to its limit, or went farthest beyond it.
class Check
{
public:
  Check(const std::string& name, const std::string& meaning) : name_(name), meaning_(meaning)
  {
  }

  /// value must not exceed limit; anything that is not a number fails. a, b: bodies concerned.
  void add(double value, double limit, double time, int a = -1, int b = -1)
  {
    ++count_;
    const bool good = value <= limit;
    if (!good)
      ++violations_;
    // 0 of 0 is as good as can be; a limit of 0 exceeded is as bad as can be.
    const double ratio =
        good ? (limit > 0.0 ? value / limit : 0.0) : (limit > 0.0 && std::isfinite(value) ? value / limit : 1e300);
    if (count_ > 1 && ratio <= ratio_)
      return;
    ratio_ = ratio;
    value_ = value;
    limit_ = limit;
    time_ = time;
    a_ = a;
    b_ = b;
  }

  const std::string& name() const
  {
    return name_;
  }
  const std::string& meaning() const
  {
    return meaning_;
  }
  long count() const
  {
    return count_;
  }
  long violations() const
  {
    return violations_;
  }
  double value() const
  {
    return value_;
  }
  double limit() const
  {
    return limit_;
  }
  double time() const
  {
    return time_;
  }
  int a() const
  {
    return a_;
  }
  int b() const
  {
    return b_;
  }

private:
  std::string name_, meaning_;
  long count_ = 0, violations_ = 0;
  double ratio_ = 0.0, value_ = 0.0, limit_ = 0.0, time_ = 0.0;
  int a_ = -1, b_ = -1;
};

struct Scene;

/// All checks in the order in which they were first named. References stay valid.
class Report
{
public:
  Check& check(const std::string& name, const std::string& meaning = "");
  const Check* find(const std::string& name) const;
  const std::deque<Check>& checks() const
  {
    return checks_;
  }
  bool passed() const;

  /// The table, and the line with the counts at its end. Checks that were never asked count neither way.
  void print(std::ostream& out, const Scene& scene) const;

private:
  std::deque<Check> checks_;
};

}  // namespace checker
