#pragma once

#include "replay.h"

namespace checker
{
/// The energy file against the states, against itself, and against what the intervals' forces and impulses did
/// (energy.*).
void checkEnergy(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion, Replay& replay,
                 Report& report);

/// Momentum of all blocks together where nothing from outside but gravity and damping acts (momentum.*), resting
/// contacts or not.
void checkMomentum(const Scene& scene, const Run& run, const Timeline& timeline, Replay& replay, Report& report);

/// Overlap of every pair at every sample (overlap.samples).
void checkOverlap(const Scene& scene, const Run& run, Report& report);

}  // namespace checker
