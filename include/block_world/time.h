#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace block_world
{
/// An instant of simulated time: whole seconds plus a fraction in [0, 1).
///
/// A plain double loses 1e-10 s at t = 1e6 s; here the resolution is 1.1e-16 s at any age of the simulation, and moving the
/// origin of time by whole seconds changes no bit of a run.
class Time
{
public:
  Time() = default;

  static Time fromSeconds(double seconds)
  {
    return Time(0, 0.0) + seconds;
  }

  /// Exact for the second, rounded once for the fraction; the same nanosecond always gives the same instant.
  static Time fromNanoseconds(std::int64_t nanoseconds)
  {
    std::int64_t second = nanoseconds / 1000000000;
    std::int64_t rest = nanoseconds % 1000000000;
    if (rest < 0)
    {
      rest += 1000000000;
      --second;
    }
    return Time(second, static_cast<double>(rest) / 1e9);
  }

  /// Later than every other instant: the time of a promise that never expires.
  static Time infinity()
  {
    return Time(std::numeric_limits<std::int64_t>::max(), 0.0);
  }

  bool isInfinite() const
  {
    return second_ == std::numeric_limits<std::int64_t>::max();
  }

  /// Nearest whole nanosecond.
  std::int64_t nanoseconds() const
  {
    return second_ * 1000000000 + static_cast<std::int64_t>(std::llround(fraction_ * 1e9));
  }

  double seconds() const
  {
    return isInfinite() ? std::numeric_limits<double>::infinity() : static_cast<double>(second_) + fraction_;
  }

  std::int64_t wholeSeconds() const
  {
    return second_;
  }

  double fraction() const
  {
    return fraction_;
  }

  /// This instant moved by a span in s (negative allowed); a span that is not finite, or beyond 1e15 s, gives infinity().
  Time operator+(double span) const
  {
    if (isInfinite() || !(std::abs(span) < 1e15))
      return infinity();
    // Its whole seconds, rounded down.
    std::int64_t whole = static_cast<std::int64_t>(span);
    if (static_cast<double>(whole) > span)
      --whole;
    double fraction = fraction_ + (span - static_cast<double>(whole));
    std::int64_t second = second_ + whole;
    if (fraction >= 1.0)
    {
      fraction -= 1.0;
      ++second;
    }
    return Time(second, fraction);
  }

  /// The instant that lies this long after another one, as an input does after the start. Whole nanoseconds add up to whole ones.
  Time after(const Time& start) const
  {
    if (isInfinite() || start.isInfinite())
      return infinity();
    if (isWhole() && start.isWhole())
      return fromNanoseconds(nanoseconds() + start.nanoseconds());
    return Time(start.second_ + second_, start.fraction_) + fraction_;
  }

  /// Span from other to this, in s.
  double operator-(const Time& other) const
  {
    if (isInfinite())
      return std::numeric_limits<double>::infinity();
    return static_cast<double>(second_ - other.second_) + (fraction_ - other.fraction_);
  }

  bool operator<(const Time& other) const
  {
    return second_ < other.second_ || (second_ == other.second_ && fraction_ < other.fraction_);
  }
  bool operator>(const Time& other) const
  {
    return other < *this;
  }
  bool operator<=(const Time& other) const
  {
    return !(other < *this);
  }
  bool operator>=(const Time& other) const
  {
    return !(*this < other);
  }
  bool operator==(const Time& other) const
  {
    return second_ == other.second_ && fraction_ == other.fraction_;
  }
  bool operator!=(const Time& other) const
  {
    return !(*this == other);
  }

private:
  bool isWhole() const
  {
    return std::abs(second_) < 4000000000 && fromNanoseconds(nanoseconds()) == *this;
  }

  Time(std::int64_t second, double fraction) : second_(second), fraction_(fraction)
  {
  }

  std::int64_t second_ = 0;
  double fraction_ = 0.0;
};

}  // namespace block_world
