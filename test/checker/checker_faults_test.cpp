#include <gtest/gtest.h>

#include <utility>

#include "exact_cases.h"

// One deliberate fault each: the check that is there for it must fail by name.

namespace exact
{
namespace
{
using Fault = std::function<void(checker::Run&)>;

checker::Report spoil(const Case& item, const Fault& fault, double step = 0.001)
{
  checker::Run run = build(item, step);
  fault(run);
  return judge(item, run);
}

/// Fails in every check named, and in none but these and the ones allowed.
void expectFault(const checker::Report& report, const std::vector<std::string>& named,
                 const std::vector<std::string>& allowed)
{
  for (const std::string& name : named)
  {
    ASSERT_NE(report.find(name), nullptr) << name;
    EXPECT_GT(report.find(name)->violations(), 0) << name << " did not fail; failed: " << failures(report);
  }
  for (const checker::Check& check : report.checks())
  {
    const auto in = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), check.name()) != names.end();
    };
    EXPECT_TRUE(check.violations() == 0 || in(named) || in(allowed)) << failures(report);
  }
}

void nothing(checker::Run&)
{
}

/// The row of the only impact.
ContactRow& impactOf(checker::Run& run)
{
  return run.contacts[0];
}

TEST(CheckerFaults, BlocksThatPassThroughEachOther)
{
  Case item;
  item.scene = "{blocks: [{name: a, size: [1, 1], pose: [-2, 0, 0], velocity: [4, 0, 0]}, {name: b, size: [1, 1], "
               "pose: [0, 0.2, 0]}]}";
  item.movers = { { 1, 1.0 / 6, Pieces{ 0, { { 0, stateOf(-2, 0, 0, 4, 0, 0) } } } },
                  { 1, 1.0 / 6, Pieces{ 0, { { 0, stateOf(0, 0.2, 0, 0, 0, 0) } } } } };
  expectFault(spoil(item, nothing), { "overlap.samples" }, {});
}

TEST(CheckerFaults, MissedWall)
{
  expectFault(spoil(cornerOnWall(0.5, true), nothing), { "overlap.samples" }, {});
}

TEST(CheckerFaults, RestitutionOnePercentOff)
{
  expectFault(spoil(offCentreHit(0.5, 0.99), nothing), { "impact.restitution", "impact.impulse" }, {});
}

TEST(CheckerFaults, BounceLeftOut)
{
  expectFault(spoil(slowHit(0.05), nothing), { "impact.restitution", "impact.impulse" }, {});
}

TEST(CheckerFaults, ElasticityBeyondOneGainsEnergy)
{
  expectFault(spoil(offCentreHit(1.0, 1.02), nothing),
              { "impact.energy", "energy.losses", "energy.no_gain", "energy.conserved" },
              { "impact.restitution", "impact.impulse" });
}

TEST(CheckerFaults, ImpulseOnePercentOff)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { impactOf(run).impulse *= 1.01; }),
              { "replay.linear_momentum", "replay.angular_momentum", "impact.impulse" },
              { "impact.restitution", "replay.position", "energy.impact_loss" });
}

TEST(CheckerFaults, ImpulseAtTheWrongPoint)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { impactOf(run).point.y() += 1e-3; }),
              { "replay.angular_momentum", "contact.point" },
              { "replay.position", "impact.restitution", "impact.impulse", "energy.impact_loss" });
}

TEST(CheckerFaults, ImpactAtTheWrongTime)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { impactOf(run).time += 1e-5; }),
              { "replay.position", "contact.point" },
              { "contact.normal", "overlap.impacts", "replay.angular_momentum", "impact.restitution", "impact.impulse",
                "impact.approach", "energy.impact_loss" });
}

TEST(CheckerFaults, SpinAfterTheImpactOnePercentOff)
{
  Case item = offCentreHit(0.5);
  const double hit = item.events[0].time;
  const auto right = item.movers[0].state;
  item.movers[0].state = [=](double t) {
    State state = right(t);
    state.omega *= 1.01;
    state.angle += t > hit ? 0.01 * right(t).omega * (t - hit) : 0.0;
    return state;
  };
  expectFault(spoil(item, nothing), { "replay.angular_momentum", "momentum.angular" },
              { "replay.position", "energy.no_gain", "energy.impact_loss", "energy.balance_error" });
}

TEST(CheckerFaults, MomentumAppears)
{
  Case item = offCentreHit(0.5);
  const double hit = item.events[0].time;
  const auto right = item.movers[1].state;
  item.movers[1].state = [=](double t) {
    State state = right(t);
    state.velocity.y() += t > hit ? 0.01 : 0.0;
    state.position.y() += t > hit ? 0.01 * (t - hit) : 0.0;
    return state;
  };
  expectFault(spoil(item, nothing), { "replay.linear_momentum", "momentum.linear" },
              { "replay.position", "momentum.angular", "energy.no_gain", "energy.balance_error" });
}

TEST(CheckerFaults, BlockFrozenInFlight)
{
  expectFault(spoil(dampedFlight(),
                    [](checker::Run& run) {
                      run.states[500].position = run.states[499].position;
                      run.states[500].angle = run.states[499].angle;
                    }),
              { "flight.position" }, { "energy.columns", "momentum.linear", "energy.no_gain" });
}

TEST(CheckerFaults, VelocityOffByOnePartInAMillion)
{
  expectFault(spoil(thrust(), [](checker::Run& run) { run.states[1001].velocity.x() += 1e-9; }), { "flight.velocity" },
              { "momentum.linear" });
}

TEST(CheckerFaults, LostImpactRow)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { run.contacts.clear(); }),
              { "flight.velocity", "energy.impact_loss" }, { "flight.position" });
}

TEST(CheckerFaults, LostStateRow)
{
  const Case item = offCentreHit(0.5);
  Texts texts = write(build(item), checker::parseScene(item.scene));
  const size_t row = texts.states.find("\n", 300) + 1;
  texts.states.erase(row, texts.states.find('\n', row) + 1 - row);
  expectFault(judge(item.scene, texts), { "file.rows" }, {});
}

TEST(CheckerFaults, LostEnergyRow)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { run.energy.pop_back(); }), { "file.times" }, {});
}

TEST(CheckerFaults, TimesThatDoNotGrow)
{
  expectFault(spoil(flatDrop(0.5), [](checker::Run& run) { std::swap(run.contacts[0], run.contacts[4]); }),
              { "file.times" }, {});
}

TEST(CheckerFaults, UnknownNamesAndKinds)
{
  const Case item = offCentreHit(0.5);
  for (const std::string word : { ",a,b,", ",impact," })
  {
    Texts texts = write(build(item), checker::parseScene(item.scene));
    texts.contacts.replace(texts.contacts.find(word, 60), 2, ",x");
    expectFault(judge(item.scene, texts), { "file.names" }, {});
  }
}

TEST(CheckerFaults, NotFinite)
{
  for (const double value : { double(NAN), double(INFINITY) })
  {
    expectFault(spoil(offCentreHit(0.5), [=](checker::Run& run) { run.states[7].angle = value; }), { "file.numbers" },
                {});
    expectFault(spoil(offCentreHit(0.5), [=](checker::Run& run) { impactOf(run).normal_velocity = value; }),
                { "file.numbers" }, {});
  }
}

TEST(CheckerFaults, NotTheSceneThatWasAsked)
{
  Case item = offCentreHit(0.5);
  item.scene.replace(item.scene.find("mass: 2, pose: [0, 0, 0]"), 24, "mass: 2, pose: [0, 0, 0.1]");
  expectFault(spoil(item, nothing), { "start.state" }, {});
}

TEST(CheckerFaults, NormalOfTheWrongSign)
{
  expectFault(spoil(offCentreHit(0.5),
                    [](checker::Run& run) {
                      impactOf(run).normal *= -1.0;
                      impactOf(run).impulse *= -1.0;
                    }),
              { "contact.normal", "contact.sign" }, { "impact.approach", "impact.impulse" });
}

TEST(CheckerFaults, ImpactThatPulls)
{
  expectFault(spoil(flatDrop(0.5), [](checker::Run& run) { impactOf(run).impulse *= -1.0; }),
              { "contact.sign", "replay.linear_momentum", "replay.angular_momentum", "impact.energy" },
              { "replay.position", "energy.impact_loss" });
}

TEST(CheckerFaults, PullBeyondWhatACaptureStandsFor)
{
  const Case item = flatDrop(0.5);
  const double first = item.events.front().time, capture = item.rest_from;
  expectFault(spoil(pullAndPush(item, first, 1e-3), nothing), { "contact.sign" }, {});
  // 1 kg and sqrt(8 x 1e-6 m x 2 x 9.8 m/s^2) = 0.01252 m/s. A pull p at a corner turns the square as well; with the push q at the other corner that comes
  // nearest, (p + q)^2 + 6 (p - q)^2 / 4 is least for q = p / 5, 2.4 p^2: p = 0.00808 N s.
  const auto pull = [&](double impulse) {
    return [=](checker::Run& run) mutable {
      for (ContactRow& row : run.contacts)
        if (row.kind != Kind::Rest && row.time == capture)
          row.impulse = std::exchange(impulse, 0.0);
    };
  };
  EXPECT_EQ(spoil(item, pull(-0.0080)).find("contact.sign")->violations(), 0);
  expectFault(spoil(item, pull(-0.0082)), { "contact.sign" }, { "replay.linear_momentum", "replay.angular_momentum", "rest.bounded" });
}

TEST(CheckerFaults, NormalTiltedAndTooLong)
{
  expectFault(spoil(cornerOnWall(0.5), [](checker::Run& run) { impactOf(run).normal *= 1.0 + 1e-9; }),
              { "contact.unit_normal" },
              { "replay.linear_momentum", "replay.angular_momentum", "impact.restitution", "impact.approach",
                "impact.impulse", "energy.impact_loss", "impact.energy", "replay.position" });
  expectFault(spoil(offCentreHit(0.5),
                    [](checker::Run& run) { impactOf(run).normal = checker::turned(impactOf(run).normal, 1e-4); }),
              { "contact.normal" },
              { "replay.linear_momentum", "replay.angular_momentum", "impact.restitution", "impact.approach",
                "impact.impulse", "energy.impact_loss", "replay.position" });
}

TEST(CheckerFaults, ApproachColumn)
{
  expectFault(spoil(offCentreHit(0.5), [](checker::Run& run) { impactOf(run).normal_velocity *= 1.01; }),
              { "impact.approach" }, {});
}

TEST(CheckerFaults, RestForceThatPulls)
{
  expectFault(spoil(flatDrop(0.5), [](checker::Run& run) { run.contacts.back().impulse *= -1.0; }), { "contact.sign" },
              { "rest.velocity", "rest.position", "energy.balance_error" });
}

TEST(CheckerFaults, RestForceOnePercentOff)
{
  expectFault(spoil(rockingLoad(),
                    [](checker::Run& run) {
                      for (ContactRow& row : run.contacts)
                        row.impulse *= 1.01;
                    }),
              { "rest.velocity" }, { "rest.position" });
}

TEST(CheckerFaults, RestingBlockThatSinks)
{
  Case item = rockingLoad();
  const auto right = item.movers[0].state;
  item.movers[0].state = [=](double t) {
    State state = right(t);
    state.position.y() -= 1e-5 * t * t;
    state.velocity.y() -= 2e-5 * t;
    return state;
  };
  expectFault(spoil(item, nothing), { "rest.normal_speed", "overlap.samples", "contact.normal" },
              { "energy.columns", "energy.balance_error", "rest.velocity", "rest.position", "energy.conserved" });
}

// They may shift it by 9.8 m/s^2 x (1 ms)^2, and the coming to rest by the tolerance of 1e-6 m.
TEST(CheckerFaults, BlockThatJumpsWhereItComesToRest)
{
  Case item = flatDrop(0.5);
  const double from = item.rest_from;
  const auto right = item.movers[0].state;
  item.movers[0].state = [=](double t) {
    State state = right(t);
    state.position.x() += t >= from ? 1.2e-5 : 0.0;
    return state;
  };
  const auto rows = item.update_rests;
  item.update_rests = [=](double t, std::vector<ContactRow>& rests) {
    rows(t, rests);
    for (ContactRow& rest : rests)
      rest.point.x() += 1.2e-5;
  };
  expectFault(spoil(item, nothing), { "rest.bounded" }, {});
}

// Until the hit contact forces may have to balance what damping takes, 0.04 N s/m x 2.98 m/s x 0.224 ms / 1 kg = 0.0267 mm/s.
TEST(CheckerFaults, VelocityFromNowhereWhereForcesChange)
{
  EXPECT_EQ(spoil(brakedIntoWall(2e-5), nothing).find("rest.bounded")->violations(), 0);
  expectFault(spoil(brakedIntoWall(3e-5), nothing), { "rest.bounded" },
              { "rest.velocity", "rest.position", "rest.normal_speed", "contact.point", "energy.balance_error" });
}

// Where it comes to rest, contact forces may undo its weight for the interval, sqrt(m) x 9.8 m/s^2 x 1 ms: 9.8 mm/s. Upwards they do for the
// last 0.795 ms, 7.8 mm/s, which leaves 5.9 mm/s sideways. They may turn it by that over sqrt(1/6 m^2), and as the samples show moments of
// 2 x 4.9 N x 0.5 m about it, by 4.9 N m x 1 ms / (1/6 kg m^2) = 29 mrad/s.
TEST(CheckerFaults, MotionFromNowhereWhereABlockComesToRest)
{
  const auto faster = [](double along, double turning) {
    return spoil(flatDrop(0.5), [=](checker::Run& run) {
      run.states[1652].velocity.x() += along;
      run.states[1652].omega += turning;
    });
  };
  for (const auto& report : { faster(0.0055, 0.0), faster(0.0, 0.028) })
    EXPECT_EQ(report.find("rest.bounded")->violations(), 0) << failures(report);
  for (const auto& report : { faster(0.0065, 0.0), faster(0.0, 0.031) })
    expectFault(report, { "rest.bounded" },
                { "rest.velocity", "rest.position", "rest.normal_speed", "energy.columns", "energy.no_gain", "energy.balance_error" });
}

// 1e-11 of the 5 J of gravity's energy go unseen.
TEST(CheckerFaults, WorkOfARestingBlock)
{
  const auto shift = [](double EnergyRow::*column, double by) {
    return [=](checker::Run& run) {
      run.energy[30].*column += by;
      run.energy[30].balance_error += column == &EnergyRow::damping_loss ? by : -by;
    };
  };
  expectFault(spoil(brakedSlider(), shift(&EnergyRow::damping_loss, 2e-10)), { "energy.damping_loss" }, {});
  expectFault(spoil(brakedSlider(), shift(&EnergyRow::thrust_work, 2e-10)), { "energy.thrust_work" }, {});
}

TEST(CheckerFaults, RestThatIsNeverQuiet)
{
  Case item = rockingLoad();
  for (int k = 0; k < 400; ++k)
    item.events.push_back(row(0.001 * k + 0.0005, Kind::RestBegin, 0, 1,
                              Vec2(item.movers[0].state(0.001 * k + 0.0005).position.x(), 0), Vec2(0, 1), 0, 0));
  expectFault(spoil(item, nothing), { "coverage.unjudged" }, {});
}

TEST(CheckerFaults, RestThatEndsUnannounced)
{
  Case item = rockingLoad();
  checker::Run run = build(item);
  run.contacts.resize(run.contacts.size() / 4 * 2);
  const checker::Report report = judge(item, run);
  expectFault(report, { "rest.announced", "flight.velocity" }, { "flight.position" });
}

TEST(CheckerFaults, EnergyColumns)
{
  const auto edit = [](double EnergyRow::*column, double by) {
    return [=](checker::Run& run) { run.energy[300].*column += by; };
  };
  const auto both = [](double EnergyRow::*column, double by) {
    return [=](checker::Run& run) {
      run.energy[300].*column += by;
      run.energy[300].balance_error += by;
    };
  };
  const Case item = offCentreHit(0.5);
  expectFault(spoil(item, edit(&EnergyRow::translational, 1e-6)), { "energy.columns", "energy.total" }, {});
  expectFault(spoil(item, edit(&EnergyRow::spring, 1e-6)), { "energy.columns", "energy.total" }, {});
  expectFault(spoil(item, edit(&EnergyRow::total, 1e-6)), { "energy.total", "energy.balance" }, {});
  expectFault(spoil(item, edit(&EnergyRow::balance_error, 1e-10)), { "energy.balance" }, {});
  expectFault(spoil(item, both(&EnergyRow::damping_loss, 1e-6)),
              { "energy.damping_loss", "energy.losses", "energy.balance_error" }, {});
  expectFault(spoil(item, both(&EnergyRow::impact_loss, 1e-6)),
              { "energy.impact_loss", "energy.losses", "energy.balance_error" }, {});
  expectFault(spoil(item, edit(&EnergyRow::thrust_work, 1e-6)), { "energy.thrust_work", "energy.balance" },
              { "energy.no_gain" });
  expectFault(spoil(item, edit(&EnergyRow::command_work, -1e-6)), { "energy.command_work", "energy.balance" },
              { "energy.no_gain" });
}

}  // namespace
}  // namespace exact
