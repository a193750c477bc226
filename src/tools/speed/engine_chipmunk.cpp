#include <chipmunk/chipmunk.h>

#include <cmath>

#include "engine.h"

namespace block_world::speed
{
namespace
{
cpVect vec(const Eigen::Vector2d& v)
{
  return cpv(v.x(), v.y());
}

class Chipmunk : public Simulation
{
public:
  Chipmunk(const Scene& scene, const Setting& setting) : setting_(setting), space_(cpSpaceNew())
  {
    cpSpaceSetGravity(space_, cpv(0.0, -scene.gravity));
    cpSpaceSetIterations(space_, setting.iterations);
    if (setting.effort > 0)
      cpSpaceSetCollisionSlop(space_, 1e-4);  // shipped: 0.1, made for pixels
    if (setting.sleeping)
      cpSpaceSetSleepTimeThreshold(space_, 0.5);
    // One rate for all bodies and both kinds of motion (see cannot).
    cpSpaceSetDamping(space_, std::exp(-dampingRates(scene, scene.blocks.front()).linear));
    // Pairs take the product of the two.
    elasticity_ = std::sqrt(scene.elasticity);
    for (const Block& block : scene.blocks)
      add(block);
    for (const Block& wall : wallBlocks(scene.walls))
      add(wall);
    for (const Spring& spring : scene.springs)
      add(scene, spring);
  }

  ~Chipmunk() override
  {
    for (cpConstraint* spring : springs_)
    {
      cpSpaceRemoveConstraint(space_, spring);
      cpConstraintFree(spring);
    }
    for (cpShape* shape : shapes_)
    {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_)
    {
      if (cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC)
        cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  void nextFrame() override
  {
    for (int i = 0; i < setting_.steps; ++i)
      cpSpaceStep(space_, 1.0 / (frame_rate * setting_.steps));
  }

  MotionState state(int block) const override
  {
    const cpBody* body = bodies_[block];
    const cpVect position = cpBodyGetPosition(body), velocity = cpBodyGetVelocity(body);
    MotionState state;
    state.position = { position.x, position.y };
    state.angle = cpBodyGetAngle(body);
    state.velocity = { velocity.x, velocity.y };
    state.omega = cpBodyGetAngularVelocity(body);
    return state;
  }

private:
  void add(const Block& block)
  {
    cpBody* body = block.fixed ? cpBodyNewStatic() : cpSpaceAddBody(space_, cpBodyNew(block.mass, inertia(block)));
    bodies_.push_back(body);
    cpBodySetPosition(body, vec(block.position));
    cpBodySetAngle(body, block.angle);
    if (!block.fixed)
    {
      cpBodySetVelocity(body, vec(block.velocity));
      cpBodySetAngularVelocity(body, block.omega);
    }
    cpShape* shape = cpBoxShapeNew(body, block.size->x(), block.size->y(), 0.0);
    cpShapeSetElasticity(shape, elasticity_);
    cpShapeSetFriction(shape, 0.0);
    shapes_.push_back(cpSpaceAddShape(space_, shape));
  }

  void add(const Scene& scene, const Spring& spring)
  {
    const int from = indexOf(scene, spring.from_block), to = indexOf(scene, spring.to_block);
    cpBody* other = to < 0 ? cpSpaceGetStaticBody(space_) : bodies_[to];
    springs_.push_back(cpSpaceAddConstraint(space_, cpDampedSpringNew(bodies_[from], other, vec(spring.from_point),
                                                                      vec(spring.to_point), spring.rest_length,
                                                                      spring.stiffness, spring.damping)));
  }

  Setting setting_;
  cpSpace* space_;
  double elasticity_ = 1.0;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;
  std::vector<cpConstraint*> springs_;
};

std::string cannot(const Scene& scene)
{
  const double rate = dampingRates(scene, scene.blocks.front()).linear;
  for (const Block& block : scene.blocks)
  {
    const DampingRates rates = dampingRates(scene, block);
    if (std::abs(rates.linear - rate) > 1e-12 || std::abs(rates.angular - rate) > 1e-12)
      return "one rate of damping for all motion";
  }
  for (const Spring& spring : scene.springs)
    if (spring.rest_length <= 0.0)
      return "no spring without a rest length";
  return std::string();
}

}  // namespace

Engine chipmunk()
{
  return { "Chipmunk", cpVersionString,
           sweep({ { "10 iterations, as shipped", 10, 0, false },
                   { "10 iterations, sleeping", 10, 0, true, false },
                   { "10 iterations, slop 0.1 mm, sleeping", 10, 1, true },
                   { "40 iterations, slop 0.1 mm, sleeping", 40, 1, true } }),
           [](const Scene& scene, const Setting& setting) -> std::unique_ptr<Simulation> {
             return std::make_unique<Chipmunk>(scene, setting);
           },
           cannot };
}

}  // namespace block_world::speed
