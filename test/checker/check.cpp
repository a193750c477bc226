#include "check.h"

#include "energy.h"
#include "rest.h"

namespace checker
{
void checkRun(const Scene& scene, const Run& run, Report& report)
{
  if (!report.passed())
    return;
  checkOverlap(scene, run, report);
  const Timeline timeline(scene);
  const Motion motion(scene);
  Replay replay(scene, run, timeline, motion, report);
  replay.checkAll();
  RestMotion(scene, run, timeline, motion, replay, report).checkAll();
  checkMomentum(scene, run, timeline, replay, report);
  checkEnergy(scene, run, timeline, motion, replay, report);
}

}  // namespace checker
