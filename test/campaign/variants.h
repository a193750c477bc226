#pragma once

#include <cstdint>
#include <optional>

#include "case.h"

namespace campaign
{
// Copies of a case whose runs must agree with its own until rounding has grown too large.

/// Seen in a mirror along the y axis.
Case mirrored(const Case& item);

/// The blocks in reverse order but for the first, whose mass a `set` changes. Nothing where a block deleted makes
/// another one the first.
std::optional<Case> reordered(const Case& item);

/// Every coordinate and velocity of a movable block off by the rounding of a number of size `length` (m), up or down at
/// random.
Case disturbed(const Case& item, double length, std::uint64_t seed, double roundings = 1.0);

}  // namespace campaign
