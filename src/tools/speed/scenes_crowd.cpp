#include <cmath>

#include "engine.h"
#include "scenes.h"

// Many blocks, or many runs: nobody knows where each belongs, but what may not happen.

namespace block_world::speed
{
namespace
{
const double pi = std::acos(-1.0);

Measure asked(Measure measure, double goal)
{
  measure.goal = goal;
  return measure;
}

/// Thin spinning blocks fly at something so that they must hit it.
constexpr int shots = 1000;

Block bulletBlock(Variation& vary)
{
  return moving(box(0.5, 0.02, -2.0, vary.in(-0.2, 0.2), vary.in(-pi, pi)), vary.in(30.0, 70.0), 0.0,
                vary.in(-1.0, 1.0) < 0.0 ? -vary.in(20.0, 80.0) : vary.in(20.0, 80.0));
}

Case shotsAt(Variation& vary, const std::string& name, const Block& target,
             const std::function<bool(const Recording&)>& missed)
{
  Case result;
  result.name = name;
  result.frames = frame_rate / 5;
  result.cheaper = 1.0;
  for (int i = 0; i < shots; ++i)
  {
    Scene scene;
    scene.blocks = { bulletBlock(vary), target };
    result.scenes.push_back(finished(scene, name));
  }
  const auto count = [missed](const Run& run) {
    double sum = 0.0;
    for (const Recording& recording : run.recordings)
      sum += missed(recording) ? 1.0 : 0.0;
    return sum;
  };
  result.measures = { { "missed of 1000", "hits", count, 0.0 } };
  return result;
}

/// The wall is thin, too, and high: what is behind it went through.
Case shotsAtWall(Variation& vary)
{
  Block wall = box(0.02, 20.0, 0.0, 0.0);
  wall.fixed = true;
  return shotsAt(vary, "fast thin block, thin wall", wall, [](const Recording& recording) {
    for (int frame = 0; frame < recording.frames(); ++frame)
      if (recording.at(frame, 0).position.x() > 0.27)
        return true;
    return false;
  });
}

/// What was not set in motion was not hit.
Case shotsAtBlock(Variation& vary)
{
  return shotsAt(vary, "fast thin block, thin block", box(0.02, 1.0, 0.0, 0.0), [](const Recording& recording) {
    return !(recording.at(recording.frames() - 1, 1).velocity.norm() > 1e-3);
  });
}

/// Boxes with masses of 1 to 100 kg at random turns over one another in a bin.
Case heap(Variation& vary, int count, double dearer)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.elasticity = 0.3;
  scene.walls.left = -3.2;
  scene.walls.right = 3.2;
  scene.walls.bottom = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const double width = vary.in(0.4, 1.0), height = vary.in(0.4, 1.0), angle = vary.in(-pi, pi);
    scene.blocks.push_back(box(width, height, 1.5 * (i % 4) - 2.25, 1.0 + 1.5 * (i / 4), angle));
    scene.blocks.back().mass = std::pow(10.0, vary.in(0.0, 2.0));
  }
  scene = finished(scene, "heap of " + std::to_string(count));
  return { scene.name,
           { scene },
           4 * frame_rate,
           { asked(overlap(scene), scene.tolerance), asked(energyGain(scene), 1e-12) },
           1.0 / dearer };
}

/// Boxes at about 1 m/s in a closed room, of which they fill a fifth.
Case gas(Variation& vary, int side_by_side, int rows, int seconds)
{
  const double cell = std::sqrt(0.5 * 0.3 / 0.2);
  Scene scene;
  scene.walls = { 0.0, cell * side_by_side, 0.0, cell * rows };
  for (int i = 0; i < side_by_side * rows; ++i)
  {
    const double heading = vary.in(-pi, pi), speed = vary.in(0.5, 1.5), angle = vary.in(-pi, pi);
    scene.blocks.push_back(
        moving(box(0.5, 0.3, cell * (i % side_by_side + 0.5), cell * (i / side_by_side + 0.5), angle),
               speed * std::cos(heading), speed * std::sin(heading), vary.in(-1.0, 1.0)));
  }
  scene = finished(scene, "gas of " + std::to_string(side_by_side * rows));
  Case result{ scene.name, { scene }, seconds * frame_rate, { asked(energyChange(scene), 1e-12) }, 1.0 };
  result.counts_collisions = true;
  return result;
}

}  // namespace

void addCrowds(std::vector<Family>& families)
{
  families.push_back({ "thin wall", false, shotsAtWall });
  families.push_back({ "thin block", false, shotsAtBlock });
  families.push_back({ "heap of 6", true, [](Variation& vary) { return heap(vary, 6, 2.0); } });
  families.push_back({ "heap of 12", false, [](Variation& vary) { return heap(vary, 12, 10.0); } });
  families.push_back({ "heap of 24", false, [](Variation& vary) { return heap(vary, 24, 30.0); } });
  families.push_back({ "gas of 100", true, [](Variation& vary) { return gas(vary, 10, 10, 10); } });
  families.push_back({ "gas of 1000", false, [](Variation& vary) { return gas(vary, 40, 25, 3); } });
  families.push_back({ "gas of 5000", false, [](Variation& vary) { return gas(vary, 100, 50, 1); } });
}

}  // namespace block_world::speed
