#include "block_world/world.h"

#include <algorithm>
#include <limits>

#include "engine.h"

namespace block_world
{
World::World(Scene scene, const Time& start) : engine_(std::make_unique<Engine>(std::move(scene), start))
{
}
World::World(std::unique_ptr<Engine> engine) : engine_(std::move(engine))
{
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Time World::now() const
{
  return engine_->now;
}

Time World::advance(Time target, std::int64_t max_events)
{
  return engine_->advance(target, max_events);
}

void World::stallAfter(std::int64_t events)
{
  engine_->stall_after = static_cast<int>(std::min<std::int64_t>(events, std::numeric_limits<int>::max()));
}

Applied World::apply(const Command& command)
{
  return engine_->apply(command);
}

Applied World::check(const Command& command) const
{
  return engine_->check(command);
}

const Scene& World::scene() const
{
  return engine_->scene;
}

const Scene& World::loaded() const
{
  return engine_->loaded_;
}

int World::bodyCount() const
{
  return engine_->block_count;
}

const Block& World::block(int body) const
{
  return engine_->scene.blocks[body];
}

bool World::isFixed(int body) const
{
  return engine_->bodies[body].fixed;
}

const std::string& World::name(int body) const
{
  return engine_->bodies[body].name;
}

int World::find(const std::string& name) const
{
  for (int i = 0; i < engine_->block_count; ++i)
    if (engine_->bodies[i].name == name)
      return i;
  return -1;
}

MotionState World::state(int body) const
{
  return engine_->bodies[body].stateAt(engine_->now);
}

EnergyAccount World::energy() const
{
  return engine_->energy();
}

std::vector<ContactEvent> World::takeContacts()
{
  // The world's own memory stays for those to come.
  std::vector<ContactEvent> taken(engine_->contacts);
  engine_->contacts.clear();
  return taken;
}

void World::keepContacts(bool keep)
{
  engine_->keep_contacts = keep;
  if (!keep)
    engine_->contacts.clear();
}

std::vector<TimedCommand> World::takeInputs()
{
  std::vector<TimedCommand> taken;
  taken.swap(engine_->inputs_done);
  return taken;
}

std::vector<ContactEvent> World::restingContacts() const
{
  return engine_->restingContacts();
}

double World::overlap() const
{
  return engine_->overlap();
}

std::vector<SpringState> World::springs() const
{
  return engine_->springs();
}

const std::vector<Thruster>& World::thrusters(int body) const
{
  return engine_->bodies[body].thrusters;
}

std::vector<double> World::thrustLevels(int body) const
{
  return engine_->bodies[body].levels;
}

std::uint64_t World::stateHash() const
{
  return engine_->stateHash();
}

std::string World::save() const
{
  return engine_->save();
}

World World::restore(const std::string& saved, std::int64_t seconds_later)
{
  return World(std::make_unique<Engine>(saved, seconds_later));
}

const Statistics& World::statistics() const
{
  return engine_->statistics;
}

const Cost& World::cost(int body) const
{
  return engine_->bodies[body].cost;
}

std::vector<int> World::island(int body) const
{
  return engine_->islandOf(body);
}

const std::vector<std::string>& World::notes() const
{
  return engine_->notes;
}

}  // namespace block_world
