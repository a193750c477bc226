#include "simulate_bag.h"

#include <algorithm>
#include <stdexcept>

#ifdef BLOCK_WORLD_WITH_ROS
#include "bag_writer.h"
#include "pacing.h"
#include "publishers.h"
#include "topics.h"
#endif

namespace block_world
{
namespace
{
/// Whether the target was reached; else the world stalled.
bool advanceTo(World& world, std::int64_t target, const std::function<void()>& busy)
{
  constexpr std::int64_t events_at_once = 10000;  // a tenth of a second at most
  const Time goal = Time::fromNanoseconds(target);
  while (world.advance(goal, events_at_once) < goal && !world.statistics().stalled)
    busy();
  return world.now() == goal;
}

}  // namespace

#ifdef BLOCK_WORLD_WITH_ROS
struct BagOutput::Recorder
{
  Recorder(const std::string& path, const World& world)
    : bag(path, NODE), publishers({ nullptr, &bag, NODE }, world, "world", "")
  {
  }

  void publish(World& world, std::int64_t now_ns, const std::vector<ContactEvent>& contacts)
  {
    for (const TimedCommand& input : world.takeInputs())
      publishers.publishInput(input.command, input.time.nanoseconds(), true);
    publishers.publishState(now_ns, contacts);
    publishers.publishOverlay(now_ns);
    state_ns = now_ns;
  }

  static constexpr const char* NODE = "/block_world";

  BagWriter bag;
  Publishers publishers;
  Schedule schedule{ 60.0 };  // Hz, as the node has it
  std::int64_t state_ns = -1;
  std::vector<ContactEvent> contacts;  ///< since the last state
};

BagOutput::BagOutput(const std::string& path, World& world) : world_(world)
{
  if (path.empty())
    return;
  recorder_ = std::make_unique<Recorder>(path, world);
  recorder_->publishers.publishScene(0);
  recorder_->publish(world, 0, {});
}

std::vector<ContactEvent> BagOutput::advance(std::int64_t target, const std::function<void()>& busy)
{
  if (!recorder_)
  {
    advanceTo(world_, target, busy);
    return world_.takeContacts();
  }
  std::vector<ContactEvent> all;
  std::int64_t goal = world_.now().nanoseconds();
  bool goes_on = true;
  while (goes_on && goal < target)
  {
    goal = std::min(target, recorder_->schedule.after(goal));
    goes_on = advanceTo(world_, goal, busy);
    const std::vector<ContactEvent> met = world_.takeContacts();
    all.insert(all.end(), met.begin(), met.end());
    recorder_->contacts.insert(recorder_->contacts.end(), met.begin(), met.end());
    if (!goes_on || !recorder_->schedule.isDue(goal))
      continue;
    recorder_->publish(world_, goal, recorder_->contacts);
    recorder_->contacts.clear();
  }
  // What comes due right at the target.
  advanceTo(world_, target, busy);
  const std::vector<ContactEvent> met = world_.takeContacts();
  all.insert(all.end(), met.begin(), met.end());
  recorder_->contacts.insert(recorder_->contacts.end(), met.begin(), met.end());
  return all;
}

void BagOutput::close()
{
  if (!recorder_)
    return;
  const std::int64_t now_ns = world_.now().nanoseconds();
  if (now_ns > recorder_->state_ns && world_.now() == Time::fromNanoseconds(now_ns))
    recorder_->publish(world_, now_ns, recorder_->contacts);
  recorder_->bag.close();
}
#else
struct BagOutput::Recorder
{
};

BagOutput::BagOutput(const std::string& path, World& world) : world_(world)
{
  if (!path.empty())
    throw std::runtime_error("--bag: this program was built without ROS");
}

std::vector<ContactEvent> BagOutput::advance(std::int64_t target, const std::function<void()>& busy)
{
  advanceTo(world_, target, busy);
  return world_.takeContacts();
}

void BagOutput::close()
{
}
#endif

BagOutput::~BagOutput() = default;

}  // namespace block_world
