#include "reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine.h"

namespace block_world::speed
{
Real frameTime(int frame)
{
  return static_cast<Real>(frame) / frame_rate;
}

Bodies start(const Scene& scene)
{
  Bodies bodies;
  for (const Block& block : scene.blocks)
  {
    if (!block.size)
      throw std::runtime_error("reference: only rectangles");
    Body body;
    body.mass = block.mass;
    body.half = block.size->cast<Real>() / 2;
    body.inertia = body.mass * body.half.squaredNorm() / 3;
    body.position = block.position.cast<Real>();
    body.velocity = block.velocity.cast<Real>();
    body.angle = block.angle;
    body.omega = block.omega;
    bodies.push_back(body);
  }
  return bodies;
}

Vector corner(const Body& body, int index)
{
  const Real x = (index == 0 || index == 3 ? -1 : 1) * body.half.x(), y = (index < 2 ? -1 : 1) * body.half.y();
  const Real c = std::cos(body.angle), s = std::sin(body.angle);
  return body.position + Vector(c * x - s * y, s * x + c * y);
}

Real cornerDistance(const Bodies& a, const Bodies& b)
{
  Real distance = 0;
  for (std::size_t block = 0; block < a.size(); ++block)
    for (int i = 0; i < 4; ++i)
    {
      const Real here = (corner(a[block], i) - corner(b[block], i)).norm();
      // What is not a number is infinitely far.
      distance = std::isnan(here) ? HUGE_VALL : std::max(distance, here);
    }
  return distance;
}

namespace
{
/// v' = gravity - k v and omega' = -l omega, with final velocity gravity / k.
Body flown(Body body, const Scene& scene, Real time)
{
  const Real k = static_cast<Real>(scene.damping) / body.mass;
  const Real l = static_cast<Real>(scene.damping) * static_cast<Real>(scene.rotational_damping_ratio) / body.inertia;
  const Vector final_velocity = Vector(0, -static_cast<Real>(scene.gravity)) / k;
  const Vector excess = body.velocity - final_velocity;
  body.position += final_velocity * time - excess * std::expm1(-k * time) / k;
  body.velocity = final_velocity + excess * std::exp(-k * time);
  body.angle -= body.omega * std::expm1(-l * time) / l;
  body.omega *= std::exp(-l * time);
  return body;
}

/// Height over the floor and speed at a time, of what falls from a height.
std::pair<Real, Real> bounced(Real height, Real gravity, Real elasticity, Real time)
{
  const Real fall = std::sqrt(2 * height / gravity);
  if (time < fall)
    return { height - gravity * time * time / 2, -gravity * time };
  Real landed = fall, up = elasticity * gravity * fall;
  while (time - landed > 2 * up / gravity && up > 1e-25L)
  {
    landed += 2 * up / gravity;
    up *= elasticity;
  }
  if (up <= 1e-25L)
    return { 0, 0 };
  const Real since = time - landed;
  return { since * (up - gravity * since / 2), up - gravity * since };
}

}  // namespace

Path flight(const Scene& scene, int frames)
{
  Path path;
  for (int frame = 0; frame <= frames; ++frame)
  {
    path.push_back(start(scene));
    for (Body& body : path.back())
      body = flown(body, scene, frameTime(frame));
  }
  return path;
}

Path bounces(const Scene& scene, int frames)
{
  Path path;
  for (int frame = 0; frame <= frames; ++frame)
  {
    path.push_back(start(scene));
    for (Body& body : path.back())
    {
      const Real floor = static_cast<Real>(*scene.walls.bottom) + body.half.y();
      const auto [height, speed] =
          bounced(body.position.y() - floor, scene.gravity, scene.elasticity, frameTime(frame));
      body.position.x() += body.velocity.x() * frameTime(frame);
      body.position.y() = floor + height;
      body.velocity.y() = speed;
    }
  }
  return path;
}

Path rest(const Scene& scene, int frames)
{
  return Path(frames + 1, start(scene));
}

Path cradle(const Scene& scene, int frames, int strikers)
{
  Path path;
  for (int frame = 0; frame <= frames; ++frame)
  {
    Bodies bodies = start(scene);
    const Vector velocity = bodies.front().velocity;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
      bodies[i].velocity = i + strikers < bodies.size() ? Vector::Zero() : velocity;
      bodies[i].position += frameTime(frame) * bodies[i].velocity;
    }
    path.push_back(bodies);
  }
  return path;
}

}  // namespace block_world::speed
