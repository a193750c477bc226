#include "energy.h"

#include <algorithm>

#include "limits.h"

namespace checker
{
namespace
{
struct EnergyChecks
{
  explicit EnergyChecks(Report& report)
    : columns(report.check("energy.columns", "energies recomputed from the states, J"))
    , total(report.check("energy.total", "total is the sum of its parts, J"))
    , formula(report.check("energy.balance", "balance_error follows from the other columns, J"))
    , balance(report.check("energy.balance_error", "energy that appeared or went unaccounted, J"))
    , losses(report.check("energy.losses", "losses never shrink, J"))
    , gain(report.check("energy.no_gain", "total less the work put in never grows, J"))
    , thrust(report.check("energy.thrust_work", "work of thrusters and wrenches recomputed, J per interval"))
    , command(report.check("energy.command_work", "jumps by commands and mouse springs recomputed, J per interval"))
    , damping(report.check("energy.damping_loss", "loss to damping recomputed, J per interval"))
    , impact(report.check("energy.impact_loss", "loss in impacts recomputed, J per interval"))
    , conserved(report.check("energy.conserved", "total of an elastic undamped run without inputs, relative"))
  {
  }
  Check &columns, &total, &formula, &balance, &losses, &gain, &thrust, &command, &damping, &impact, &conserved;
};

/// Elastic, undamped and left alone: the energy can only stay.
bool conservative(const Scene& scene)
{
  const auto elastic = [&](const Block& block) { return block.elasticity.value_or(scene.elasticity) == 1.0; };
  const auto undamped = [](const Spring& spring) { return spring.damping == 0.0; };
  return scene.inputs.empty() && scene.damping == 0.0 && scene.elasticity == 1.0 &&
         std::all_of(scene.blocks.begin(), scene.blocks.end(), elastic) &&
         std::all_of(scene.springs.begin(), scene.springs.end(), undamped);
}

EnergyRow recompute(const Scene& scene, const Motion& motion, const Drive& drive, const std::vector<State>& states)
{
  EnergyRow row;
  for (size_t i = 0; i < states.size(); ++i)
  {
    const int body = static_cast<int>(i);
    if (!scene.movable(body))
      continue;
    row.gravity += motion.gravityEnergy(drive, body, states[i]);
    row.translational += 0.5 * drive.bodies[i].mass * states[i].velocity.squaredNorm();
    row.rotational += 0.5 * motion.inertia(drive, body) * states[i].omega * states[i].omega;
  }
  row.spring = motion.sceneSpringEnergy(states) + motion.mouseSpringEnergy(drive, states);
  return row;
}

/// Size of the numbers that are added up, whose rounding limits every comparison.
double scaleOf(const EnergyRow& row)
{
  return std::abs(row.gravity) + row.spring + row.translational + row.rotational;
}

/// The columns of one row against the states and each other. Returns the row's scale.
double checkRow(const EnergyRow& row, const EnergyRow& first, const EnergyRow& wanted, EnergyChecks& checks)
{
  const double scale = std::max({ 1.0, scaleOf(wanted), std::abs(first.total), std::abs(row.thrust_work),
                                  std::abs(row.spring_work), std::abs(row.command_work) });
  const double rounding = relative_error * scale;
  checks.columns.add(
      std::max({ std::abs(row.gravity - wanted.gravity), std::abs(row.spring - wanted.spring),
                 std::abs(row.translational - wanted.translational), std::abs(row.rotational - wanted.rotational) }),
      rounding, row.time);
  checks.total.add(std::abs(row.gravity + row.spring + row.translational + row.rotational - row.total), rounding,
                   row.time);
  const double balance = row.total - first.total - row.thrust_work - row.spring_work - row.command_work +
                         row.damping_loss + row.impact_loss;
  checks.formula.add(std::abs(balance - row.balance_error), rounding, row.time);
  checks.balance.add(std::abs(row.balance_error), 1e-9 * scale, row.time);
  return scale;
}

/// How the account moved over one interval.
void checkStep(const EnergyRow& before, const EnergyRow& row, const Account& account, double scale,
               EnergyChecks& checks)
{
  const double rounding = relative_error * scale;
  checks.losses.add(std::max(before.damping_loss - row.damping_loss, before.impact_loss - row.impact_loss), rounding,
                    row.time);
  if (!account.known)
    return;
  const double limit = 10.0 * rounding;
  checks.thrust.add(std::abs(row.thrust_work - before.thrust_work - account.thrust), limit + account.thrust_error, row.time);
  checks.command.add(std::max(std::abs(row.spring_work - before.spring_work - account.spring),
                              std::abs(row.command_work - before.command_work - account.command)),
                     limit, row.time);
  checks.damping.add(std::abs(row.damping_loss - before.damping_loss - account.damping), limit + account.damping_error, row.time);
  checks.impact.add(std::abs(row.impact_loss - before.impact_loss - account.impact), limit, row.time);
}
}  // namespace

void checkEnergy(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion, Replay& replay,
                 Report& report)
{
  EnergyChecks checks(report);
  const bool kept = conservative(scene);
  double lowest = 0.0, largest_scale = 0.0;
  for (size_t k = 0; k < run.times.size(); ++k)
  {
    const EnergyRow& row = run.energy[k];
    const std::vector<State> states(run.states.begin() + k * run.bodies, run.states.begin() + (k + 1) * run.bodies);
    const EnergyRow wanted = recompute(scene, motion, timeline.at(run.times[k]), states);
    const double scale = checkRow(row, run.energy[0], wanted, checks);
    largest_scale = std::max(largest_scale, scaleOf(wanted));
    const double own = wanted.gravity + wanted.spring + wanted.translational + wanted.rotational;
    const double rest = own - row.thrust_work - row.spring_work - row.command_work;
    lowest = k == 0 ? rest : std::min(lowest, rest);
    checks.gain.add(rest - lowest, 1e-9 * scale, row.time);
    if (kept)
      checks.conserved.add(std::abs(row.total - run.energy[0].total) / std::max(largest_scale, 1e-12), 1e-9, row.time);
    if (k > 0)
      checkStep(run.energy[k - 1], row, replay.account(k), scale, checks);
  }
}
}  // namespace checker
