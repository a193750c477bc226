#include "motion.h"

#include <numeric>

#include "integrate.h"

namespace checker
{
namespace
{
/// A force at a world point.
void push(const Vec2& force, const Vec2& point, const State& state, Load& load)
{
  load.force += force;
  load.torque += cross(point - state.position, force);
}

struct SpringEnd
{
  Vec2 point = Vec2::Zero(), velocity = Vec2::Zero();
};

SpringEnd endOf(int body, const Vec2& point, const std::vector<State>& states)
{
  if (body < 0)
    return { point, Vec2::Zero() };
  const Vec2 world = states[body].position + turned(point, states[body].angle);
  return { world, states[body].velocityAt(world) };
}

/// Force on the `from` end, and the power that its damper takes.
Vec2 springForce(const Spring& spring, const SpringEnd& from, const SpringEnd& to, double& damper_power)
{
  const Vec2 line = from.point - to.point, rate = from.velocity - to.velocity;
  if (spring.rest_length <= 0.0)
  {
    damper_power = spring.damping * rate.squaredNorm();
    return -spring.stiffness * line - spring.damping * rate;
  }
  const double length = line.norm();
  const Vec2 along = line / length;
  const double stretching = along.dot(rate);
  damper_power = spring.damping * stretching * stretching;
  return -(spring.stiffness * (length - spring.rest_length) + spring.damping * stretching) * along;
}

/// How fast the power of a damper changes; `acceleration` is that of its `from` end less that of its `to` end.
double damperRate(const Spring& spring, const SpringEnd& from, const SpringEnd& to, const Vec2& acceleration)
{
  const Vec2 line = from.point - to.point, rate = from.velocity - to.velocity;
  if (spring.rest_length <= 0.0)
    return 2.0 * spring.damping * rate.dot(acceleration);
  const double length = line.norm(), stretching = line.dot(rate) / length;
  const double change = (line.dot(acceleration) + rate.squaredNorm() - stretching * stretching) / length;
  return 2.0 * spring.damping * stretching * change;
}

double springEnergy(const Spring& spring, const std::vector<State>& states)
{
  const Vec2 line =
      endOf(spring.from, spring.from_point, states).point - endOf(spring.to, spring.to_point, states).point;
  const double stretch = spring.rest_length > 0.0 ? line.norm() - spring.rest_length : line.norm();
  return 0.5 * spring.stiffness * stretch * stretch;
}

Spring asSpring(const MouseSpring& mouse, int body)
{
  Spring spring;
  spring.from = body;
  spring.from_point = mouse.point;
  spring.to_point = mouse.anchor;
  spring.stiffness = mouse.stiffness;
  spring.damping = mouse.damping;
  return spring;
}

int rootOf(std::vector<int>& parent, int i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}
}  // namespace

Motion::Motion(const Scene& scene) : scene_(scene), cluster_of_(scene.blocks.size(), -1)
{
  std::vector<int> parent(scene.blocks.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto movable = [&](int body) { return body >= 0 && scene.movable(body); };
  for (const Spring& spring : scene.springs)
  {
    if (movable(spring.from) && movable(spring.to))
      parent[rootOf(parent, spring.from)] = rootOf(parent, spring.to);
  }
  for (int body = 0; body < static_cast<int>(parent.size()); ++body)
  {
    if (!movable(body))
      continue;
    int& cluster = cluster_of_[rootOf(parent, body)];
    if (cluster < 0)
    {
      cluster = static_cast<int>(clusters_.size());
      clusters_.emplace_back();
    }
    clusters_[cluster].push_back(body);
    cluster_of_[body] = cluster;
  }
  springs_of_.resize(clusters_.size());
  for (const Spring& spring : scene.springs)
  {
    const int body = movable(spring.from) ? spring.from : spring.to;
    if (movable(body))
      springs_of_[cluster_of_[body]].push_back(&spring);
  }
}

void Motion::addSpring(const Spring& spring, const std::vector<State>& states, std::vector<Load>& out,
                       Power& power) const
{
  const SpringEnd from = endOf(spring.from, spring.from_point, states), to = endOf(spring.to, spring.to_point, states);
  double damper = 0.0;
  const Vec2 force = springForce(spring, from, to, damper);
  power.damping += damper;
  if (spring.from >= 0)
    push(force, from.point, states[spring.from], out[spring.from]);
  if (spring.to >= 0)
    push(-force, to.point, states[spring.to], out[spring.to]);
}

void Motion::addDrive(const Drive& drive, int body, const State& state, Load& load, Power& power) const
{
  const Drive::Body& own = drive.bodies[body];
  const Block& block = scene_.blocks[body];
  for (size_t i = 0; i < own.levels.size() && i < block.thrusters.size(); ++i)
  {
    const Thruster& thruster = block.thrusters[i];
    const double strength = own.levels[i] * thruster.strength * (block.default_thrusters ? drive.thrust : 1.0);
    if (strength == 0.0)
      continue;
    const Vec2 force = strength * turned(thruster.direction, state.angle);
    const Vec2 point = state.position + turned(thruster.point, state.angle);
    push(force, point, state, load);
    power.thrust += force.dot(state.velocityAt(point));
  }
  if (own.force != Vec2::Zero() || own.torque != 0.0)
  {
    const Vec2 force = turned(own.force, state.angle);
    load.force += force;
    load.torque += own.torque;
    power.thrust += force.dot(state.velocity) + own.torque * state.omega;
  }
}

Power Motion::loads(int cluster, const Drive& drive, const std::vector<State>& states, std::vector<Load>& out) const
{
  Power power;
  const double turning = drive.damping * scene_.rotational_ratio;
  for (const int body : clusters_[cluster])
  {
    const State& state = states[body];
    out[body].force = Vec2(0.0, -drive.bodies[body].mass * drive.gravity) - drive.damping * state.velocity;
    out[body].torque = -turning * state.omega;
    power.damping += drive.damping * state.velocity.squaredNorm() + turning * state.omega * state.omega;
    addDrive(drive, body, state, out[body], power);
  }
  for (const Spring* spring : springs_of_[cluster])
    addSpring(*spring, states, out, power);
  for (const int body : clusters_[cluster])
  {
    if (drive.bodies[body].spring)
      addSpring(asSpring(*drive.bodies[body].spring, body), states, out, power);
  }
  return power;
}

// Of thrusters and the wrench; their forces turn with the body.
double Motion::driveRate(const Drive& drive, int body, const State& state, const Acceleration& acceleration) const
{
  const Drive::Body& own = drive.bodies[body];
  const Block& block = scene_.blocks[body];
  const auto rate = [&](const Vec2& force, const Vec2& point) {
    const Vec2 turning = state.omega * Vec2(-force.y(), force.x());
    return turning.dot(state.velocityAt(point)) + force.dot(acceleration.at(point, state));
  };
  double sum = rate(turned(own.force, state.angle), state.position) + own.torque * acceleration.angular;
  for (size_t i = 0; i < own.levels.size() && i < block.thrusters.size(); ++i)
  {
    const Thruster& thruster = block.thrusters[i];
    const double strength = own.levels[i] * thruster.strength * (block.default_thrusters ? drive.thrust : 1.0);
    sum += rate(strength * turned(thruster.direction, state.angle), state.position + turned(thruster.point, state.angle));
  }
  return sum;
}

Power Motion::powerRates(int cluster, const Drive& drive, const std::vector<State>& states, const std::vector<Load>& total) const
{
  const auto accelerationOf = [&](int body) {
    return Acceleration{ total[body].force / drive.bodies[body].mass, total[body].torque / inertia(drive, body) };
  };
  const double turning = drive.damping * scene_.rotational_ratio;
  Power rates;
  const auto addDamper = [&](const Spring& spring) {
    const SpringEnd from = endOf(spring.from, spring.from_point, states), to = endOf(spring.to, spring.to_point, states);
    const auto at = [&](int body, const SpringEnd& end) {
      return body >= 0 && scene_.movable(body) ? accelerationOf(body).at(end.point, states[body]) : Vec2(Vec2::Zero());
    };
    rates.damping += damperRate(spring, from, to, at(spring.from, from) - at(spring.to, to));
  };
  for (const int body : clusters_[cluster])
  {
    const State& state = states[body];
    const Acceleration acceleration = accelerationOf(body);
    rates.damping += 2.0 * (drive.damping * state.velocity.dot(acceleration.linear) + turning * state.omega * acceleration.angular);
    rates.thrust += driveRate(drive, body, state, acceleration);
    if (drive.bodies[body].spring)
      addDamper(asSpring(*drive.bodies[body].spring, body));
  }
  for (const Spring* spring : springs_of_[cluster])
    addDamper(*spring);
  return rates;
}

bool Motion::onParabola(int cluster, const Drive& drive) const
{
  if (drive.damping != 0.0 || !springs_of_[cluster].empty())
    return false;
  for (const int body : clusters_[cluster])
  {
    const Drive::Body& own = drive.bodies[body];
    if (!own.levels.empty() || own.spring || own.torque != 0.0 || own.force != Vec2::Zero())
      return false;
  }
  return true;
}

Power Motion::advance(int cluster, const Drive& drive, const std::vector<Load>& held, double span,
                      std::vector<State>& states) const
{
  if (span == 0.0)
    return {};
  if (onParabola(cluster, drive))
  {
    for (const int body : clusters_[cluster])
    {
      State& state = states[body];
      const Vec2 a = held[body].force / drive.bodies[body].mass - Vec2(0.0, drive.gravity);
      const double alpha = held[body].torque / inertia(drive, body);
      state.position += span * (state.velocity + 0.5 * span * a);
      state.angle += span * (state.omega + 0.5 * span * alpha);
      state.velocity += span * a;
      state.omega += span * alpha;
    }
    return {};
  }
  const Cluster& members = clusters_[cluster];
  const int n = static_cast<int>(members.size());
  std::vector<State> trial = states;
  std::vector<Load> load(states.size());
  const auto unpack = [&](const Eigen::VectorXd& y, std::vector<State>& to) {
    for (int i = 0; i < n; ++i)
      to[members[i]] = { y.segment<2>(6 * i), y[6 * i + 2], y.segment<2>(6 * i + 3), y[6 * i + 5] };
  };
  const auto slope = [&](const Eigen::VectorXd& y) {
    unpack(y, trial);
    const Power power = loads(cluster, drive, trial, load);
    Eigen::VectorXd rate(y.size());
    for (int i = 0; i < n; ++i)
    {
      const int body = members[i];
      rate.segment<3>(6 * i) = y.segment<3>(6 * i + 3);
      rate.segment<2>(6 * i + 3) = (load[body].force + held[body].force) / drive.bodies[body].mass;
      rate[6 * i + 5] = (load[body].torque + held[body].torque) / inertia(drive, body);
    }
    rate[6 * n] = power.thrust;
    rate[6 * n + 1] = power.damping;
    return rate;
  };
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6 * n + 2);
  for (int i = 0; i < n; ++i)
  {
    const State& state = states[members[i]];
    y.segment<6>(6 * i) << state.position, state.angle, state.velocity, state.omega;
  }
  integrate(slope, span, y);
  unpack(y, states);
  return { y[6 * n], y[6 * n + 1] };
}

double Motion::kinetic(const Drive& drive, int body, const State& state) const
{
  return 0.5 * drive.bodies[body].mass * state.velocity.squaredNorm() +
         0.5 * inertia(drive, body) * state.omega * state.omega;
}

double Motion::gravityEnergy(const Drive& drive, int body, const State& state) const
{
  return drive.bodies[body].mass * drive.gravity * (state.position.y() - scene_.floor.value_or(0.0));
}

double Motion::sceneSpringEnergy(const std::vector<State>& states) const
{
  double energy = 0.0;
  for (const Spring& spring : scene_.springs)
    energy += springEnergy(spring, states);
  return energy;
}

double Motion::mouseSpringEnergy(const Drive& drive, const std::vector<State>& states) const
{
  double energy = 0.0;
  for (size_t body = 0; body < states.size(); ++body)
  {
    if (drive.bodies[body].spring)
      energy += springEnergy(asSpring(*drive.bodies[body].spring, static_cast<int>(body)), states);
  }
  return energy;
}

}  // namespace checker
