#pragma once

#include <vector>

#include "case.h"
#include "outline.h"
#include "result.h"

namespace campaign
{
/// Looks at a running world after every promise: what must hold at any instant.
class Watch
{
public:
  Watch(const Case& item, const block_world::World& world, Result& result);

  void look(block_world::World& world);

  /// All contacts so far.
  const std::vector<block_world::ContactEvent>& contacts() const
  {
    return contacts_;
  }

private:
  struct Momentum
  {
    Vector2d linear = Vector2d::Zero();
    double angular = 0.0;
    double linear_scale = 0.0, angular_scale = 0.0;
  };
  void checkOverlap(const block_world::World& world);
  void checkEnergy(const block_world::World& world);
  void checkMomentum(const block_world::World& world);
  void takeContacts(block_world::World& world);
  Momentum momentumOf(const block_world::World& world) const;

  Result& result_;
  std::vector<Outline> outlines_;
  std::vector<block_world::ContactEvent> contacts_;
  double start_energy_ = 0.0, lowest_ = 0.0, scale_ = 0.0;
  Momentum start_momentum_;
  bool is_turned_ = false;  ///< by dampers of springs without length, which act beside the line of their ends
};

/// Lengths in m: the largest coordinate that a block or wall of the case has at the start.
double lengthOf(const Case& item);

}  // namespace campaign
