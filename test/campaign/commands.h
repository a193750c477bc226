#pragma once

#include "case.h"
#include "dice.h"

namespace campaign
{
/// Throws the commands of a case: its timed inputs, and the script of those that no scene file holds.
class CommandMaker
{
public:
  /// size: of the place where the blocks are.
  CommandMaker(Dice& dice, Case& item, const Eigen::Vector2d& size);

  void make();

private:
  block_world::Command inputFor(const block_world::Block& block);
  void moveMouse(const block_world::Block& block, double time);
  block_world::Command scripted(int number);
  block_world::SetCommand set();
  double duration();
  Eigen::Vector2d place();
  Eigen::Vector2d pointIn(const block_world::Block& block);
  void sort();

  Dice& dice_;
  Case& case_;
  Eigen::Vector2d size_;
  std::vector<block_world::Block> movable_;
};

}  // namespace campaign
