// What the report makes of results, by hand.

#include "speed/report.h"

#include <gtest/gtest.h>

namespace block_world::speed
{
namespace
{
Result ours(double tolerance, double error, double cost)
{
  Result result;
  result.engine = "block_world";
  result.setting.label = std::to_string(tolerance);
  result.setting.tolerance = tolerance;
  result.errors = { error };
  result.cost = cost;
  return result;
}

// Of errors of at most 0.5 at a third of a peer's cost of 9.
TEST(SpeedReport, GoalsAreJudgedByTheCoarsestToleranceThatIsExactEnough)
{
  Result peer = ours(0.0, 100.0, 9.0);
  peer.engine = "peer";
  peer.is_default = true;
  const struct
  {
    const char* what;
    double shipped, finer, finest;  // errors
    double tolerance;               // of the setting that is judged
    bool exact, cheap;
  } cases[] = {
    { "as shipped", 0.5, 0.0, 0.0, 1e-2, true, true },
    { "finer", 0.6, 0.4, 0.0, 1e-3, true, true },
    { "finest, at twice the cost that is allowed", 0.6, 0.6, 0.4, 1e-4, true, false },
    { "none: as shipped", 0.6, 0.7, 0.8, 1e-2, false, true },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.what);
    CaseResults results;
    results.of.name = "scene";
    results.of.measures = { { "error", "m", nullptr, 0.5 } };
    results.of.cheaper = 3.0;
    // A coarser one never counts, however good it is.
    results.results = { ours(1e-2, c.shipped, 1.0), ours(1e-1, 0.0, 0.1), ours(1e-3, c.finer, 2.0), ours(1e-4, c.finest, 6.0), peer };
    const std::vector<Goal> found = goals({ results });
    ASSERT_EQ(found.size(), 2u);
    for (const Goal& goal : found)
      EXPECT_EQ(goal.setting, std::to_string(c.tolerance));
    EXPECT_EQ(found[0].met, c.exact);
    EXPECT_EQ(found[1].met, c.cheap);
    EXPECT_DOUBLE_EQ(found[1].asked, 1.0 / 3.0);
  }
}
}  // namespace
}  // namespace block_world::speed
