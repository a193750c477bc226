#include "methods.h"

namespace block_world
{
namespace methods
{
Impact impactOf(const ContactGroup& group)
{
  const int n = static_cast<int>(group.touches.size());
  Impact impact;
  impact.gram.resize(n);
  for (int i = 0; i < n; ++i)
  {
    const Touch& touch = group.touches[i];
    for (int j = 0; j < n; ++j)
      impact.gram(i, j) = contactGram(touch, group.touches[j], group.members);
    impact.velocity.push_back(normalVelocity(touch, group.members[touch.member_a], group.members[touch.member_b]));
    impact.elasticity.push_back(touch.elasticity);
    impact.at.emplace_back();
    for (int member : { touch.member_a, touch.member_b })
      if (group.members[member].inverse_mass > 0.0)
        impact.at.back().push_back(member);
  }
  return impact;
}

void apply(ContactGroup& group, const std::vector<double>& impulses)
{
  for (std::size_t i = 0; i < impulses.size(); ++i)
  {
    const Touch& t = group.touches[i];
    Member &a = group.members[t.member_a], &b = group.members[t.member_b];
    a.velocity += impulses[i] * a.inverse_mass * t.normal;
    a.omega += impulses[i] * a.inverse_inertia * cross(t.arm, t.normal);
    b.velocity -= impulses[i] * b.inverse_mass * t.normal;
    b.omega -= impulses[i] * b.inverse_inertia * cross(t.reach, t.normal);
  }
}

void solveTogether(Impact& impact, const std::vector<int>& touches, std::vector<double>& impulses)
{
  std::vector<double> target(impact.velocity.size());
  for (int i : touches)
    target[i] = (1.0 + impact.elasticity[i]) * impact.velocity[i];
  Complementarity solver;
  solver.begin(impact.gram);
  solver.solve(touches, target);
  for (int i : touches)
  {
    const double z = solver.value()[i];
    impulses[i] += z;
    for (std::size_t j = 0; j < impact.velocity.size(); ++j)
      impact.velocity[j] += impact.gram(static_cast<int>(j), i) * z;
  }
}

int firstApproaching(const Impact& impact)
{
  for (std::size_t i = 0; i < impact.velocity.size(); ++i)
    if (impact.velocity[i] < -slow)
      return static_cast<int>(i);
  return -1;
}

}  // namespace methods
}  // namespace block_world
