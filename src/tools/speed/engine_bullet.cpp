#include <btBulletDynamicsCommon.h>
#include <BulletCollision/CollisionDispatch/btBox2dBox2dCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btBox2dShape.h>

#include <algorithm>
#include <cmath>

#include "engine.h"

namespace block_world::speed
{
namespace
{
btVector3 vec(const Eigen::Vector2d& v)
{
  return btVector3(v.x(), v.y(), 0.0);
}

/// In double precision, held in the plane by factors, with the two-dimensional boxes.
class Bullet : public Simulation
{
public:
  Bullet(const Scene& scene, const Setting& setting)
    : setting_(setting), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_)
  {
    dispatcher_.registerCollisionCreateFunc(BOX_2D_SHAPE_PROXYTYPE, BOX_2D_SHAPE_PROXYTYPE, &box_box_);
    world_.setGravity(btVector3(0.0, -scene.gravity, 0.0));
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_numIterations = setting.iterations;
    if (setting.effort > 0)
    {
      info.m_restitutionVelocityThreshold = 0.0;
      info.m_splitImpulsePenetrationThreshold = 0.0;  // overlap is never corrected by velocity
    }
    for (const Block& block : scene.blocks)
      add(scene, block);
    for (const Block& wall : wallBlocks(scene.walls))
      add(scene, wall);
  }

  ~Bullet() override
  {
    for (const std::unique_ptr<btRigidBody>& body : bodies_)
      world_.removeRigidBody(body.get());
  }

  void nextFrame() override
  {
    for (int i = 0; i < setting_.steps; ++i)
      world_.stepSimulation(1.0 / (frame_rate * setting_.steps), 0);
  }

  MotionState state(int block) const override
  {
    const btRigidBody& body = *bodies_[block];
    const btTransform& pose = body.getWorldTransform();
    MotionState state;
    state.position = { pose.getOrigin().x(), pose.getOrigin().y() };
    state.angle = std::atan2(pose.getBasis()[1][0], pose.getBasis()[0][0]);
    state.velocity = { body.getLinearVelocity().x(), body.getLinearVelocity().y() };
    state.omega = body.getAngularVelocity().z();
    return state;
  }

private:
  void add(const Scene& scene, const Block& block)
  {
    const Eigen::Vector2d half = *block.size / 2;
    shapes_.push_back(std::make_unique<btBox2dShape>(btVector3(half.x(), half.y(), 1.0)));
    const double mass = block.fixed ? 0.0 : block.mass;
    const btVector3 local_inertia = btVector3(1.0, 1.0, 1.0) * (block.fixed ? 0.0 : inertia(block));
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), local_inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(vec(block.position));
    info.m_startWorldTransform.getBasis().setEulerZYX(0.0, 0.0, block.angle);
    info.m_friction = 0.0;
    // Pairs take the product of the two.
    info.m_restitution = std::sqrt(scene.elasticity);
    const DampingRates rates = dampingRates(scene, block);
    info.m_linearDamping = -std::expm1(-rates.linear);
    info.m_angularDamping = -std::expm1(-rates.angular);
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearFactor(btVector3(1.0, 1.0, 0.0));
    body->setAngularFactor(btVector3(0.0, 0.0, 1.0));
    if (!block.fixed)
    {
      body->setLinearVelocity(vec(block.velocity));
      body->setAngularVelocity(btVector3(0.0, 0.0, block.omega));
    }
    if (!setting_.sleeping)
      body->setActivationState(DISABLE_DEACTIVATION);
    if (setting_.effort > 0)
    {
      body->setCcdMotionThreshold(half.minCoeff());
      body->setCcdSweptSphereRadius(0.8 * half.minCoeff());
    }
    world_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
  }

  Setting setting_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btBox2dBox2dCollisionAlgorithm::CreateFunc box_box_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

std::string cannot(const Scene& scene)
{
  return scene.springs.empty() ? std::string() : "no spring between two points";
}

}  // namespace

Engine bullet()
{
  return { "Bullet", std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100),
           sweep({ { "10 iterations, as shipped", 10, 0, true },
                   { "10 iterations, threshold 0, split impulse, CCD", 10, 1, true },
                   { "40 iterations, threshold 0, split impulse, CCD", 40, 1, true } }),
           [](const Scene& scene, const Setting& setting) -> std::unique_ptr<Simulation> {
             return std::make_unique<Bullet>(scene, setting);
           },
           cannot };
}

}  // namespace block_world::speed
