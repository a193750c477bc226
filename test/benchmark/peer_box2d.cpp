#include <box2d/box2d.h>

#include "peers.h"

namespace peers
{
namespace
{
/// Box2D 2.4 as shipped: 8 velocity and 3 position iterations, sleeping allowed.
class Box2d : public Simulation
{
public:
  explicit Box2d(const block_world::Scene& scene) : world_(b2Vec2(0.0f, static_cast<float>(-scene.gravity)))
  {
    for (const block_world::Block& block : scene.blocks)
      addBlock(scene, block);
    b2BodyDef definition;
    b2Body* ground = world_.CreateBody(&definition);
    for (const WallLine& line : wallLines(scene.walls))
      addWall(*ground, line, scene.elasticity);
  }

  void nextFrame() override
  {
    world_.Step(1.0f / frame_rate, 8, 3);
  }

  block_world::MotionState state(int block) const override
  {
    const b2Body& body = *bodies_[block];
    block_world::MotionState state;
    state.position = { body.GetPosition().x, body.GetPosition().y };
    state.angle = body.GetAngle();
    state.velocity = { body.GetLinearVelocity().x, body.GetLinearVelocity().y };
    state.omega = body.GetAngularVelocity();
    return state;
  }

private:
  void addBlock(const block_world::Scene& scene, const block_world::Block& block)
  {
    const DampingRates rates = dampingRates(scene, block);
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position.Set(static_cast<float>(block.position.x()), static_cast<float>(block.position.y()));
    definition.angle = static_cast<float>(block.angle);
    definition.linearVelocity.Set(static_cast<float>(block.velocity.x()), static_cast<float>(block.velocity.y()));
    definition.angularVelocity = static_cast<float>(block.omega);
    definition.linearDamping = static_cast<float>(rates.linear);
    definition.angularDamping = static_cast<float>(rates.angular);
    bodies_.push_back(world_.CreateBody(&definition));

    b2PolygonShape shape;
    shape.SetAsBox(static_cast<float>(block.size->x() / 2), static_cast<float>(block.size->y() / 2));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = 0.0f;
    fixture.restitution = static_cast<float>(scene.elasticity);
    fixture.density = static_cast<float>(block.mass / block.size->prod());
    bodies_.back()->CreateFixture(&fixture);
  }

  void addWall(b2Body& ground, const WallLine& line, double elasticity)
  {
    b2EdgeShape shape;
    shape.SetTwoSided(b2Vec2(static_cast<float>(line.from.x()), static_cast<float>(line.from.y())),
                      b2Vec2(static_cast<float>(line.to.x()), static_cast<float>(line.to.y())));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = 0.0f;
    fixture.restitution = static_cast<float>(elasticity);
    ground.CreateFixture(&fixture);
  }

  b2World world_;
  std::vector<b2Body*> bodies_;
};
}  // namespace

std::unique_ptr<Simulation> buildBox2d(const block_world::Scene& scene)
{
  return std::make_unique<Box2d>(scene);
}

}  // namespace peers
