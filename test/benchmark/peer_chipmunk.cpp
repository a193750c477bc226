#include <chipmunk/chipmunk.h>

#include <cmath>

#include "peers.h"

namespace peers
{
namespace
{
/// Chipmunk 7 as shipped: 10 iterations.
class Chipmunk : public Simulation
{
public:
  explicit Chipmunk(const block_world::Scene& scene) : space_(cpSpaceNew())
  {
    cpSpaceSetGravity(space_, cpv(0.0, -scene.gravity));
    // One rate for all bodies and both kinds of motion; our damped scene has it so.
    cpSpaceSetDamping(space_, std::exp(-dampingRates(scene, scene.blocks.front()).linear));
    for (const block_world::Block& block : scene.blocks)
      addBlock(block, scene.elasticity);
    for (const WallLine& line : wallLines(scene.walls))
      add(cpSegmentShapeNew(cpSpaceGetStaticBody(space_), cpv(line.from.x(), line.from.y()),
                            cpv(line.to.x(), line.to.y()), 0.0),
          scene.elasticity);
  }

  ~Chipmunk() override
  {
    for (cpShape* shape : shapes_)
    {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_)
    {
      cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  void nextFrame() override
  {
    cpSpaceStep(space_, 1.0 / frame_rate);
  }

  block_world::MotionState state(int block) const override
  {
    const cpBody* body = bodies_[block];
    const cpVect position = cpBodyGetPosition(body), velocity = cpBodyGetVelocity(body);
    block_world::MotionState state;
    state.position = { position.x, position.y };
    state.angle = cpBodyGetAngle(body);
    state.velocity = { velocity.x, velocity.y };
    state.omega = cpBodyGetAngularVelocity(body);
    return state;
  }

private:
  void addBlock(const block_world::Block& block, double elasticity)
  {
    cpBody* body = cpSpaceAddBody(space_, cpBodyNew(block.mass, inertia(block)));
    bodies_.push_back(body);
    cpBodySetPosition(body, cpv(block.position.x(), block.position.y()));
    cpBodySetAngle(body, block.angle);
    cpBodySetVelocity(body, cpv(block.velocity.x(), block.velocity.y()));
    cpBodySetAngularVelocity(body, block.omega);
    add(cpBoxShapeNew(body, block.size->x(), block.size->y(), 0.0), elasticity);
  }

  void add(cpShape* shape, double elasticity)
  {
    cpShapeSetElasticity(shape, elasticity);
    cpShapeSetFriction(shape, 0.0);
    shapes_.push_back(cpSpaceAddShape(space_, shape));
  }

  cpSpace* space_;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;
};
}  // namespace

std::unique_ptr<Simulation> buildChipmunk(const block_world::Scene& scene)
{
  return std::make_unique<Chipmunk>(scene);
}

}  // namespace peers
