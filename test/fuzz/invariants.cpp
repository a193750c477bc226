#include <algorithm>
#include <cmath>
#include <sstream>

#include "fuzz.h"

namespace block_world
{
namespace fuzz
{
namespace
{
bool finite(const MotionState& state)
{
  return state.position.allFinite() && state.velocity.allFinite() && std::isfinite(state.angle) &&
         std::isfinite(state.omega);
}

/// Sum of the sizes of everything that the balance adds up.
double sizeOf(const EnergyAccount& energy)
{
  double size = 0.0;
  for (const double part : { energy.gravity, energy.spring, energy.translational, energy.rotational, energy.thrust_work,
                             energy.spring_work, energy.command_work, energy.damping_loss, energy.impact_loss })
    size += std::abs(part);
  return size;
}

std::string complaint(const World& world, const std::string& what, double value, double limit)
{
  std::ostringstream text;
  text.precision(17);
  text << what << " " << value << ", allowed " << limit << ", at " << world.now().seconds() << " s after "
       << world.statistics().events << " events";
  return text.str();
}
}  // namespace

std::string Invariants::check(const World& world)
{
  for (int i = 0; i < world.bodyCount(); ++i)
    if (!finite(world.state(i)))
      return "the state of '" + world.name(i) + "' is not finite";
  if (world.statistics().mode != "exact")
    return world.statistics().mode;
  // Separating distances are differences of coordinates: rounding on top of the tolerance.
  const double deepest = std::max(world.overlap(), world.statistics().worst_overlap);
  const double allowed = world.scene().tolerance * (1.0 + 1e-6);
  if (!(deepest <= allowed))
    return complaint(world, "overlap", deepest, allowed);
  const EnergyAccount energy = world.energy();
  scale_ = std::max(scale_, sizeOf(energy));
  // A thousand events and some sixty arcs between them, each rounding a few times: 1e-16 x 1e5, with a margin of ten. A
  // block that was put into another one by less than the tolerance is lifted out: that work is a negative loss, and
  // that of forces that store no energy is not balanced. The forces are the energies over a decimetre at most.
  const double error = (1e-10 + placed_ * world.scene().tolerance * 10.0) * scale_;
  if (!(std::abs(energy.balance_error) <= error))
    return complaint(world, "balance error", energy.balance_error, error);
  for (const double loss : { energy.impact_loss, energy.damping_loss })
    if (!(loss >= -error))
      return complaint(world, "gain by an impact or by damping", -loss, error);
  return std::string();
}

}  // namespace fuzz
}  // namespace block_world
