#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "body.h"
#include "contact_group.h"
#include "random.h"
#include "touch.h"

namespace block_world
{
const double pi = std::acos(-1.0);

inline std::vector<Vec2> rectangle(double width, double height)
{
  const double x = width / 2.0, y = height / 2.0;
  return { Vec2(-x, -y), Vec2(x, -y), Vec2(x, y), Vec2(-x, y) };
}

/// Corners on a circle, a regular polygon pushed out of shape, about its centre of mass.
inline std::vector<Vec2> roundish(Random& random, int corners, double radius)
{
  std::vector<Vec2> vertices;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * pi * (i + random.in(-0.3, 0.3)) / corners;
    vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  const Vec2 centroid = areaMoments(vertices).centroid;
  for (Vec2& p : vertices)
    p -= centroid;
  return vertices;
}

/// A parabola from time zero on.
inline void launch(Body& body, const Vec2& position, double angle = 0.0, const Vec2& velocity = Vec2::Zero(),
                   double omega = 0.0, const Vec2& acceleration = Vec2::Zero(), double alpha = 0.0)
{
  body.arc = Arc();
  body.arc.degree = 2;
  body.arc.order[0] = { position.x(), position.y(), angle };
  body.arc.order[1] = { velocity.x(), velocity.y(), omega };
  body.arc.order[2] = { acceleration.x() / 2.0, acceleration.y() / 2.0, alpha / 2.0 };
}

inline Body block(const std::vector<Vec2>& vertices, double mass, double elasticity = 1.0)
{
  Body body;
  body.shape = std::make_shared<Polygon>(makePolygon(vertices));
  body.fixed = false;
  body.mass = mass;
  body.inertia = mass * body.shape->gyration;
  body.inverse_mass = 1.0 / mass;
  body.inverse_inertia = 1.0 / body.inertia;
  body.elasticity = elasticity;
  return body;
}

/// The half-plane normal.p <= offset.
inline Body wall(const Vec2& normal, double offset, double elasticity = 1.0)
{
  Body body;
  body.shape = std::make_shared<Polygon>(makeHalfPlane(normal, offset));
  body.elasticity = elasticity;
  return body;
}

/// A body at an instant, as a member of a contact group.
inline Member memberAt(const Body& body, int index, const Time& time = Time())
{
  const Snapshot now = body.at(time);
  Member m;
  m.body = index;
  m.frame = Frame(now.position, now.angle);
  m.angle = now.angle;
  m.velocity = now.velocity;
  m.omega = now.omega;
  m.acceleration = now.acceleration;
  m.alpha = now.alpha;
  m.inverse_mass = body.inverse_mass;
  m.inverse_inertia = body.inverse_inertia;
  return m;
}

/// All bodies with all their touches at time zero; members in the order of the bodies.
inline ContactGroup groupOf(const std::vector<Body>& bodies, double tolerance = 1e-6)
{
  ContactGroup group;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    group.members.push_back(memberAt(bodies[i], static_cast<int>(i)));
  TouchFinder finder;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (!bodies[i].fixed || !bodies[j].fixed)
      {
        const std::size_t before = group.touches.size();
        finder.find(bodies[i], group.members[i], bodies[j], group.members[j], tolerance, group.touches, 1e-13, 0.0, true);
        for (std::size_t t = before; t < group.touches.size(); ++t)
          group.touches[t].pair = static_cast<int>(i * bodies.size() + j);
      }
  for (Touch& touch : group.touches)
  {
    touch.member_a = touch.a;
    touch.member_b = touch.b;
  }
  group.prepare();
  return group;
}

inline double kineticEnergy(const std::vector<Member>& members)
{
  double energy = 0.0;
  for (const Member& m : members)
    if (m.inverse_mass > 0.0)
      energy += 0.5 * m.velocity.squaredNorm() / m.inverse_mass + 0.5 * m.omega * m.omega / m.inverse_inertia;
  return energy;
}

inline void expectNear(const Vec2& actual, const Vec2& expected, double error)
{
  EXPECT_NEAR(actual.x(), expected.x(), error);
  EXPECT_NEAR(actual.y(), expected.y(), error);
}

}  // namespace block_world
