#pragma once

#include "world_testing.h"

// The scenes of section B, which section J looks at in a mirror and in other orders. No gravity where nothing is said.

namespace block_world
{
/// B1-B4: unit squares in a row.
inline Scene makeRow(double elasticity, const std::vector<double>& masses, const std::vector<double>& speeds,
                     double gap = 0.0)
{
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < masses.size(); ++i)
    blocks.push_back(withMass(
        moving(makeBox("b" + std::to_string(i), { 1, 1 }, { (1.0 + gap) * i, 0 }), { speeds[i], 0 }), masses[i]));
  return makeScene(0.0, elasticity, blocks);
}

/// B5: a box lands flat.
inline Scene makeFlatLanding(double elasticity)
{
  return makeScene(0.0, elasticity, { moving(makeBox("a", { 1, 0.5 }, { 0, 0.5 }), { 0, -1 }) }, onFloor());
}

/// B6: a box falls from 0.75 m, tilted.
inline Scene makeTiltedLanding(double tilt, double tolerance)
{
  Scene scene = makeScene(9.8, 1.0, { makeBox("a", { 1, 0.5 }, { 0, 1 }, tilt) }, onFloor());
  scene.tolerance = tolerance;
  return scene;
}

/// B7: a block on two; `shift` takes it out of the middle.
inline Scene makeOneOnTwo(double shift = 0.0)
{
  return makeScene(0.0, 1.0,
                   { moving(makeBox("top", { 2, 0.5 }, { shift, 1.25 }), { 0, -1 }),
                     makeBox("left", { 0.6, 1 }, { -0.5, 0.5 }), makeBox("right", { 0.6, 1 }, { 0.5, 0.5 }) },
                   onFloor());
}

/// B8: a square, corner down, over a right-angled V of two fixed blocks.
inline Scene makeVee(double elasticity)
{
  const double s = std::sqrt(0.5);
  return makeScene(0.0, elasticity,
                   { moving(makeBox("a", { 0.5, 0.5 }, { 0, 1 }, pi / 4), { 0, -1 }),
                     fixedOne(makeBox("right", { 4, 1 }, { 2 * s, s }, pi / 4)),
                     fixedOne(makeBox("left", { 4, 1 }, { -2 * s, s }, -pi / 4)) });
}

/// B10: a square between two walls without room.
inline Scene makeTightSlot()
{
  Walls walls;
  walls.left = -0.5;
  walls.right = 0.5;
  return makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0.25 }) }, walls);
}

/// B11: squares that meet corner on corner.
inline Scene makeCornerOnCorner(double elasticity)
{
  return makeScene(0.0, elasticity,
                   { moving(makeBox("a", { 0.5, 0.5 }, { -1, 5 }, pi / 4), { 1, 0 }),
                     moving(makeBox("b", { 0.5, 0.5 }, { 1, 5 }, pi / 4), { -1, 0 }) });
}

/// B12: many land at one instant, far from one another.
inline Scene makeLandings(int count)
{
  std::vector<Block> blocks;
  for (int i = 0; i < count; ++i)
    blocks.push_back(makeBox("b" + std::to_string(i), { 0.5, 0.5 }, { 2.0 * i, 1.25 }));
  return makeScene(9.8, 0.5, blocks, onFloor());
}

/// B13: bricks on the floor are hit from the side.
inline Scene makeBrickWall()
{
  std::vector<Block> blocks{ moving(makeBox("ball", { 1, 0.4 }, { -1.5, 0.75 }), { 3, 0 }) };
  for (const double x : { -0.5, 0.5 })
    for (const double y : { 0.25, 0.75 })
      blocks.push_back(makeBox("brick" + std::to_string(blocks.size()), { 1, 0.5 }, { x, y }));
  return makeScene(0.0, 1.0, blocks, onFloor());
}

struct Collision
{
  const char* what;
  Scene scene;
  double seconds;  ///< just after
};

inline std::vector<Collision> makeCollisions()
{
  const std::vector<double> ones(5, 1.0), first{ 1, 0, 0, 0, 0 }, both{ 1, 1, 0, 0, 0 };
  return {
    { "B1 cradle", shipped("cradle"), 1.0 },
    { "B2 cradle, two incoming", makeRow(1.0, ones, both), 1.0 },
    { "B3 cradle, e = .9", makeRow(0.9, ones, first), 20.0 },
    { "B4 unequal masses", makeRow(1.0, { 1, 1000, 1 }, { 1, 0, 0 }), 0.1 },
    { "B5 flat landing", makeFlatLanding(1.0), 0.5 },
    { "B5 flat landing, e = .5", makeFlatLanding(0.5), 0.5 },
    { "B6 tilt 1e-9 at 1e-6", makeTiltedLanding(1e-9, 1e-6), 0.5 },
    { "B6 tilt 1e-6 at 1e-9", makeTiltedLanding(1e-6, 1e-9), 0.5 },
    { "B6 tilt 1e-3 at 1e-9", makeTiltedLanding(1e-3, 1e-9), 0.5 },
    { "B7 one on two", makeOneOnTwo(), 0.1 },
    { "B7 one on two, off the middle", makeOneOnTwo(0.2), 0.1 },
    { "B8 square in a V", makeVee(1.0), 1.0 },
    { "B8 square in a V, e = .5", makeVee(0.5), 1.0 },
    { "B10 locked slot", makeTightSlot(), 1.0 },
    { "B11 corner on corner", makeCornerOnCorner(1.0), 2.0 },
    { "B11 corner on corner, e = .5", makeCornerOnCorner(0.5), 2.0 },
    { "B12 landings", makeLandings(10), 2.0 },
    { "B13 brick wall", makeBrickWall(), 0.05 },
  };
}

}  // namespace block_world
