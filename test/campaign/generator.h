#pragma once

#include <cstdint>

#include "case.h"

namespace campaign
{
/// The case of a seed: 1 to 20 convex blocks with masses over 1:1000 and sizes over 1:30, and everything that may act
/// on them. More than half of the seeds are crowded.
Case generate(std::uint64_t seed);

}  // namespace campaign
