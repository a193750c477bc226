#include <box2d/box2d.h>

#include <algorithm>

#include "engine.h"

namespace block_world::speed
{
namespace
{
b2Vec2 vec(const Eigen::Vector2d& v)
{
  return b2Vec2(static_cast<float>(v.x()), static_cast<float>(v.y()));
}

/// Pairs take the larger restitution: all have the same. Its threshold is a fixture's since 2.4.1.
class Box2d : public Simulation
{
public:
  Box2d(const Scene& scene, const Setting& setting)
    : setting_(setting), world_(b2Vec2(0.0f, static_cast<float>(-scene.gravity)))
  {
    world_.SetAllowSleeping(setting.sleeping);
    for (const Block& block : scene.blocks)
      bodies_.push_back(add(scene, block));
    for (const Block& wall : wallBlocks(scene.walls))
      add(scene, wall);
    b2BodyDef definition;
    ground_ = world_.CreateBody(&definition);
    for (const Spring& spring : scene.springs)
      add(scene, spring);
  }

  void nextFrame() override
  {
    // 8 velocity and 3 position iterations are the manual's.
    const int position_iterations = 3 * setting_.iterations / 8;
    for (int i = 0; i < setting_.steps; ++i)
      world_.Step(1.0f / static_cast<float>(frame_rate * setting_.steps), setting_.iterations, position_iterations);
  }

  MotionState state(int block) const override
  {
    const b2Body& body = *bodies_[block];
    MotionState state;
    state.position = { body.GetPosition().x, body.GetPosition().y };
    state.angle = body.GetAngle();
    state.velocity = { body.GetLinearVelocity().x, body.GetLinearVelocity().y };
    state.omega = body.GetAngularVelocity();
    return state;
  }

private:
  b2Body* add(const Scene& scene, const Block& block)
  {
    b2BodyDef definition;
    definition.type = block.fixed ? b2_staticBody : b2_dynamicBody;
    definition.position = vec(block.position);
    definition.angle = static_cast<float>(block.angle);
    definition.linearVelocity = vec(block.velocity);
    definition.angularVelocity = static_cast<float>(block.omega);
    const DampingRates rates = dampingRates(scene, block);
    definition.linearDamping = static_cast<float>(rates.linear);
    definition.angularDamping = static_cast<float>(rates.angular);
    definition.bullet = setting_.effort > 0 && !block.fixed;
    b2Body* body = world_.CreateBody(&definition);

    // A polygon has a skin that keeps it off others; with more effort the block is the polygon with its skin.
    const Eigen::Vector2d half = *block.size / 2;
    const double skin = setting_.effort > 1 ? std::min<double>(b2_polygonRadius, 0.5 * half.minCoeff()) : 0.0;
    b2PolygonShape shape;
    shape.SetAsBox(static_cast<float>(half.x() - skin), static_cast<float>(half.y() - skin));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = 0.0f;
    fixture.restitution = static_cast<float>(scene.elasticity);
    fixture.density = 1.0f;
    if (setting_.effort > 0)
      fixture.restitutionThreshold = 0.0f;
    body->CreateFixture(&fixture);
    const b2MassData mass{ static_cast<float>(block.mass), b2Vec2_zero, static_cast<float>(inertia(block)) };
    body->SetMassData(&mass);
    return body;
  }

  void add(const Scene& scene, const Spring& spring)
  {
    const int from = indexOf(scene, spring.from_block), to = indexOf(scene, spring.to_block);
    b2DistanceJointDef definition;
    definition.bodyA = bodies_[from];
    definition.bodyB = to < 0 ? ground_ : bodies_[to];
    definition.localAnchorA = vec(spring.from_point);
    definition.localAnchorB = vec(spring.to_point);
    definition.length = static_cast<float>(spring.rest_length);
    definition.minLength = 0.0f;
    definition.maxLength = 1e3f;
    definition.stiffness = static_cast<float>(spring.stiffness);
    definition.damping = static_cast<float>(spring.damping);
    definition.collideConnected = true;
    world_.CreateJoint(&definition);
  }

  Setting setting_;
  b2World world_;
  b2Body* ground_ = nullptr;
  std::vector<b2Body*> bodies_;
};

std::string cannot(const Scene& scene)
{
  for (const Spring& spring : scene.springs)
    if (spring.rest_length <= 0.0)
      return "no spring without a rest length";
  return std::string();
}

}  // namespace

Engine box2d()
{
  return { "Box2D",
           std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
               std::to_string(b2_version.revision),
           sweep({ { "8 iterations, as shipped", 8, 0, true },
                   { "8 iterations, threshold 0, bullets", 8, 1, true },
                   { "32 iterations, threshold 0, bullets, skin inside", 32, 2, true } }),
           [](const Scene& scene, const Setting& setting) -> std::unique_ptr<Simulation> {
             return std::make_unique<Box2d>(scene, setting);
           },
           cannot };
}

}  // namespace block_world::speed
