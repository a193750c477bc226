// What an event did, as contacts.

#include <cmath>

#include "engine.h"

namespace block_world
{
/// Notes a contact for whoever takes it.
void World::Engine::tell(const Touch& t, ContactKind kind, double impulse, const Time& time)
{
  if (!keep_contacts)
    return;
  ContactEvent contact;
  contact.time = time;
  contact.kind = kind;
  contact.a = t.a;
  contact.b = t.b;
  contact.point = group_.members[t.member_a].frame.position + t.arm;
  contact.normal = t.normal;
  contact.normal_velocity = t.approach;
  contact.impulse = impulse;
  contacts.push_back(contact);
}

/// What the last collide did, as contacts.
void World::Engine::report(const Time& time, bool last)
{
  int last_pair = -1;
  for (const Touch& t : group_.touches)
  {
    const bool fresh = t.active && !t.rested;
    const double impulse = t.impulse + t.capture;
    const double threshold = group_.noise() / contactGram(t, t, group_.members);
    const bool hit = std::abs(impulse) > threshold;
    if (hit && !(fresh && last))
      tell(t, ContactKind::Impact, impulse, time);
    if (impulse > threshold && t.pair != last_pair)
    {
      chargeHit(t);
      last_pair = t.pair;
    }
    if (fresh && last)
      tell(t, ContactKind::RestBegin, impulse, time);
  }
  if (!last)
    return;
  for (const Rest& former : former_rests_)
  {
    bool gone = true;
    for (const Touch& t : group_.touches)
      gone = gone && !(t.active && sameTouch(former.touch, t));
    if (!gone)
      continue;
    Touch ended = former.touch;
    ended.member_a = member_of_[ended.a];
    ended.member_b = member_of_[ended.b];
    const Member &a = group_.members[ended.member_a], &b = group_.members[ended.member_b];
    locate(ended, bodies[ended.a], a.frame, bodies[ended.b], b.frame);
    ended.approach = normalVelocity(ended, a, b);
    tell(ended, ContactKind::RestEnd, 0.0, time);
  }
}

}  // namespace block_world
