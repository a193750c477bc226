#include "diagnostics.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr std::int64_t PERIOD = 1000000000;  // ns

// Share of all energy turned over. Rounding stays below 1e-12 of it and a plot shows 1e-3: between the two an account
// that does not balance is an error of the simulation that nobody has seen yet.
constexpr double UNBALANCED = 1e-6;

double turnover(const EnergyAccount& energy)
{
  return std::max({ std::fabs(energy.gravity), energy.spring, energy.translational, energy.rotational,
                    std::fabs(energy.thrust_work), std::fabs(energy.spring_work), std::fabs(energy.command_work),
                    energy.damping_loss, energy.impact_loss });
}

}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& handle) : updater_(handle, handle)
{
  updater_.setHardwareID("none");
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  updater_.add("pace", [this](Status& status) { tellPace(status); });
  updater_.add("accuracy", [this](Status& status) { tellAccuracy(status); });
}

void Diagnostics::restart(std::int64_t simulated, std::int64_t clock)
{
  since_simulated_ = simulated;
  since_clock_ = clock;
}

bool Diagnostics::isDue(std::int64_t clock) const
{
  return clock >= sent_at_ + PERIOD;
}

void Diagnostics::publish(const World& world, const Pace& pace)
{
  world_ = &world;
  pace_ = pace;
  const std::vector<IslandCost> islands = meter_.read(world);
  slowest_ = islands.empty() ? "none" : islands.front().describe(world.now() - metered_);
  metered_ = world.now();
  updater_.force_update();
  sent_at_ = pace.clock;
  restart(pace.simulated, pace.clock);
  events_ = world.statistics().events;
  lost_ = pace.lost;
}

void Diagnostics::tellPace(diagnostic_updater::DiagnosticStatusWrapper& status) const
{
  const Statistics& statistics = world_->statistics();
  const double simulated = static_cast<double>(pace_.simulated - since_simulated_) * 1e-9;
  const double passed = static_cast<double>(pace_.clock - since_clock_) * 1e-9;
  const double lost = pace_.lost - lost_;
  if (statistics.mode != "exact")
    status.summaryf(DiagnosticStatus::ERROR, "%s; reset, or load another scene", statistics.mode.c_str());
  else if (pace_.paused)
    status.summary(DiagnosticStatus::OK, "paused");
  else if (lost > 0.0)
    status.summaryf(DiagnosticStatus::WARN, "too slow by %.3g s in the last second: take a lower real_time_factor; %s",
                    lost, slowest_.c_str());
  else if (pace_.late > 0.0)
    status.summaryf(DiagnosticStatus::WARN, "%.3g s behind /clock: its owner should take a lower real_time_factor; %s",
                    pace_.late, slowest_.c_str());
  else
    status.summary(DiagnosticStatus::OK, "running");

  if (pace_.follows)
    status.add("real-time factor asked for", "follows /clock");
  else if (pace_.asked == 0.0)
    status.add("real-time factor asked for", "as fast as possible");
  else
    status.add("real-time factor asked for", pace_.asked);
  status.add("real-time factor reached", pace_.paused || passed <= 0.0 ? 0.0 : simulated / passed);
  status.add("simulated time (s)", static_cast<double>(pace_.simulated) * 1e-9);
  status.add("simulated time lost (s)", pace_.lost);
  // A scene that was loaded meanwhile counts from 0.
  const std::int64_t events = statistics.events - (statistics.events < events_ ? 0 : events_);
  status.add("events per simulated second", simulated > 0.0 ? static_cast<double>(events) / simulated : 0.0);
  status.add("events", statistics.events);
  status.add("impacts", statistics.impacts);
  status.add("slowest island", slowest_);
  status.add("blocks", world_->bodyCount());
  status.add("mode", statistics.mode);
}

void Diagnostics::tellAccuracy(diagnostic_updater::DiagnosticStatusWrapper& status) const
{
  const EnergyAccount energy = world_->energy();
  const double overlap = world_->statistics().worst_overlap, tolerance = world_->scene().tolerance;
  if (!std::isfinite(energy.total) || !std::isfinite(energy.balance_error))
    status.summary(DiagnosticStatus::ERROR, "the energy is not finite: reset, or load a scene with smaller numbers");
  else if (std::fabs(energy.balance_error) > UNBALANCED * turnover(energy))
    status.summary(DiagnosticStatus::WARN, "the energy account does not balance: do not trust what follows");
  else if (overlap >= tolerance)
    status.summary(DiagnosticStatus::WARN, "blocks have overlapped by the tolerance or more");
  else
    status.summary(DiagnosticStatus::OK, "exact");
  status.add("worst overlap (m)", overlap);
  status.add("tolerance (m)", tolerance);
  status.add("balance error (J)", energy.balance_error);
  status.add("total energy (J)", energy.total);
}

}  // namespace block_world
