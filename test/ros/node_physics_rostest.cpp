// Physics as it arrives at the user's end: scenes and commands go in by files, topics and services, states come out by
// the step service. Expected values are closed forms.
//
// The engine puts the instant of contact where bodies are within the scene's tolerance, 1e-6 m, which shifts a state
// after an impact by about as much; velocities of flush and single contacts do not depend on that instant beyond the
// change of the lever arms.

#include <cmath>

#include "node_client.h"

namespace block_world
{
namespace
{
constexpr double POSITION = 5e-6;  // m, rad: a few tolerances of the scene
constexpr double VELOCITY = 5e-6;  // m/s, rad/s
constexpr double ROUNDING = 1e-12;

/// Moment of inertia of a rectangle about its centre of mass.
double inertia(double mass, double width, double height)
{
  return mass * (width * width + height * height) / 12.0;
}

struct Vector
{
  double x, y;
};

double cross(const Vector& a, const Vector& b)
{
  return a.x * b.y - a.y * b.x;
}

/// The corner of a turned rectangle that reaches farthest to the right, from its centre.
Vector rightmostCorner(double width, double height, double angle)
{
  Vector best = { -1e300, 0.0 };
  for (const double x : { -width / 2.0, width / 2.0 })
    for (const double y : { -height / 2.0, height / 2.0 })
    {
      const Vector corner = { std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y };
      if (corner.x > best.x)
        best = corner;
    }
  return best;
}

void checkHeadOn(const char* node, double elasticity)
{
  NodeClient client(node);
  const auto bodies = client.advance(5.0);
  ASSERT_EQ(bodies.size(), 2u);
  const double a = (1.0 - 3.0 * elasticity) / 4.0, b = (1.0 + elasticity) / 4.0;
  EXPECT_NEAR(bodies[0].vx, a, VELOCITY);
  EXPECT_NEAR(bodies[1].vx, b, VELOCITY);
  EXPECT_NEAR(bodies[0].x, 1.0 + 2.0 * a, POSITION);
  EXPECT_NEAR(bodies[1].x, 2.0 + 2.0 * b, POSITION);
  for (const auto& body : bodies)
  {
    EXPECT_NEAR(body.vy, 0.0, ROUNDING);
    EXPECT_NEAR(body.omega, 0.0, ROUNDING);
  }
}
}  // namespace

TEST(NodePhysics, headOnElastic)
{
  checkHeadOn("head_on_1", 1.0);
}

TEST(NodePhysics, headOnHalfElastic)
{
  checkHeadOn("head_on_05", 0.5);
}

TEST(NodePhysics, headOnPlastic)
{
  checkHeadOn("head_on_0", 0.0);
}

TEST(NodePhysics, cornerOnWall)
{
  // Impulse along the wall's normal n = (-1, 0): j = (1 + e) v / (1 / m + (r x n)^2 / I).
  const double mass = 2.0, e = 0.8, wall = 4.0;
  const Vector r = rightmostCorner(1.0, 3.0, 0.5), n = { -1.0, 0.0 };
  const double i = inertia(mass, 1.0, 3.0);
  const double impulse = (1.0 + e) / (1.0 / mass + cross(r, n) * cross(r, n) / i);
  const double hit = wall - r.x;

  NodeClient client("corner");
  const double after = 0.1;
  const auto bodies = client.advance(hit + after);
  ASSERT_EQ(bodies.size(), 1u);
  const double vx = 1.0 - impulse / mass, omega = impulse * cross(r, n) / i;
  EXPECT_NEAR(bodies[0].vx, vx, VELOCITY);
  EXPECT_NEAR(bodies[0].omega, omega, VELOCITY);
  EXPECT_NEAR(bodies[0].x, hit + after * vx, POSITION);
  EXPECT_NEAR(bodies[0].angle, 0.5 + after * omega, POSITION);
}

TEST(NodePhysics, offCentrePair)
{
  // j = -(1 + e) v_AB . n / (1/m_A + 1/m_B + (r_A x n)^2 / I_A + (r_B x n)^2 / I_B), n from B to A.
  const double e = 0.5, mass_a = 1.0, mass_b = 2.0;
  const Vector n = { -1.0, 0.0 };
  const Vector r_a = rightmostCorner(1.0, 1.0, 0.6), r_b = { -0.5, 0.7 + r_a.y };
  const double i_a = inertia(mass_a, 1.0, 1.0), i_b = inertia(mass_b, 1.0, 3.0);
  const double w_a = cross(r_a, n), w_b = cross(r_b, n);
  const double j = (1.0 + e) / (1.0 / mass_a + 1.0 / mass_b + w_a * w_a / i_a + w_b * w_b / i_b);
  const double hit = 1.5 - (-2.0 + r_a.x), after = 0.1;

  NodeClient client("pair");
  const auto bodies = client.advance(hit + after);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NEAR(bodies[0].vx, 1.0 - j / mass_a, VELOCITY);
  EXPECT_NEAR(bodies[1].vx, j / mass_b, VELOCITY);
  EXPECT_NEAR(bodies[0].omega, j * w_a / i_a, VELOCITY);
  EXPECT_NEAR(bodies[1].omega, -j * w_b / i_b, VELOCITY);
  EXPECT_NEAR(bodies[1].x, 2.0 + after * j / mass_b, POSITION);
  EXPECT_NEAR(bodies[1].angle, -after * j * w_b / i_b, POSITION);
  EXPECT_NEAR(bodies[0].vy, 0.0, ROUNDING);
}

TEST(NodePhysics, comesToRest)
{
  NodeClient client("drop");
  Listener<msg::Contacts> contacts(client.topic(topics::CONTACTS), 1000);
  Listener<msg::Energy> energies(client.topic(topics::ENERGY), 1000);
  ASSERT_TRUE(contacts.waitForPublisher() && energies.waitForPublisher());

  client.advance(2.0);
  // Messages are read in between: a minute's worth of them would not fit into the queues.
  ASSERT_TRUE(waitFor([&] { return !energies.messages.empty() && energies.messages.back().time == 2.0; }));
  const auto bodies = client.advance(58.0);
  EXPECT_NEAR(bodies[0].y, 0.125, POSITION);
  EXPECT_NEAR(bodies[0].angle, 0.0, ROUNDING);
  EXPECT_NEAR(bodies[0].vy, 0.0, ROUNDING);
  ASSERT_TRUE(waitFor([&] { return !energies.messages.empty() && energies.messages.back().time == 60.0; }));
  EXPECT_NEAR(energies.messages.back().translational, 0.0, ROUNDING);
  // It has lost the m g h of its fall, all of it by impacts.
  EXPECT_NEAR(energies.messages.back().impact_loss, 9.8 * 0.875, 1e-5);
  EXPECT_NEAR(energies.messages.back().balance_error, 0.0, 1e-9);

  // The floor carries its weight in the end.
  double force = 0.0;
  ASSERT_FALSE(contacts.messages.empty());
  for (const msg::Contact& contact : contacts.messages.back().contacts)
    if (contact.kind == msg::Contact::REST)
      force += contact.impulse * contact.ny;
  EXPECT_NEAR(force, 9.8, 1e-9);

  const double end = std::sqrt(2.0 * 0.875 / 9.8) * 1.5 / 0.5;
  double rest_begin = 0.0;
  for (const msg::Contacts& message : contacts.messages)
    for (const msg::Contact& contact : message.contacts)
      if (contact.kind == msg::Contact::REST_BEGIN)
        rest_begin = contact.time;
  // The engine takes the last bounces together, those no higher than a few tolerances: sqrt(8 h / g) each, some ms in
  // all.
  EXPECT_NEAR(rest_begin, end, 5e-3);
}

TEST(NodePhysics, thrustForOneSecond)
{
  NodeClient client("drive");
  msg::Step::Request request;
  request.duration = 2.0;
  request.thrust.resize(1);
  request.thrust[0].body = "block1";
  request.thrust[0].levels = { 0, 0, 1, 0, 0, 0 };  // 1.5 N along +y on the axis through the centre of mass
  request.thrust[0].duration = 1.0;
  const msg::Step::Response response = client.step(request);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.state.bodies[0].vy, 1.5, ROUNDING);
  EXPECT_NEAR(response.state.bodies[0].y, 0.75 + 1.5, ROUNDING);
  EXPECT_NEAR(response.state.bodies[0].omega, 0.0, ROUNDING);
  EXPECT_EQ(response.state.bodies[1].vx, 0.0);
}

TEST(NodePhysics, springPullsTheNearestBlock)
{
  NodeClient client("drive");
  client.reset();
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 1000);
  ASSERT_TRUE(inputs.waitForPublisher());

  msg::Step::Request request;
  request.duration = 0.5;
  request.spring.resize(1);
  request.spring[0].active = true;
  request.spring[0].anchor.x = 5.0;  // nearest: the middle of the right side of block2, at 3.5
  request.spring[0].stiffness = 3.0;
  const msg::Step::Response response = client.step(request);
  ASSERT_TRUE(response.success) << response.message;
  const double omega = std::sqrt(3.0);
  EXPECT_NEAR(response.state.bodies[1].x, 3.0 + 1.5 * (1.0 - std::cos(omega * 0.5)), 1e-9);
  EXPECT_NEAR(response.state.bodies[1].vx, 1.5 * omega * std::sin(omega * 0.5), 1e-9);
  EXPECT_EQ(response.state.bodies[0].vx, 0.0);

  // The log says what was picked.
  ASSERT_TRUE(waitFor([&] { return !inputs.messages.empty() && inputs.messages.back().kind == msg::Input::SPRING; }));
  EXPECT_EQ(inputs.messages.back().spring.body, "block2");
  EXPECT_NEAR(inputs.messages.back().spring.attach.x, 0.5, ROUNDING);

  // What gives no stiffness gets the node's, 3 N/m by default: moving the anchor along continues the same spring.
  request.duration = 0.0;
  request.spring[0].body = "block2";
  request.spring[0].attach.x = 0.5;
  request.spring[0].stiffness = 0.0;
  ASSERT_TRUE(client.step(request).success);
  ASSERT_TRUE(waitFor([&] { return inputs.messages.back().spring.body == "block2"; }));
  EXPECT_EQ(inputs.messages.back().spring.stiffness, 3.0);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_physics_rostest");
  return RUN_ALL_TESTS();
}
