#include <cmath>

#include "engine.h"
#include "scenes.h"

// Blocks that rest on one another, slide or hang.

namespace block_world::speed
{
namespace
{
constexpr double exact = 1e-10;  // m
constexpr int steps = 4;         // of the references, a frame

Measure asked(Measure measure)
{
  measure.goal = exact;
  return measure;
}

/// Squares on one another on the floor. A minute, in which nothing may move.
Case tower(Variation& vary, const std::string& name, const std::vector<double>& masses)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.elasticity = 0.3;
  scene.walls.bottom = 0.0;
  const double side = vary(1.0, 0.5);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    scene.blocks.push_back(box(side, side, 0.0, side * (static_cast<double>(i) + 0.5)));
    scene.blocks.back().mass = vary(masses[i], 0.3);
  }
  scene = finished(scene, name);
  const int frames = 60 * frame_rate;
  return { name, { scene }, frames, { asked(cornerError(rest(scene, frames))) }, 1.0, true };
}

/// Newton's cradle: a row of five that touch.
Case newtonsCradle(Variation& vary, const std::string& name, int strikers)
{
  Scene scene;
  const double side = vary(1.0, 0.3), speed = vary(1.0, 0.5);
  for (int i = 0; i < 5; ++i)
    scene.blocks.push_back(moving(box(side, side, side * i, 0.0), i < strikers ? speed : 0.0, 0.0));
  scene = finished(scene, name);
  const int frames = 2 * frame_rate;
  return { name, { scene }, frames, { asked(cornerError(cradle(scene, frames, strikers))) }, 1.0 };
}

/// One block, as long as its path.
Case toTheEnd(const Scene& scene, const Path& path)
{
  return { scene.name, { scene }, static_cast<int>(path.size()) - 1, { asked(cornerError(path)) }, 3.0 };
}

/// Slides down, leaning on one corner on the floor.
Case rod(Variation& vary)
{
  const double length = 2.0, thickness = vary(0.1, 0.5), angle = vary(0.9, 0.3);
  const double lean = std::atan2(thickness, length), reach = std::hypot(length, thickness) / 2;
  Scene scene;
  scene.gravity = 9.8;
  scene.elasticity = 0.0;
  scene.walls.bottom = 0.0;
  scene.blocks = { box(length, thickness, 0.0, reach * std::sin(angle + lean), angle) };
  scene = finished(scene, "rod on a corner");
  return toTheEnd(scene, fallingRod(scene, frame_rate, steps));
}

/// Slides down wall and floor and leaves the wall.
Case ladderCase(Variation& vary)
{
  const double p = 1.0, h = vary(0.05, 0.5), angle = vary(1.1, 0.1);
  Scene scene;
  scene.gravity = 9.8;
  scene.elasticity = 0.0;
  scene.walls.left = scene.walls.bottom = 0.0;
  scene.blocks = { box(2 * p, 2 * h, p * std::cos(angle) + h * std::sin(angle),
                       p * std::sin(angle) + h * std::cos(angle), -angle) };
  scene = finished(scene, "ladder");
  return toTheEnd(scene, ladder(scene, 2 * frame_rate, steps));
}

/// Hangs on a damped spring at a corner.
Case hanging(Variation& vary)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.blocks = { moving(box(1.0, 0.5, 0.5, -1.5, vary(0.3, 0.5)), vary(0.5, 0.5), 0.0, vary(0.4, 0.5)) };
  Spring spring;
  spring.from_block = "block1";
  spring.from_point = { 0.5, 0.25 };
  spring.stiffness = vary(40.0, 0.3);
  spring.rest_length = vary(1.0, 0.2);
  spring.damping = vary(0.5, 0.3);
  scene.springs = { spring };
  scene = finished(scene, "block on a spring");
  return toTheEnd(scene, springBlock(scene, 5 * frame_rate, steps));
}

}  // namespace

void addContacts(std::vector<Family>& families)
{
  const auto towers = [&](const std::string& name, bool quick, const std::vector<double>& masses) {
    families.push_back({ name, quick, [name, masses](Variation& vary) { return tower(vary, name, masses); } });
  };
  towers("tower of 1", false, { 1.0 });
  towers("tower of 3", false, { 1.0, 1.0, 1.0 });
  towers("tower of 10", true, std::vector<double>(10, 1.0));
  towers("heavy on light", true, { 1.0, 1.0, 1.0, 1000.0 });
  families.push_back({ "cradle", true, [](Variation& vary) { return newtonsCradle(vary, "cradle", 1); } });
  families.push_back(
      { "cradle, two", false, [](Variation& vary) { return newtonsCradle(vary, "cradle, two strike", 2); } });
  families.push_back({ "rod", true, rod });
  families.push_back({ "ladder", true, ladderCase });
  families.push_back({ "spring", true, hanging });
}

}  // namespace block_world::speed
