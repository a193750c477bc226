#pragma once

#include <array>
#include <string>
#include <vector>

#include "block_world/world.h"
#include "contact_group.h"
#include "detect.h"
#include "flow.h"
#include "grid.h"
#include "promises.h"

namespace block_world
{
/// Bodies that move as one: joined by touches that carry force or by springs. Stored at the lowest of its body indices.
struct alignas(kCacheLine) Island
{
  std::vector<int> bodies;
  std::vector<Rest> rests;
  Works works;

  /// Keeps the memory.
  void clear()
  {
    bodies.clear();
    rests.clear();
  }
  /// Both being empty: the larger memory of the two.
  void takeMemory(Island& other)
  {
    if (other.bodies.empty() && other.bodies.capacity() > bodies.capacity())
      bodies.swap(other.bodies);
    if (other.rests.empty() && other.rests.capacity() > rests.capacity())
      rests.swap(other.rests);
  }
};

/// The world behind World: arcs, promises, and what happens when a promise comes due.
///
/// Slots of the promises: the scene's timed inputs, then per body the end of its timed commands, per island the end of its arcs (or a release,
/// or a vertex that leaves its face), per body the next look at its cell, per pair the next look at its gap.
class World::Engine
{
public:
  Engine(Scene scene, const Time& start);
  /// From what save() gave. Throws std::runtime_error.
  Engine(const std::string& saved, std::int64_t seconds_later);

  Time advance(Time target, std::int64_t max_events);
  Applied apply(const Command& command);
  Applied check(const Command& command);

  EnergyAccount energy() const;
  std::vector<ContactEvent> restingContacts() const;
  double overlap() const;
  std::vector<SpringState> springs() const;
  std::uint64_t stateHash() const;
  std::string save() const;

  // Read by World; written by the engine only.
  Time now;
  Scene scene;
  std::vector<std::string> notes;
  std::vector<Body> bodies;  ///< blocks in scene order, then walls
  int block_count = 0;
  std::vector<ContactEvent> contacts;
  bool keep_contacts = true;
  std::vector<TimedCommand> inputs_done;
  Statistics statistics;
  std::vector<int> islandOf(int body) const;

  int stall_after = 100000;  ///< events

private:
  friend class World;

  // engine.cpp: building and the main loop
  void build();
  void buildBodies();
  void shareShapes();
  void start();
  void rebuild(const Time& time);
  void resolveAll(const Time& time);
  void keep(int slot, const Time& time);
  int expirySlot(int body) const
  {
    return 1 + body;
  }
  int islandSlot(int body) const
  {
    return 1 + static_cast<int>(bodies.size()) + body;
  }
  int cellSlot(int body) const
  {
    return 1 + 2 * static_cast<int>(bodies.size()) + body;
  }
  int pairSlot(int pair) const
  {
    return 1 + 3 * static_cast<int>(bodies.size()) + pair;
  }

  // snapshot.cpp: to bytes and back
  template <class A>
  void exchange(A& archive);
  void clearWorkspace();

  // meter.cpp: what it costs
  void charge(int body, std::int64_t units);
  void chargeEvent(int body, const Time& time);
  void chargeTouches();
  void chargeHit(const Touch& touch);
  void noticeStall(int body, const Time& time);
  void tryAgain();

  // neighbours.cpp: which pairs there are, and when to look at them
  void configureGrid();
  bool nearWall(int body, int wall) const;
  void findNear(int body);
  void pairAll();
  int addPair(int a, int b);
  void dropPair(int pair);
  void lookAtCell(int body, const Time& time);
  void promiseCell(int body, const Time& time);
  void lookAtPairs(const Time& time);
  void lookAtPair(int pair, const Time& time);

  // resolve.cpp: what happens at an event
  /// A body at the instant that is looked at.
  struct alignas(kCacheLine) Seen
  {
    Snapshot now;
    double cosine = 1.0, sine = 0.0;
    int body = 0;  ///< ~body where its arc has changed since
    bool framed = false;
  };
  void resolve(const Time& time);
  void join(int body, const Time& time);
  Member memberAt(int body, const Time& time);
  int memberOf(int body, const Time& time);
  bool mayTouch(const Pair& pair, const Time& time);
  const Member& viewed(int body, const Time& time, Member& member);
  void findTouches(const Time& time, int round);
  void report(const Time& time, bool last);  // report.cpp, as is tell
  void tell(const Touch& touch, ContactKind kind, double impulse, const Time& time);
  void locateTouches();
  void settle(double paid);
  void fetch(int body) const;
  void fetchFor(int slot) const;
  void fetchShape(int body) const;
  Seen& seen(int body, const Time& time)
  {
    const int place = seen_as_[body];
    return seen_at_ == time && place < seen_count_ && seen_[place].body == body ? seen_[place] : see(body, time);
  }
  Seen& see(int body, const Time& time);
  void forget(int body);
  void forgetAll();
  const Snapshot& snapshot(int body, const Time& time)
  {
    return seen(body, time).now;
  }
  Frame frame(int body, const Time& time);
  void freeAcceleration(Member& member) const;

  // islands.cpp: who moves as one, and how
  void regroup(const Time& time);
  void launch(const Time& time, const std::vector<int>& members);
  double leastForce(const Island& island) const;
  bool letGo(Island& island, const Time& time);
  bool wereBrief(const Island& island, const Time& time) const;
  void move(Island& island, const Time& time);
  bool isStill(const Island& island) const;
  void sleep(Island& island);
  void promiseIsland(int island, const Time& time);
  void dissolve(int body, const Time& time);
  void endDecay(Member& member) const;
  bool hasDrifted(Island& island, const Time& time);
  void continueIsland(int island, const Time& time);

  // account.cpp: energies and works
  void closeWorks(int island, const Time& time);
  void closeIsland(int body, const Time& time);
  void putAt(int body, const MotionState& state, const Time& time);
  void stored(const Time& time, EnergyAccount& energy) const;
  double storedTotal(const Time& time) const;
  double springEnergy(const SpringLink& link, const Time& time) const;
  double storedOnMove() const;
  double mouseEnergy(const Body& body, const Time& time) const;
  void restartAccount();

  // forcing.cpp: what pushes and pulls from outside, and until when
  void refreshPush(Body& body);
  void refreshDissipative();
  void expiryPromise(int body);
  void wake(int body, const Time& time);
  void release(Body& body, const Time& time);
  void expire(int body, const Time& time);
  Time nextInputTime() const;
  void applyInputs(const Time& time);

  // commands.cpp: what is asked of the world
  struct Handler;
  Applied applyAt(const Command& command, const Time& time, bool check_only = false);
  void set(const SetCommand& command);
  void pickNearest(SpringCommand& command, const Time& time) const;
  bool overlaps(int body, const Frame& frame, const Time& time, std::string& with) const;

  Scene loaded_;
  Field field_;
  double zero_height_ = 0.0;
  double resolution_ = 0.0;
  bool dissipative_ = false;
  std::vector<SpringLink> links_;
  Grid grid_;
  std::vector<Pair> pairs_;      ///< those not in use have no bodies
  int free_pair_ = -1;           ///< first of those not in use
  std::vector<Island> islands_;
  Promises promises_;
  Detector detector_;
  TouchFinder finder_;
  ContactGroup group_;
  Flow flow_;

  // Timed inputs of the scene, from input_start_ on.
  std::uint64_t next_input_ = 0;
  Time input_start_;

  // Account since its start.
  double initial_total_ = 0.0, thrust_work_ = 0.0, spring_work_ = 0.0, command_work_ = 0.0, damping_loss_ = 0.0, impact_loss_ = 0.0;

  // Workspace of an event.
  std::vector<Seen> seen_;    ///< room for all bodies; the few that are seen at an instant come first, in little memory
  std::vector<int> seen_as_;  ///< by body, its place among them if it is there
  int seen_count_ = 0;
  Time seen_at_;
  std::vector<int> seeds_, member_of_, group_pairs_, component_, island_members_;
  std::vector<int> pair_mark_, body_mark_, near_;
  int mark_ = 0;
  std::vector<Rest> former_rests_;
  std::vector<Member> island_state_;
  std::vector<Member> before_;  ///< the group's, before they are moved
  bool velocity_decided_ = false;
  CostKind kind_ = CostKind::Command;  ///< what is being done
};

}  // namespace block_world
