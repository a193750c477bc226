#include "copies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "variants.h"
#include "watch.h"

namespace campaign
{
namespace
{
using namespace block_world;

constexpr int instants = 64;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A disturbed copy differs by one rounding of every coordinate, a mirrored one by the roundings of every operation on
// the way. An event is some hundred operations, of which there are up to a hundred on the way to where comparing ends;
// growth is about the same for all of them, be they early or late.
constexpr double roundings = 1e4;
// Comparing ends where the disturbed copies have gone this far from the run (of the length of the scene): the limit for
// the others is then 1e-8 of it, far below anything that a wrong impulse or a wrong order does.
constexpr double amplified = 1e-12;

Time instant(const Case& item, int k)
{
  return Time::fromSeconds(item.duration * (k + 1) / instants);
}

std::vector<Track::Placed> placesIn(const World& world)
{
  std::vector<Track::Placed> places;
  for (int i = 0; i < world.bodyCount(); ++i)
  {
    const MotionState state = world.state(i);
    double radius = 0.0;
    for (const Eigen::Vector2d& v : world.block(i).vertices)
      radius = std::max(radius, v.norm());
    places.push_back({ world.name(i), state.position, state.angle, radius });
  }
  return places;
}

void readAll(World& world)
{
  world.energy();
  world.overlap();
  world.restingContacts();
  world.springs();
  world.stateHash();
  world.statistics();
}

/// Largest way between a block and its counterpart; x is the sign of the copy's x axis.
double departure(const std::vector<Track::Placed>& places, const World& copy, double x)
{
  if (static_cast<int>(places.size()) != copy.bodyCount())
    return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const Track::Placed& place : places)
  {
    const int i = copy.find(place.name);
    if (i < 0)
      return std::numeric_limits<double>::infinity();
    const MotionState state = copy.state(i);
    const Eigen::Vector2d image(x * state.position.x(), state.position.y());
    const double way = (image - place.position).norm() + place.radius * std::abs(x * state.angle - place.angle);
    most = std::isnan(way) ? std::numeric_limits<double>::infinity() : std::max(most, way);
  }
  return most;
}

struct Copy
{
  Copy(const char* name, const Case& item, double sign, double cpu)
    : name(name), item(item), sign(sign), player(this->item, cpu)
  {
  }
  /// Goes on to a time of comparison; how far it is then from where the run was.
  double advance(const Case& original, const Track& track, int k)
  {
    try
    {
      player.advance(instant(original, k));
    }
    catch (const Stuck& stuck)
    {
      throw Stuck(std::string(name) + " copy: " + stuck.what(), stuck.time());
    }
    return departure(track.places[k], player.world(), sign);
  }

  const char* name;
  Case item;
  double sign;
  Player player;
};
}  // namespace

Track read(const Case& item, Player& player)
{
  Track track;
  World& world = player.world();
  const auto take = [&] {
    const std::vector<ContactEvent> news = world.takeContacts();
    track.contacts.insert(track.contacts.end(), news.begin(), news.end());
  };
  for (int k = 0; k < instants; ++k)
  {
    const double step = item.duration / instants;
    player.advance(Time::fromSeconds((k + 0.3819) * step));
    readAll(world);
    take();
    player.advance(instant(item, k));
    readAll(world);
    track.places.push_back(placesIn(world));
  }
  player.finish();
  take();
  return track;
}

/// Whether copies that start off by up to as many roundings as a mirrored one meets on its way go as far astray: rigid impact is discontinuous in
/// where it starts (a corner that meets a corner, a hop that is just low enough to be left out), and then no copy can be held to agree.
static bool staysPut(const Case& item, const Track& track, double cpu, double length, int k, double way)
{
  for (double size = 10.0; size <= roundings; size *= 10.0)
    for (const std::uint64_t seed : { 1, 2, 3, 4 })
    {
      Copy copy("disturbed", disturbed(item, length, seed, size), 1.0, cpu);
      double most = 0.0;
      for (int i = 0; i <= k; ++i)
        most = std::max(most, copy.advance(item, track, i));
      if (way <= 100.0 * most)
        return false;
    }
  return true;
}

void compareCopies(const Case& item, const Track& track, double cpu, Result& result)
{
  const double length = lengthOf(item);
  std::vector<std::unique_ptr<Copy>> twins, copies;
  for (const std::uint64_t seed : { 1, 2 })
    twins.push_back(std::make_unique<Copy>("disturbed", disturbed(item, length, seed), 1.0, cpu));
  copies.push_back(std::make_unique<Copy>("mirrored", mirrored(item), -1.0, cpu));
  if (const std::optional<Case> other = reordered(item))
    copies.push_back(std::make_unique<Copy>("reordered", *other, 1.0, cpu));
  double grown = epsilon * length;
  for (int k = 0; k < instants; ++k)
  {
    for (const auto& twin : twins)
      grown = std::max(grown, twin->advance(item, track, k));
    if (grown > amplified * length)
      return;
    result.compared = static_cast<double>(k + 1) / instants;
    for (const auto& copy : copies)
    {
      const double way = copy->advance(item, track, k);
      if (way > roundings * grown && !staysPut(item, track, cpu, length, k, way))
      {
        result.discontinuous = true;
        return;
      }
      result.departure = std::max(result.departure, way / grown);
      if (way > roundings * grown)
        return result.fail(copy->name, instant(item, k).seconds(),
                           "off by " + shown(way) + " m, the disturbed copies by " + shown(grown));
    }
  }
}

}  // namespace campaign
