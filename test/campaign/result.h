#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace campaign
{
/// A check that failed: its name, when, and what it found.
struct Failure
{
  std::string check;
  double time = 0.0;
  std::string detail;
};

/// What a case showed.
struct Result
{
  std::uint64_t seed = 0;
  std::vector<Failure> failures;
  long events = 0, impacts = 0;
  bool rests = false;                                 ///< some contact carried force for a while
  bool hits_together = false;                         ///< two pairs at one instant
  bool keeps_momentum = false, keeps_energy = false;  ///< was held to that
  bool in_files = false;                              ///< judged by the checker too
  bool discontinuous = false;  ///< copies parted, and so did disturbed ones: comparing ended there
  double overlap = 0.0;                               ///< deepest, in tolerances
  double gain = 0.0;                                  ///< largest rise of energy less work, of the scale
  double balance = 0.0;                               ///< largest balance error, of the scale
  double momentum = 0.0;                              ///< largest change, of the scale
  double departure = 0.0;  ///< of mirrored and re-ordered copies, in those of the disturbed copies
  double compared = 0.0;   ///< share of the time for which copies were compared
  double cpu = 0.0;        ///< s, of one run with readings at some 100 times
  std::string saved;       ///< scene file of a failing case

  bool failed(const std::string& check) const
  {
    for (const Failure& failure : failures)
      if (failure.check == check)
        return true;
    return false;
  }
  /// Only the first failure of a kind counts.
  void fail(const std::string& check, double time, const std::string& detail)
  {
    if (!failed(check))
      failures.push_back({ check, time, detail });
  }
};

/// One result as text and back, to get it out of the process that made it.
std::string pack(const Result& result);
Result unpack(const std::string& text);

/// Digits enough to tell.
std::string shown(double value);

}  // namespace campaign
