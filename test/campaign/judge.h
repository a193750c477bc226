#pragma once

#include <string>

#include "case.h"
#include "result.h"

namespace campaign
{
/// What judging needs beside the case.
struct Tools
{
  std::string simulate, checker;         ///< programs; without them nothing is judged through files
  std::string folder;                    ///< for files that come and go
  double cpu = 10.0;                     ///< s that a run may take
  bool watches = true, compares = true;  ///< ways of judging: at every promise; readings at other times and copies

  bool judgesFiles() const
  {
    return !simulate.empty();
  }
  /// No more than what can find a failure of this name again.
  Tools forCheck(const std::string& name) const;
};

/// Runs a case in all ways and judges it.
Result judge(const Case& item, const Tools& tools);

/// The command lines that repeat what the checker judged.
std::string simulateCommand(const Tools& tools, const std::string& scene, const std::string& folder, double duration);
std::string checkerCommand(const Tools& tools, const std::string& scene, const std::string& folder);

}  // namespace campaign
