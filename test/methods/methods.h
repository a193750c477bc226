#pragma once

#include <string>
#include <vector>

#include "contact_group.h"

// Three other ways to treat an impact at several touches at once, as short as they can be, to be compared with the
// staged reflections of ContactGroup.

namespace block_world
{
namespace methods
{
/// Speeds below this count as zero, m/s.
constexpr double slow = 1e-10;

/// The touches of a group at one instant as numbers.
struct Impact
{
  SymmetricMatrix gram;              ///< A: normal velocities per impulse, 1/kg
  std::vector<double> velocity;      ///< w, negative where a touch approaches, m/s
  std::vector<double> elasticity;    ///< e of each touch
  std::vector<std::vector<int>> at;  ///< the movable members of each touch
};

Impact impactOf(const ContactGroup& group);

/// Each takes the impact to its end and returns the sum of the impulses at each touch, N s.
std::vector<double> newton(Impact impact);
std::vector<double> serial(Impact impact);
std::vector<double> hybrid(Impact impact);

/// The group after these impulses.
void apply(ContactGroup& group, const std::vector<double>& impulses);

/// Newton's law at some touches: z >= 0, w+ + e w >= 0, z.(w+ + e w) = 0. Adds z to the impulses, changes all
/// velocities.
void solveTogether(Impact& impact, const std::vector<int>& touches, std::vector<double>& impulses);

/// The first touch that approaches, -1 where none does.
int firstApproaching(const Impact& impact);

}  // namespace methods
}  // namespace block_world
