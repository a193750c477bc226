#include <cmath>

#include "engine.h"
#include "scenes.h"

// One or two blocks; where each of them belongs is known to 19 digits.

namespace block_world::speed
{
namespace
{
constexpr double exact = 1e-10;  // m

Measure asked(Measure measure, double goal)
{
  measure.goal = goal;
  return measure;
}

Case oneScene(const Scene& scene, int frames, std::vector<Measure> measures, double cheaper)
{
  return { scene.name, { scene }, frames, std::move(measures), cheaper };
}

/// Both decay rates are equal (the ratio is I / m), since Chipmunk has one for both.
Case damped(Variation& vary)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.damping = vary(0.5, 0.3);
  scene.blocks = { moving(box(1.0, vary(3.0, 0.3), 0.0, 0.0, vary(0.3, 0.5)), vary(4.0, 0.3), vary(12.0, 0.3),
                          vary(5.0, 0.3)) };
  scene.rotational_damping_ratio = scene.blocks[0].size->squaredNorm() / 12.0;
  scene = finished(scene, "damped flight");
  return oneScene(scene, 10 * frame_rate, { asked(cornerError(flight(scene, 10 * frame_rate)), exact) }, 3.0);
}

Case drop(Variation& vary, const std::string& name, double elasticity, int seconds)
{
  Scene scene;
  scene.gravity = 9.8;
  scene.elasticity = elasticity;
  scene.walls.bottom = 0.0;
  scene.blocks = { moving(box(0.5, 0.25, 0.0, vary(1.0, 0.3)), vary(0.5, 0.3), 0.0) };
  scene = finished(scene, name);
  const int frames = seconds * frame_rate;
  return oneScene(scene, frames, { asked(cornerError(bounces(scene, frames)), exact) }, 3.0);
}

Case elasticDrop(Variation& vary)
{
  return drop(vary, "elastic drop", 1.0, 10);
}

/// The last of infinitely many bounces is at t0 (1 + e) / (1 - e) = 1.27 s; some of the last are replaced by their
/// limit.
Case dropToRest(Variation& vary)
{
  Case result = drop(vary, "drop to rest", vary(0.5, 0.3), 4);
  const Path path = bounces(result.scenes[0], result.frames);
  result.measures.push_back(asked(cornerErrorAt(path, result.frames), exact));
  return result;
}

Case tumble(Variation& vary)
{
  Scene scene;
  scene.walls = { -3.0, 3.0, -3.0, 3.0 };
  scene.blocks = { moving(box(1.0, vary(3.0, 0.2), 0.2, -0.1, vary(0.4, 0.5)), vary(2.1, 0.3), vary(1.3, 0.3),
                          vary(1.7, 0.3)) };
  scene = finished(scene, "tumble");
  const int frames = 5 * frame_rate;
  return oneScene(scene, frames, { asked(cornerError(trustedCollisions(scene, frames)), exact) }, 3.0);
}

/// Two blocks that hit each other off their centres.
Case pair(Variation& vary, const std::string& name, double elasticity)
{
  Scene scene;
  scene.elasticity = elasticity;
  scene.blocks = { moving(box(1.0, 0.5, -1.5, 0.0, vary(0.2, 0.5)), vary(2.0, 0.3), 0.0, vary(0.5, 0.3)),
                   moving(box(0.5, 1.5, 1.0, vary(0.4, 0.3), vary(-0.1, 0.5)), vary(-1.0, 0.3), vary(0.1, 0.3)) };
  scene.blocks[1].mass = vary(3.0, 0.3);
  scene = finished(scene, name);
  // They hit before 0.9 s; with loss, random ones can later hit ever faster, which the reference cannot follow.
  const int frames = 6 * frame_rate / 5;
  return oneScene(scene, frames, { asked(cornerError(trustedCollisions(scene, frames)), exact) }, 1.0);
}

/// Of the shipped scene, all of its six blocks, without loss.
Case sixBlocks(Variation& vary)
{
  Scene scene;
  scene.walls = { -6.0, 6.0, -6.0, 6.0 };
  const auto add = [&](double x, double y, double angle, double vx, double vy, double omega) {
    scene.blocks.push_back(
        moving(box(1.0, 3.0, x, y, vary(angle, 0.02)), vary(vx, 0.3), vary(vy, 0.3), vary(omega, 0.3)));
  };
  add(-5.3, 0.0, 0.0, 1.0, -0.3608, -0.3956);
  add(-2.2, 0.0, 0.0, -1.0, -0.01696, 0.30647);
  add(2.867, -0.113, 0.0, -0.29445, -0.11189, -0.23464);
  add(1.36, 2.5, -0.78539816339744828, -0.45535, -0.37665, 0.36526);
  add(-2.0, 2.5, 1.6707963267948966, 0.0, 0.0, 0.0);
  add(0.08, 0.127, 0.888, 0.0, 0.0, 0.0);
  scene = finished(scene, "six blocks");
  // Later, chaos has multiplied the rounding of the start.
  const Path path = trustedCollisions(scene, 2 * frame_rate);
  return oneScene(scene, 10 * frame_rate,
                  { asked(cornerErrorAt(path, 1 * frame_rate), exact), cornerErrorAt(path, 2 * frame_rate),
                    asked(energyChange(scene), 1e-12) },
                  2.0);
}

}  // namespace

void addSingles(std::vector<Family>& families)
{
  families.push_back({ "damped flight", true, damped });
  families.push_back({ "elastic drop", true, elasticDrop });
  families.push_back({ "drop to rest", true, dropToRest });
  families.push_back({ "tumble", true, tumble });
  families.push_back({ "pair", true, [](Variation& vary) { return pair(vary, "pair, e = 1", 1.0); } });
  families.push_back({ "lossy pair", false, [](Variation& vary) { return pair(vary, "pair, e = 0.5", 0.5); } });
  families.push_back({ "six blocks", true, sixBlocks });
}

}  // namespace block_world::speed
