#pragma once

#include <algorithm>

#include "exact_runs.h"

// The cases: formulas only.

namespace exact
{
/// Free flights strung together.
struct Pieces
{
  double gravity = 0.0;
  std::vector<std::pair<double, State>> starts;

  State operator()(double time) const
  {
    size_t i = starts.size() - 1;
    while (i > 0 && starts[i].first > time)
      --i;
    return freeFlight(starts[i].second, time - starts[i].first, gravity);
  }
};

/// Sum of the steps whose time has come.
struct Steps
{
  std::vector<std::pair<double, double>> steps;

  double operator()(double time) const
  {
    double sum = 0.0;
    for (const auto& step : steps)
      sum += step.first <= time ? step.second : 0.0;
    return sum;
  }
};

inline void flatRows(Case& item, double time, Kind kind, double x, double speed, double impulse)
{
  for (const double side : { -0.5, 0.5 })
    item.events.push_back(row(time, kind, 0, 1, Vec2(x + side, 0), Vec2(0, 1), -speed, 0.5 * impulse));
}

/// A square of side 1 and mass 1 dropped flat from height 2, sliding sideways: both lower corners hit at once. The
/// first bounce slower than `capture` is the last one; then it slides on the floor.
inline Case flatDrop(double e, double capture = 0.05)
{
  Case item;
  item.scene = "{gravity: 9.8, elasticity: " + std::to_string(e) +
               ", walls: {bottom: 0}, blocks: [{name: box, size: [1, 1], pose: [0, 2, 0], velocity: [0.5, 0, 0]}]}";
  item.duration = 2.5;
  item.gravity = [](double) { return 9.8; };
  Pieces flight{ 9.8, { { 0.0, stateOf(0, 2, 0, 0.5, 0, 0) } } };
  Pieces sliding{ 0.0, {} };
  Steps loss;
  double time = std::sqrt(2 * 1.5 / 9.8), speed = 9.8 * time;
  while (time < item.duration)
  {
    const bool last = speed < capture;
    const double out = last ? 0.0 : e * speed;
    flatRows(item, time, last ? Kind::RestBegin : Kind::Impact, 0.5 * time, speed, speed + out);
    loss.steps.emplace_back(time, 0.5 * (speed * speed - out * out));
    if (last)
    {
      sliding.starts.emplace_back(time, stateOf(0.5 * time, 0.5, 0, 0.5, 0, 0));
      item.rest_from = time;
      break;
    }
    flight.starts.emplace_back(time, stateOf(0.5 * time, 0.5, 0, 0.5, out, 0));
    time += 2 * out / 9.8;
    speed = out;
  }
  item.rests = { row(0, Kind::Rest, 0, 1, Vec2(0, 0), Vec2(0, 1), 0, 4.9),
                 row(0, Kind::Rest, 0, 1, Vec2(0, 0), Vec2(0, 1), 0, 4.9) };
  item.update_rests = [](double t, std::vector<ContactRow>& rests) {
    rests[0].point.x() = 0.5 * t - 0.5;
    rests[1].point.x() = 0.5 * t + 0.5;
  };
  const double from = item.rest_from;
  item.movers = { { 1.0, 1.0 / 6.0, [=](double t) { return t < from ? flight(t) : sliding(t); } } };
  item.impact_loss = loss;
  return item;
}

/// The same run with an impulse and its opposite added at one of its events.
inline Case pullAndPush(Case item, double time, double impulse)
{
  size_t i = 0;
  while (item.events[i].time < time)
    ++i;
  ContactRow extra = item.events[i];
  extra.kind = Kind::Impact;
  for (const double sign : { -1.0, 1.0 })
  {
    extra.impulse = sign * impulse;
    item.events.insert(item.events.begin() + i, extra);
  }
  return item;
}

/// A tilted square flies into the long side of a heavier block, off both centres, without gravity. `factor` spoils the
/// elasticity.
inline Case offCentreHit(double e, double factor = 1.0)
{
  Case item;
  item.scene = "{elasticity: " + std::to_string(e) +
               ", blocks: [{name: a, size: [1, 1], pose: [-2, 0.7, 0.3], velocity: [1, 0.1, 0]},"
               " {name: b, size: [1, 3], mass: 2, pose: [0, 0, 0], elasticity: 1}]}";
  item.duration = 1.0;
  const Vec2 corner(0.5 * std::cos(0.3) + 0.5 * std::sin(0.3), 0.5 * std::sin(0.3) - 0.5 * std::cos(0.3));
  const double hit = 2 - 0.5 - corner.x();
  const Vec2 centre(-2 + hit, 0.7 + 0.1 * hit), point = centre + corner;
  const double inertia_a = 1.0 / 6.0, inertia_b = 2 * 10.0 / 12.0;
  // normal (-1, 0): arm x normal is the arm's y
  const double j =
      (1 + e * factor) / (1 + 0.5 + corner.y() * corner.y() / inertia_a + point.y() * point.y() / inertia_b);
  item.events = { row(hit, Kind::Impact, 0, 1, point, Vec2(-1, 0), -1, j) };
  const Pieces a{ 0,
                  { { 0, stateOf(-2, 0.7, 0.3, 1, 0.1, 0) },
                    { hit, stateOf(centre.x(), centre.y(), 0.3, 1 - j, 0.1, corner.y() * j / inertia_a) } } };
  const Pieces b{
    0, { { 0, stateOf(0, 0, 0, 0, 0, 0) }, { hit, stateOf(0, 0, 0, j / 2, 0, -point.y() * j / inertia_b) } }
  };
  item.movers = { { 1, inertia_a, a }, { 2, inertia_b, b } };
  item.impact_loss = Steps{ { { hit, 0.5 * j * (1 - e * factor) } } };
  return item;
}

/// A block flies at the right wall and turns while it does; `through` leaves the wall out.
inline Case cornerOnWall(double e, bool through = false)
{
  Case item;
  item.scene = "{elasticity: 1, walls: {right: 1}, blocks: [{name: a, size: [1, 1], pose: [-0.5, 0, 0.3], velocity: "
               "[2, 0, 0]}],"
               " inputs: [{time: 0.1, set: {elasticity: " +
               std::to_string(e) + "}}]}";
  const Vec2 corner(0.5 * std::cos(0.3) + 0.5 * std::sin(0.3), 0.5 * std::sin(0.3) - 0.5 * std::cos(0.3));
  const double hit = (1.5 - corner.x()) / 2, inertia = 1.0 / 6.0;
  const double j = 2 * (1 + e) / (1 + corner.y() * corner.y() / inertia);
  Pieces a{ 0, { { 0, stateOf(-0.5, 0, 0.3, 2, 0, 0) } } };
  item.movers = { { 1, inertia, a } };
  item.duration = through ? 0.6 : 0.47;
  if (through)
    return item;
  a.starts.emplace_back(hit, stateOf(1 - corner.x(), 0, 0.3, 2 - j, 0, corner.y() * j / inertia));
  item.movers[0].state = a;
  item.events = { row(hit, Kind::Impact, 0, 1, Vec2(1, corner.y()), Vec2(-1, 0), -2, j) };
  item.impact_loss = Steps{ { { hit, 0.5 * j * 2 * (1 - e) } } };
  return item;
}

/// A falling tilted square drifts into the wall and does not bounce at all, whatever its elasticity.
inline Case slowHit(double speed)
{
  Case item;
  item.scene = "{gravity: 9.8, elasticity: 0.8, walls: {right: 0}, blocks: [{name: a, size: [1, 1], pose: [-1, 0, "
               "0.3], velocity: [" +
               std::to_string(speed) + ", 0, 0]}]}";
  const Vec2 corner(0.5 * std::cos(0.3) + 0.5 * std::sin(0.3), 0.5 * std::sin(0.3) - 0.5 * std::cos(0.3));
  const double start = -corner.x() - 0.1 * speed, hit = 0.1, inertia = 1.0 / 6.0, drop = 0.5 * 9.8 * hit * hit;
  std::ostringstream place;
  place.precision(17);
  place << "pose: [" << start;
  item.scene.replace(item.scene.find("pose: [-1"), 9, place.str());
  const double j = speed / (1 + corner.y() * corner.y() / inertia);
  item.movers = {
    { 1, inertia,
      Pieces{ 9.8,
              { { 0, stateOf(start, 0, 0.3, speed, 0, 0) },
                { hit, stateOf(-corner.x(), -drop, 0.3, speed - j, -9.8 * hit, corner.y() * j / inertia) } } } }
  };
  item.duration = 0.2;
  item.gravity = [](double) { return 9.8; };
  item.events = { row(hit, Kind::Impact, 0, 1, Vec2(0, corner.y() - drop), Vec2(-1, 0), -speed, j) };
  item.impact_loss = Steps{ { { hit, 0.5 * j * speed } } };
  return item;
}

/// Thrown and spinning in thick air.
inline Case dampedFlight()
{
  Case item;
  item.scene = "{gravity: 9.8, damping: 0.8, blocks: [{name: a, size: [1, 3], mass: 2, pose: [0, 0, 0], velocity: [3, "
               "4, 5]}]}";
  item.gravity = [](double) { return 9.8; };
  const double rate = 0.4, inertia = 2 * 10.0 / 12.0, turning = 0.08 / inertia, fall = 9.8 / rate;
  const auto motion = [=](double t) {
    const double left = std::exp(-rate * t), spent = (1 - left) / rate;
    return stateOf(3 * spent, (4 + fall) * spent - fall * t, 5 * (1 - std::exp(-turning * t)) / turning, 3 * left,
                   (4 + fall) * left - fall, 5 * std::exp(-turning * t));
  };
  const auto energy = [=](double t) {
    const State s = motion(t);
    return s.velocity.squaredNorm() + 0.5 * inertia * s.omega * s.omega + 2 * 9.8 * s.position.y();
  };
  item.movers = { { 2, inertia, motion } };
  item.damping_loss = [=](double t) { return energy(0) - energy(t); };
  return item;
}

/// Constant push from 0.25 to 0.75 along the block by thruster 2, and a couple of thrusters 0 and 5 on another one
/// until the end.
inline Case thrust()
{
  Case item;
  item.scene = "{thrusters: {strength: 1.5}, blocks: [{name: a, size: [1, 3], pose: [0, 0, 0]}, {name: b, size: [3, "
               "1], pose: [9, 0, 0]}],"
               " inputs: [{time: 0.25, thrust: {block: a, levels: [0, 0, 1, 0, 0, 0], duration: 0.5}},"
               " {time: 0.5, thrust: {block: b, levels: [1, 0, 0, 0, 0, 1], duration: 9}}]}";
  const double inertia = 10.0 / 12.0, alpha = 2 * 0.9 * 0.6 / inertia;
  const auto a = [](double t) {
    const double pushed = std::clamp(t, 0.25, 0.75) - 0.25, v = 1.5 * pushed;
    return stateOf(0, 0.5 * v * pushed + v * std::max(0.0, t - 0.75), 0, 0, v, 0);
  };
  const auto b = [=](double t) {
    const double turned = std::max(t, 0.5) - 0.5;
    return stateOf(9, 0, 0.5 * alpha * turned * turned, 0, 0, alpha * turned);
  };
  item.movers = { { 1, inertia, a }, { 1, inertia, b } };
  item.thrust_work = [=](double t) {
    return 0.5 * a(t).velocity.squaredNorm() + 0.5 * inertia * b(t).omega * b(t).omega;
  };
  return item;
}

/// Seized at its centre by a mouse spring at 0.2 (between samples: 0.2003) and let go at 0.9; the gravity of the scene
/// changes at 1.
inline Case mouse()
{
  Case item;
  item.scene = "{blocks: [{name: a, size: [1, 1], pose: [0, 0, 0], velocity: [0, 0, 1]}], inputs: ["
               "{time: 0.2003, spring: {block: a, point: [0, 0], anchor: [1, 2], stiffness: 4, damping: 0}},"
               "{time: 0.9, release: {block: a}}, {time: 1.0, set: {gravity: 3}}]}";
  item.duration = 1.5;
  const auto motion = [](double t) {
    const double held = 2 * (std::clamp(t, 0.2003, 0.9) - 0.2003);
    State s = stateOf(1 - std::cos(held), 2 - 2 * std::cos(held), t, 2 * std::sin(held), 4 * std::sin(held), 1);
    s.position += s.velocity * std::max(0.0, t - 0.9) - Vec2(0, 1.5) * std::pow(std::max(0.0, t - 1), 2);
    s.velocity.y() -= 3 * std::max(0.0, t - 1);
    return s;
  };
  const auto stored = [=](double t) { return 2 * (motion(t).position - Vec2(1, 2)).squaredNorm(); };
  item.movers = { { 1, 1.0 / 6.0, motion } };
  item.gravity = [](double t) { return t >= 1 ? 3.0 : 0.0; };
  item.spring = [=](double t) { return t >= 0.2003 && t < 0.9 ? stored(t) : 0.0; };
  item.spring_work = Steps{ { { 0.2003, stored(0.2003) }, { 0.9, -stored(0.9) } } };
  item.command_work = Steps{ { { 1.0, 3 * motion(1).position.y() } } };
  return item;
}

/// Two blocks swing on a spring between their centres.
inline Case tiedPair()
{
  Case item;
  item.scene = "{blocks: [{name: a, size: [1, 1], pose: [0, 0, 0]}, {name: b, size: [1, 1], mass: 2, pose: [3, 0, 0]}],"
               " springs: [{from: {block: a, point: [0, 0]}, to: {block: b, point: [0, 0]}, stiffness: 6, rest_length: "
               "2.5}]}";
  const auto stretch = [](double t) { return 0.5 * std::cos(3 * t); };
  const auto rate = [](double t) { return -1.5 * std::sin(3 * t); };
  item.movers = {
    { 1, 1.0 / 6.0, [=](double t) { return stateOf(2.0 / 3 * (0.5 - stretch(t)), 0, 0, -2.0 / 3 * rate(t), 0, 0); } },
    { 2, 1.0 / 3.0, [=](double t) { return stateOf(3 + 1.0 / 3 * (stretch(t) - 0.5), 0, 0, 1.0 / 3 * rate(t), 0, 0); } }
  };
  item.spring = [=](double t) { return 3 * stretch(t) * stretch(t); };
  return item;
}

/// Slides to and fro on the floor on a spring above its centre: the load shifts between its two corners.
inline Case rockingLoad()
{
  Case item;
  item.scene = "{gravity: 9.8, elasticity: 0.5, walls: {bottom: 0}, blocks: [{name: a, size: [1, 1], pose: [0.8, 0.5, "
               "0]}],"
               " springs: [{from: {block: a, point: [0, 0.2]}, to: {point: [0, 0.7]}, stiffness: 5, rest_length: 0}]}";
  const double omega = std::sqrt(5.0);
  const auto x = [=](double t) { return 0.8 * std::cos(omega * t); };
  item.movers = { { 1, 1.0 / 6.0,
                    [=](double t) { return stateOf(x(t), 0.5, 0, -0.8 * omega * std::sin(omega * t), 0, 0); } } };
  item.gravity = [](double) { return 9.8; };
  item.spring = [=](double t) { return 2.5 * x(t) * x(t); };
  item.rest_from = 0.0;
  item.rests = { row(0, Kind::Rest, 0, 1, Vec2(0, 0), Vec2(0, 1), 0, 0),
                 row(0, Kind::Rest, 0, 1, Vec2(0, 0), Vec2(0, 1), 0, 0) };
  item.update_rests = [=](double t, std::vector<ContactRow>& rests) {
    rests[0].point.x() = x(t) - 0.5;
    rests[1].point.x() = x(t) + 0.5;
    rests[0].impulse = 4.9 + x(t);
    rests[1].impulse = 4.9 - x(t);
  };
  return item;
}

/// A square of side 1 rests from the start on a floor at height 0, the body of that number, with the same force at both lower corners.
template <class Motion>
void restOnFloor(Case& item, int floor, double force, const Motion& motion)
{
  item.rest_from = 0.0;
  item.rests.assign(2, row(0, Kind::Rest, 0, floor, Vec2(0, 0), Vec2(0, 1), 0, force));
  item.update_rests = [=](double t, std::vector<ContactRow>& rests) {
    rests[0].point.x() = motion(t).position.x() - 0.5;
    rests[1].point.x() = motion(t).position.x() + 0.5;
  };
}

/// Slides to and fro on the floor on a stiff spring, braked and pushed by a wrench: powers change much from sample to sample.
inline Case brakedSlider()
{
  Case item;
  item.scene = "{gravity: 0.01, damping: 2.0e4, walls: {bottom: 0}, blocks: [{name: a, size: [1, 1], mass: 1000, pose: [7.0e-4, 0.5, 0]}],"
               " springs: [{from: {block: a, point: [0, 0]}, to: {point: [0, 0.5]}, stiffness: 1.0e7, rest_length: 0, damping: 2.0e4}],"
               " inputs: [{time: 0, wrench: {block: a, force: [2000, 0]}}]}";
  item.duration = 0.1;
  const double braking = 20.0, omega = std::sqrt(1e4 - braking * braking), centre = 2e-4, start = 5e-4;
  const auto motion = [=](double t) {
    const double left = start * std::exp(-braking * t);
    return stateOf(centre + left * (std::cos(omega * t) + braking / omega * std::sin(omega * t)), 0.5, 0,
                   -left * 1e4 / omega * std::sin(omega * t), 0, 0);
  };
  const auto stored = [=](double t) { return 5e6 * std::pow(motion(t).position.x(), 2); };
  item.movers = { { 1000, 1000 / 6.0, motion } };
  item.gravity = [](double) { return 0.01; };
  item.spring = stored;
  item.thrust_work = [=](double t) { return 2000 * (motion(t).position.x() - motion(0).position.x()); };
  item.damping_loss = [=, work = item.thrust_work](double t) {
    return stored(0) + work(t) - stored(t) - 500 * motion(t).velocity.squaredNorm();
  };
  restOnFloor(item, 1, 5, motion);
  return item;
}

/// Slides to and fro on the floor on a stiff spring. Where it starts, the parts of orders 4 and 5 of its acceleration's integral over the first
/// sample interval, 19/720 of the fourth difference and 3/160 of the fifth one (Adams and Moulton), cancel.
inline Case cancellingDifferences()
{
  Case item;
  const double omega = 100.0, turn = omega * 0.001, s = 2 * std::sin(turn / 2), c4 = 19.0 / 720, c5 = 3.0 / 160 * s;
  const double start = std::atan(-(c4 + c5 * std::sin(turn / 2)) / (c5 * std::cos(turn / 2))) - 2 * turn;
  const auto motion = [=](double t) {
    return stateOf(5e-4 * std::cos(omega * t + start), 0.5, 0, -0.05 * std::sin(omega * t + start), 0, 0);
  };
  std::ostringstream scene;
  scene.precision(17);
  scene << "{gravity: 1, walls: {bottom: 0}, blocks: [{name: a, size: [1, 1], pose: [" << motion(0).position.x() << ", 0.5, 0], velocity: ["
        << motion(0).velocity.x() << ", 0, 0]}], springs: [{from: {block: a, point: [0, 0]}, to: {point: [0, 0.5]}, stiffness: 1.0e4, "
        << "rest_length: 0}]}";
  item.scene = scene.str();
  item.movers = { { 1, 1.0 / 6.0, motion } };
  item.duration = 0.1;
  item.gravity = [](double) { return 1.0; };
  item.spring = [=](double t) { return 5e3 * std::pow(motion(t).position.x(), 2); };
  restOnFloor(item, 1, 0.5, motion);
  return item;
}

/// Slides weightless on the floor, braked, and hits a wall flat between two samples: all that acts ends with the event. Then it leaves the
/// floor at a speed of `lift`, which nothing explains.
inline Case brakedIntoWall(double lift = 0.0)
{
  Case item;
  item.scene = "{elasticity: 0, damping: 0.04, walls: {bottom: 0, right: 1}, blocks: [{name: a, size: [1, 1], pose: [0, 0.5, 0], "
               "velocity: [3, 0, 0]}]}";
  item.duration = 0.5;
  const double hit = -std::log(1 - 0.04 * 0.5 / 3) / 0.04, speed = 3 - 0.04 * 0.5;
  const auto motion = [=](double t) {
    return t < hit ? stateOf(75 * (1 - std::exp(-0.04 * t)), 0.5, 0, 3 * std::exp(-0.04 * t), 0, 0) :
                     stateOf(0.5, 0.5 + lift * (t - hit), 0, 0, lift, 0);
  };
  item.movers = { { 1, 1.0 / 6.0, motion } };
  for (const double y : { 0.0, 1.0 })
    item.events.push_back(row(hit, Kind::Impact, 0, 1, Vec2(1, y), Vec2(-1, 0), -speed, 0.5 * speed));
  item.damping_loss = [=](double t) { return 4.5 - 0.5 * std::pow(3 - 0.04 * motion(t).position.x(), 2); };
  item.impact_loss = Steps{ { { hit, 0.5 * speed * speed } } };
  restOnFloor(item, 2, 0, motion);
  return item;
}

/// Falls flat on the floor at the start while two walls squeeze it: their impulses undo each other but for the rounding.
inline Case squeezedAtTheStart()
{
  Case item;
  item.scene = "{elasticity: 0, walls: {left: -0.5, right: 0.5, bottom: 0}, blocks: [{name: a, size: [1, 1], pose: [0, 0.5, 0], "
               "velocity: [0, -1, 0]}]}";
  for (const double side : { -0.5, 0.5 })
  {
    const int wall = side < 0 ? 1 : 2;
    for (const double y : { 0.0, 1.0 })
      item.events.push_back(row(0, Kind::Impact, 0, wall, Vec2(side, y), Vec2(side < 0 ? 1 : -1, 0), 0, 1e5 / (4 * y + 3)));
    item.events.push_back(row(0, Kind::Impact, 0, 3, Vec2(side, 0), Vec2(0, 1), -1, 0.5));
  }
  item.movers = { { 1, 1.0 / 6.0, [](double) { return stateOf(0, 0.5, 0, 0, 0, 0); } } };
  return item;
}

/// Hit beside its centre just after floor and ceiling squeezed it: what rounding is left of their moments turns it.
inline Case squeezedAndHit()
{
  Case item;
  item.scene = "{elasticity: 0.5, walls: {bottom: 0, top: 1}, blocks: [{name: a, size: [1, 1], pose: [0, 0.5, 0]}, {name: b, vertices: "
               "[[0, -0.1], [0.5, 0], [0, 0.1], [-0.5, 0]], pose: [-1.0005, 0.8, 0], velocity: [1, 0, 0]}]}";
  const double hit = 0.0005, j = 1.5 / (2 + 0.3 * 0.3 * 6);
  for (const int wall : { 2, 3 })
    for (const double x : { 0.5, -0.5 })
      item.events.push_back(row(0.0003, Kind::Impact, 0, wall, Vec2(x, wall - 2), Vec2(0, 5 - 2 * wall), 0, 1e7 / (46 * x + 30)));
  item.events.push_back(row(hit, Kind::Impact, 0, 1, Vec2(-0.5, 0.8), Vec2(1, 0), -1, j));
  item.movers = { { 1, 1.0 / 6.0, Pieces{ 0, { { 0, stateOf(0, 0.5, 0, 0, 0, 0) }, { hit, stateOf(0, 0.5, 0, j, 0, -1.8 * j) } } } },
                  { 1, 1.0 / 12.0, Pieces{ 0, { { 0, stateOf(-1.0005, 0.8, 0, 1, 0, 0) }, { hit, stateOf(-1, 0.8, 0, 1 - j, 0, 0) } } } } };
  item.impact_loss = Steps{ { { hit, 0.25 * j } } };
  item.duration = 0.001;
  return item;
}

}  // namespace exact
