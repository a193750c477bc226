#pragma once

#include "block_world/block.h"
#include "dice.h"
#include "outline.h"

namespace campaign
{
std::vector<Vector2d> corners(const Vector2d& size);

/// A rectangle or a convex polygon of 3 to 8 corners about its centre of mass, sizes over 1:30 from 0.1 m on.
block_world::Block makeShape(Dice& dice);

double areaOf(const block_world::Block& block);
/// Of the circle about the centre of mass.
double widthOf(const block_world::Block& block);

}  // namespace campaign
