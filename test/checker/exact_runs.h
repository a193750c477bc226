#pragma once

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "check.h"

// Runs in closed form for the checker's own tests, written out as `simulate` writes them. Nothing here integrates or
// detects anything: every motion, impulse and force is a formula worked out by hand.

namespace exact
{
using checker::ContactRow;
using checker::EnergyRow;
using checker::Kind;
using checker::Run;
using checker::State;
using checker::Vec2;
using OfTime = std::function<double(double)>;

inline double zero(double)
{
  return 0.0;
}

/// Motion of one block with mass and moment of inertia.
struct Mover
{
  double mass, inertia;
  std::function<State(double)> state;
};

/// A scene with the run that follows from it.
struct Case
{
  std::string scene;
  std::vector<Mover> movers;  ///< all blocks of the scene, in its order
  std::vector<ContactRow> events;
  std::vector<ContactRow> rests;  ///< written at every sample from rest_from on; `time` is not used
  std::function<void(double, std::vector<ContactRow>&)> update_rests;
  double rest_from = INFINITY;
  double duration = 1.0;
  OfTime gravity = zero, spring = zero, thrust_work = zero, spring_work = zero, command_work = zero,
         damping_loss = zero, impact_loss = zero;
};

inline State stateOf(double x, double y, double angle, double vx, double vy, double omega)
{
  return { Vec2(x, y), angle, Vec2(vx, vy), omega };
}

inline State freeFlight(const State& from, double span, double gravity)
{
  State state = from;
  state.position += span * from.velocity - Vec2(0, 0.5 * gravity * span * span);
  state.angle += span * from.omega;
  state.velocity.y() -= gravity * span;
  return state;
}

inline ContactRow row(double time, Kind kind, int a, int b, const Vec2& point, const Vec2& normal, double speed,
                      double impulse)
{
  return { time, kind, a, b, point, normal, speed, impulse };
}

inline Run build(const Case& item, double step = 0.001)
{
  Run run;
  run.bodies = item.movers.size();
  std::vector<ContactRow> rests = item.rests;
  size_t event = 0;
  const int samples = static_cast<int>(std::lround(item.duration / step));
  for (int k = 0; k <= samples; ++k)
  {
    EnergyRow energy;
    energy.time = k * std::lround(step * 1e9) / 1e9;
    run.times.push_back(energy.time);
    for (const Mover& mover : item.movers)
    {
      const State state = mover.state(energy.time);
      run.states.push_back(state);
      energy.gravity += mover.mass * item.gravity(energy.time) * state.position.y();
      energy.translational += 0.5 * mover.mass * state.velocity.squaredNorm();
      energy.rotational += 0.5 * mover.inertia * state.omega * state.omega;
    }
    energy.spring = item.spring(energy.time);
    energy.total = energy.gravity + energy.spring + energy.translational + energy.rotational;
    energy.thrust_work = item.thrust_work(energy.time);
    energy.spring_work = item.spring_work(energy.time);
    energy.command_work = item.command_work(energy.time);
    energy.damping_loss = item.damping_loss(energy.time);
    energy.impact_loss = item.impact_loss(energy.time);
    run.energy.push_back(energy);
    while (event < item.events.size() && item.events[event].time <= energy.time)
      run.contacts.push_back(item.events[event++]);
    if (energy.time < item.rest_from)
      continue;
    if (item.update_rests)
      item.update_rests(energy.time, rests);
    for (ContactRow& rest : rests)
    {
      rest.time = energy.time;
      run.contacts.push_back(rest);
    }
  }
  for (EnergyRow& energy : run.energy)
    energy.balance_error = energy.total - run.energy[0].total - energy.thrust_work - energy.spring_work -
                           energy.command_work + energy.damping_loss + energy.impact_loss;
  return run;
}

/// The three files as text.
struct Texts
{
  std::string states, energy, contacts;
};

inline Texts write(const Run& run, const checker::Scene& scene)
{
  std::ostringstream states, energy, contacts;
  for (std::ostringstream* out : { &states, &energy, &contacts })
    out->precision(17);
  states << "time,block,x,y,angle,vx,vy,omega\n";
  for (size_t i = 0; i < run.states.size(); ++i)
  {
    const State& s = run.states[i];
    states << run.times[i / run.bodies] << ',' << scene.name(static_cast<int>(i % run.bodies)) << ',' << s.position.x()
           << ',' << s.position.y() << ',' << s.angle << ',' << s.velocity.x() << ',' << s.velocity.y() << ','
           << s.omega << '\n';
  }
  energy << "time,gravity,spring,translational,rotational,total,thrust_work,spring_work,command_work,damping_loss,"
            "impact_loss,"
            "balance_error\n";
  for (const EnergyRow& e : run.energy)
    energy << e.time << ',' << e.gravity << ',' << e.spring << ',' << e.translational << ',' << e.rotational << ','
           << e.total << ',' << e.thrust_work << ',' << e.spring_work << ',' << e.command_work << ',' << e.damping_loss
           << ',' << e.impact_loss << ',' << e.balance_error << '\n';
  contacts << "time,kind,a,b,x,y,nx,ny,normal_velocity,impulse\n";
  const char* kinds[] = { "impact", "rest_begin", "rest_end", "rest" };
  for (const ContactRow& c : run.contacts)
    contacts << c.time << ',' << kinds[static_cast<int>(c.kind)] << ',' << scene.name(c.a) << ',' << scene.name(c.b)
             << ',' << c.point.x() << ',' << c.point.y() << ',' << c.normal.x() << ',' << c.normal.y() << ','
             << c.normal_velocity << ',' << c.impulse << '\n';
  return { states.str(), energy.str(), contacts.str() };
}

inline checker::Report judge(const std::string& scene_text, const Texts& texts)
{
  const checker::Scene scene = checker::parseScene(scene_text);
  checker::Report report;
  const Run run = checker::parseRun(texts.states, texts.energy, texts.contacts, scene, report);
  checker::checkRun(scene, run, report);
  return report;
}

inline checker::Report judge(const Case& item, const Run& run)
{
  return judge(item.scene, write(run, checker::parseScene(item.scene)));
}

/// Names of the checks that failed, with their worst values.
inline std::string failures(const checker::Report& report)
{
  std::string names;
  for (const checker::Check& check : report.checks())
  {
    if (check.violations() > 0)
      names += check.name() + " (" + std::to_string(check.value()) + " of " + std::to_string(check.limit()) + " at " +
               std::to_string(check.time()) + ") ";
  }
  return names;
}

}  // namespace exact
