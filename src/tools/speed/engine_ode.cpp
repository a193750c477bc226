#include <ode/ode.h>

#include <cmath>

#include "engine.h"

namespace block_world::speed
{
namespace
{
/// ODE tells of each step that its solver fails at; the results show it.
void silence(int, const char*, va_list)
{
}

/// In the plane by Plane2D joints. Without iterations: the direct solver, dWorldStep; else dWorldQuickStep.
class Ode : public Simulation
{
public:
  Ode(const Scene& scene, const Setting& setting)
    : setting_(setting)
    , world_(dWorldCreate())
    , space_(dHashSpaceCreate(nullptr))
    , contacts_(dJointGroupCreate(0))
    , elasticity_(scene.elasticity)
  {
    dRandSetSeed(0);  // dWorldQuickStep shuffles the order of its rows
    dWorldSetGravity(world_, 0.0, -scene.gravity, 0.0);
    if (setting.iterations > 0)
      dWorldSetQuickStepNumIterations(world_, setting.iterations);
    if (setting.effort > 0)
      dWorldSetCFM(world_, 1e-12);  // shipped: 1e-10
    dWorldSetAutoDisableFlag(world_, setting.sleeping);
    // By time, as the others have it; shipped: after 10 steps, which in fine steps freezes what has just begun to fall.
    dWorldSetAutoDisableSteps(world_, 0);
    dWorldSetAutoDisableTime(world_, 0.5);
    dWorldSetLinearDampingThreshold(world_, 0.0);
    dWorldSetAngularDampingThreshold(world_, 0.0);
    for (const Block& block : scene.blocks)
      add(scene, block);
    for (const Spring& spring : scene.springs)
      add(scene, spring);
    addWalls(scene.walls);
  }

  ~Ode() override
  {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void nextFrame() override
  {
    const double step = stepSize();
    for (int i = 0; i < setting_.steps; ++i)
    {
      dSpaceCollide(space_, this, &Ode::collide);
      if (setting_.iterations > 0)
        dWorldQuickStep(world_, step);
      else
        dWorldStep(world_, step);
      dJointGroupEmpty(contacts_);
    }
  }

  MotionState state(int block) const override
  {
    const dGeomID geom = geoms_[block];
    const dReal *position = dGeomGetPosition(geom), *rotation = dGeomGetRotation(geom);
    MotionState state;
    state.position = { position[0], position[1] };
    state.angle = std::atan2(rotation[4], rotation[0]);
    if (const dBodyID body = dGeomGetBody(geom))
    {
      const dReal* velocity = dBodyGetLinearVel(body);
      state.velocity = { velocity[0], velocity[1] };
      state.omega = dBodyGetAngularVel(body)[2];
    }
    return state;
  }

private:
  double stepSize() const
  {
    return 1.0 / (frame_rate * setting_.steps);
  }

  void add(const Scene& scene, const Block& block)
  {
    const dGeomID geom = dCreateBox(space_, block.size->x(), block.size->y(), 1.0);
    geoms_.push_back(geom);
    if (!block.fixed)
      dGeomSetBody(geom, makeBody(scene, block));
    dGeomSetPosition(geom, block.position.x(), block.position.y(), 0.0);
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, block.angle);
    dGeomSetRotation(geom, rotation);
  }

  dBodyID makeBody(const Scene& scene, const Block& block)
  {
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    const double turn = inertia(block);
    dMassSetParameters(&mass, block.mass, 0.0, 0.0, 0.0, turn, turn, turn, 0.0, 0.0, 0.0);
    dBodySetMass(body, &mass);
    dBodySetLinearVel(body, block.velocity.x(), block.velocity.y(), 0.0);
    dBodySetAngularVel(body, 0.0, 0.0, block.omega);
    // The scale acts once a step.
    const DampingRates rates = dampingRates(scene, block);
    dBodySetLinearDamping(body, -std::expm1(-rates.linear * stepSize()));
    dBodySetAngularDamping(body, -std::expm1(-rates.angular * stepSize()));
    dJointAttach(dJointCreatePlane2D(world_, nullptr), body, nullptr);
    return body;
  }

  /// A joint that keeps a distance, made a spring by the manual's formulas for ERP and CFM.
  void add(const Scene& scene, const Spring& spring)
  {
    const dBodyID from = dGeomGetBody(geoms_[indexOf(scene, spring.from_block)]);
    const int to = indexOf(scene, spring.to_block);
    const dJointID joint = dJointCreateDBall(world_, nullptr);
    dJointAttach(joint, from, to < 0 ? nullptr : dGeomGetBody(geoms_[to]));
    dVector3 point = { spring.to_point.x(), spring.to_point.y(), 0.0, 0.0 };
    if (to >= 0)
      dBodyGetRelPointPos(dGeomGetBody(geoms_[to]), point[0], point[1], 0.0, point);
    dJointSetDBallAnchor2(joint, point[0], point[1], 0.0);
    dBodyGetRelPointPos(from, spring.from_point.x(), spring.from_point.y(), 0.0, point);
    dJointSetDBallAnchor1(joint, point[0], point[1], 0.0);
    dJointSetDBallDistance(joint, spring.rest_length);
    const double push = stepSize() * spring.stiffness, sum = push + spring.damping;
    dJointSetDBallParam(joint, dParamERP, push / sum);
    dJointSetDBallParam(joint, dParamCFM, 1.0 / sum);
  }

  void addWalls(const Walls& walls)
  {
    if (walls.left)
      dCreatePlane(space_, 1.0, 0.0, 0.0, *walls.left);
    if (walls.right)
      dCreatePlane(space_, -1.0, 0.0, 0.0, -*walls.right);
    if (walls.bottom)
      dCreatePlane(space_, 0.0, 1.0, 0.0, *walls.bottom);
    if (walls.top)
      dCreatePlane(space_, 0.0, -1.0, 0.0, -*walls.top);
  }

  static void collide(void* self, dGeomID a, dGeomID b)
  {
    static_cast<Ode*>(self)->collide(a, b);
  }

  void collide(dGeomID a, dGeomID b)
  {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (!body_a && !body_b)
      return;
    constexpr int most = 8;
    dContact contacts[most];
    const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i)
    {
      contacts[i].surface.mode = dContactBounce;
      contacts[i].surface.mu = 0.0;
      contacts[i].surface.bounce = elasticity_;
      contacts[i].surface.bounce_vel = 0.0;
      dJointAttach(dJointCreateContact(world_, contacts_, &contacts[i]), body_a, body_b);
    }
  }

  Setting setting_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  double elasticity_;
  std::vector<dGeomID> geoms_;
};

std::string cannot(const Scene& scene)
{
  for (const Spring& spring : scene.springs)
    if (spring.rest_length <= 0.0)
      return "no spring without a rest length";
  return std::string();
}

std::unique_ptr<Simulation> build(const Scene& scene, const Setting& setting)
{
  static const bool once = [] {
    dInitODE();
    dSetMessageHandler(silence);
    return true;
  }();
  return once ? std::make_unique<Ode>(scene, setting) : nullptr;
}

}  // namespace

Engine ode()
{
  return { "ODE", BLOCK_WORLD_ODE_VERSION,
           sweep({ { "20 iterations, as shipped", 20, 0, false },
                   { "20 iterations, sleeping", 20, 0, true, false },
                   { "direct, as shipped", 0, 0, false },
                   { "direct, CFM 1e-12, sleeping", 0, 1, true },
                   { "80 iterations, CFM 1e-12, sleeping", 80, 1, true } }),
           build, cannot };
}

}  // namespace block_world::speed
