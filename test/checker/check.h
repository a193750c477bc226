#pragma once

#include "report.h"
#include "run_files.h"
#include "scene.h"

namespace checker
{
/// Judges a run that was read without complaint; where reading complained, nothing more is asked.
void checkRun(const Scene& scene, const Run& run, Report& report);

}  // namespace checker
