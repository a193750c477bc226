#pragma once

#include <cstdio>
#include <vector>

#include "result.h"

namespace campaign
{
/// The figures of a whole campaign.
void printSummary(const std::vector<Result>& results, std::FILE* out);

/// One failing seed: what failed, when, and how to see it again.
void printFailure(const Result& result, std::FILE* out);

}  // namespace campaign
