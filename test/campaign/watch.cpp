#include "watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace campaign
{
using namespace block_world;

namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Every event rounds the sums it makes, the worst case adding up in one direction; the rest is room for the few
/// hundred operations of the first ones.
double rounding(const World& world)
{
  return 1e-12 + epsilon * static_cast<double>(world.statistics().events);
}

bool changesLosses(const TimedCommand& input)
{
  if (const auto* set = std::get_if<SetCommand>(&input.command))
    return set->elasticity || set->damping;
  if (const auto* spring = std::get_if<SpringCommand>(&input.command))
    return spring->active && spring->damping > 0.0;
  return false;
}

/// Elastic and undamped from the beginning to the end: energy less work can only stay.
bool keepsEnergy(const Case& item)
{
  const Scene& scene = item.scene;
  return scene.elasticity == 1.0 && scene.damping == 0.0 &&
         std::all_of(scene.blocks.begin(), scene.blocks.end(),
                     [](const Block& block) { return block.elasticity.value_or(1.0) == 1.0; }) &&
         std::all_of(scene.springs.begin(), scene.springs.end(), [](const Spring& s) { return s.damping == 0.0; }) &&
         std::none_of(scene.inputs.begin(), scene.inputs.end(), changesLosses);
}

/// Nothing acts from outside.
bool keepsMomentum(const Case& item)
{
  const Scene& scene = item.scene;
  const Walls& walls = scene.walls;
  return !walls.left && !walls.right && !walls.bottom && !walls.top && scene.gravity == 0.0 && scene.damping == 0.0 &&
         scene.inputs.empty() && item.script.empty() &&
         std::none_of(scene.blocks.begin(), scene.blocks.end(), [](const Block& block) { return block.fixed; }) &&
         std::none_of(scene.springs.begin(), scene.springs.end(), [](const Spring& s) { return s.to_block.empty(); });
}

double gyrationOf(const Block& block)
{
  double area = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < block.vertices.size(); ++i)
  {
    const Vector2d &p = block.vertices[i], &q = block.vertices[(i + 1) % block.vertices.size()];
    const double piece = p.x() * q.y() - p.y() * q.x();
    area += piece;
    moment += piece * (p.dot(p) + p.dot(q) + q.dot(q)) / 6.0;
  }
  return moment / area;
}
}  // namespace

double lengthOf(const Case& item)
{
  const Walls& walls = item.scene.walls;
  double length = 0.0;
  for (const auto& wall : { walls.left, walls.right, walls.bottom, walls.top })
    length = std::max(length, std::abs(wall.value_or(0.0)));
  for (const Block& block : item.scene.blocks)
    length = std::max(length, block.position.norm() + block.vertices.front().norm());
  return length;
}

Watch::Watch(const Case& item, const World& world, Result& result) : result_(result)
{
  result_.keeps_energy = keepsEnergy(item);
  result_.keeps_momentum = keepsMomentum(item);
  is_turned_ = std::any_of(item.scene.springs.begin(), item.scene.springs.end(),
                           [](const Spring& s) { return s.rest_length == 0.0 && s.damping != 0.0; });
  start_energy_ = world.energy().total;
  start_momentum_ = momentumOf(world);
}

void Watch::look(World& world)
{
  takeContacts(world);
  checkOverlap(world);
  checkEnergy(world);
  if (result_.keeps_momentum)
    checkMomentum(world);
}

void Watch::takeContacts(World& world)
{
  for (const ContactEvent& contact : world.takeContacts())
  {
    result_.rests = result_.rests || contact.kind == ContactKind::RestBegin;
    if (!contacts_.empty() && contact.kind == ContactKind::Impact)
    {
      const ContactEvent& last = contacts_.back();
      const bool same = last.a == contact.a && last.b == contact.b;
      result_.hits_together = result_.hits_together || (last.time == contact.time && !same);
    }
    contacts_.push_back(contact);
  }
}

void Watch::checkOverlap(const World& world)
{
  const double time = world.now().seconds();
  std::vector<Outline> walls = outlinesOf(world.scene().walls);
  outlines_.clear();
  double largest = 1.0;
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const MotionState state = world.state(i);
    if (!state.position.allFinite() || !state.velocity.allFinite() || !std::isfinite(state.angle) ||
        !std::isfinite(state.omega))
      return result_.fail("finite", time, "state of " + world.name(i));
    outlines_.push_back(outlineOf(world.block(i), state.position, state.angle));
    largest = std::max(largest, state.position.norm() + outlines_.back().radius);
  }
  const double tolerance = world.scene().tolerance, limit = tolerance + 16.0 * epsilon * largest;
  const auto judge = [&](int i, const Outline& other, const std::string& name) {
    const double depth = -separation(outlines_[i], other);
    result_.overlap = std::max(result_.overlap, depth / tolerance);
    if (!(depth <= limit))
      result_.fail("overlap", time, world.name(i) + " and " + name + " by " + shown(depth) + " m");
  };
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    for (int j = 0; j < i; ++j)
      if (!world.isFixed(i) || !world.isFixed(j))
        judge(i, outlines_[j], world.name(j));
    for (std::size_t w = 0; w < walls.size() && !world.isFixed(i); ++w)
      judge(i, walls[w], world.name(world.bodyCount() + static_cast<int>(w)));
  }
}

void Watch::checkEnergy(const World& world)
{
  const double time = world.now().seconds();
  const EnergyAccount e = world.energy();
  const double work = e.thrust_work + e.spring_work + e.command_work;
  const double size = std::abs(e.gravity) + e.spring + e.translational + e.rotational + std::abs(e.thrust_work) +
                      std::abs(e.spring_work) + std::abs(e.command_work);
  if (!std::isfinite(size) || !std::isfinite(e.balance_error))
    return result_.fail("finite", time, "energy");
  scale_ = std::max({ scale_, size, std::abs(start_energy_) });
  if (scale_ == 0.0)
    return;
  const double held = e.total - start_energy_ - work;
  const double gain = (held - lowest_) / scale_, balance = std::abs(e.balance_error) / scale_;
  lowest_ = std::min(lowest_, held);
  result_.gain = std::max(result_.gain, gain);
  result_.balance = std::max(result_.balance, balance);
  const double limit = rounding(world);
  if (gain > limit)
    result_.fail("energy.gain", time, "energy less work rose by " + shown(gain) + " of its scale");
  if (balance > 1e-9)
    result_.fail("energy.balance", time, "error " + shown(balance) + " of the scale");
  if (result_.keeps_energy && held / scale_ < -limit)
    result_.fail("energy.kept", time, "elastic, but " + shown(-held / scale_) + " of the scale is lost");
}

Watch::Momentum Watch::momentumOf(const World& world) const
{
  Momentum sum;
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const MotionState s = world.state(i);
    const double mass = world.block(i).mass, spin = mass * gyrationOf(world.block(i)) * s.omega;
    sum.linear += mass * s.velocity;
    sum.angular += spin + mass * (s.position.x() * s.velocity.y() - s.position.y() * s.velocity.x());
    sum.linear_scale += mass * s.velocity.norm();
    sum.angular_scale += std::abs(spin) + mass * s.position.norm() * s.velocity.norm();
  }
  return sum;
}

void Watch::checkMomentum(const World& world)
{
  const Momentum now = momentumOf(world);
  start_momentum_.linear_scale = std::max(start_momentum_.linear_scale, now.linear_scale);
  start_momentum_.angular_scale = std::max(start_momentum_.angular_scale, now.angular_scale);
  const double linear = (now.linear - start_momentum_.linear).norm() / std::max(1e-300, start_momentum_.linear_scale);
  const double angular =
      is_turned_ ? 0.0 :
                   std::abs(now.angular - start_momentum_.angular) / std::max(1e-300, start_momentum_.angular_scale);
  result_.momentum = std::max({ result_.momentum, linear, angular });
  if (!(std::max(linear, angular) <= rounding(world)))
    result_.fail("momentum", world.now().seconds(),
                 "changed by " + shown(linear) + " (linear), " + shown(angular) + " (angular) of the scale");
}

}  // namespace campaign
