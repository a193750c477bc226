#pragma once

// The parts of everything that a world consists of, for an Archive. Each structured binding has to name all parts of its type, so that one that
// is added later cannot be forgotten: it does not compile.

#include "archive.h"
#include "block_world/scene.h"
#include "detect.h"
#include "engine.h"

namespace block_world
{
template <class A>
void exchange(A& archive, Thruster& thruster)
{
  auto& [point, direction, strength] = thruster;
  archive(point, direction, strength);
}

template <class A>
void exchange(A& archive, Block& block)
{
  auto& [name, size, vertices, mass, fixed, position, angle, velocity, omega, elasticity, color, thrusters] = block;
  archive(name, size, vertices, mass, fixed, position, angle, velocity, omega, elasticity, color, thrusters);
}

template <class A>
void exchange(A& archive, ThrustCommand& command)
{
  auto& [body, levels, duration] = command;
  archive(body, levels, duration);
}

template <class A>
void exchange(A& archive, SpringCommand& command)
{
  auto& [active, body, attach, anchor, stiffness, damping, duration] = command;
  archive(active, body, attach, anchor, stiffness, damping, duration);
}

template <class A>
void exchange(A& archive, WrenchCommand& command)
{
  auto& [body, force, torque] = command;
  archive(body, force, torque);
}

template <class A>
void exchange(A& archive, SetCommand& command)
{
  auto& [gravity, elasticity, damping, thrust, mass] = command;
  archive(gravity, elasticity, damping, thrust, mass);
}

template <class A>
void exchange(A& archive, SetStateCommand& command)
{
  auto& [body, position, angle, velocity, omega] = command;
  archive(body, position, angle, velocity, omega);
}

template <class A>
void exchange(A& archive, SpawnCommand& command)
{
  auto& [block] = command;
  archive(block);
}

template <class A>
void exchange(A& archive, DeleteCommand& command)
{
  auto& [body] = command;
  archive(body);
}

template <class A>
void exchange(A&, ResetCommand&)
{
}

/// Its time counts from the start of the inputs and does not move with the origin of time.
template <class A>
void exchange(A& archive, TimedCommand& input)
{
  auto& [time, command] = input;
  archive.span(time);
  archive(command);
}

template <class A>
void exchange(A& archive, Walls& walls)
{
  auto& [left, right, bottom, top] = walls;
  archive(left, right, bottom, top);
}

template <class A>
void exchange(A& archive, Spring& spring)
{
  auto& [from_block, from_point, to_block, to_point, stiffness, rest_length, damping] = spring;
  archive(from_block, from_point, to_block, to_point, stiffness, rest_length, damping);
}

template <class A>
void exchange(A& archive, Scene& scene)
{
  auto& [name, gravity, elasticity, damping, ratio, tolerance, thrust, walls, blocks, springs, inputs] = scene;
  archive(name, gravity, elasticity, damping, ratio, tolerance, thrust, walls, blocks, springs, inputs);
}

template <class A>
void exchange(A& archive, Statistics& statistics)
{
  auto& [events, impacts, worst_overlap, mode, stalled] = statistics;
  archive(events, impacts, worst_overlap, mode, stalled);
}

template <class A>
void exchange(A& archive, Face& face)
{
  auto& [normal, offset, length] = face;
  archive(normal, offset, length);
}

template <class A>
void exchange(A& archive, Polygon& polygon)
{
  auto& [vertices, faces, radius, gyration] = polygon;
  archive(vertices, faces, radius, gyration);
}

template <class A>
void exchange(A& archive, Coefficients& coefficients)
{
  auto& [x, y, angle] = coefficients;
  archive(x, y, angle);
}

/// Each body's on its own; of those that are read, World::Engine::shareShapes makes one where they are alike.
template <class A>
void exchange(A& archive, std::shared_ptr<const Polygon>& shape)
{
  Polygon polygon = shape ? *shape : Polygon();
  archive(polygon);
  if (!shape)
    shape = std::make_shared<Polygon>(polygon);
}

template <class A>
void exchange(A& archive, Arc& arc)
{
  auto& [start, end, horizon, jerk, angular_jerk, degree, order] = arc;
  archive(start, end, horizon, jerk, angular_jerk, degree, order);
}

template <class A>
void exchange(A& archive, MouseSpring& mouse)
{
  auto& [active, attach, anchor, stiffness, damping, until] = mouse;
  archive(active, attach, anchor, stiffness, damping, until);
}

template <class A>
void exchange(A& archive, Cost::Part& part)
{
  auto& [count, units] = part;
  archive(count, units);
}

template <class A>
void exchange(A& archive, Cost& cost)
{
  auto& [parts] = cost;
  archive(parts);
}

template <class A>
void exchange(A& archive, Body& body)
{
  auto& [shape, fixed, island, first_pair, crowd, cost, arc, inverse_mass, inverse_inertia, push, twist, springs, elasticity, mouse, name, mass,
         inertia, crowd_start, crowd_cost, thrusters, levels, thrust_until, wrench_force, wrench_torque] = body;
  archive(shape, fixed, island, first_pair, crowd, cost, arc, inverse_mass, inverse_inertia, push, twist, springs, elasticity, mouse, name, mass,
          inertia, crowd_start, crowd_cost, thrusters, levels, thrust_until, wrench_force, wrench_torque);
}

template <class A>
void exchange(A& archive, SpringLink& link)
{
  auto& [first, second, first_point, second_point, stiffness, rest_length, damping] = link;
  archive(first, second, first_point, second_point, stiffness, rest_length, damping);
}

template <class A>
void exchange(A& archive, Field& field)
{
  auto& [gravity, damping, rotational_damping] = field;
  archive(gravity, damping, rotational_damping);
}

template <class A>
void exchange(A& archive, Pair& pair)
{
  auto& [a, b, next, previous, face_gap, face, resting, face_of_a, contact_due] = pair;
  archive(a, b, next, previous, face_gap, face, resting, face_of_a, contact_due);
}

template <class A>
void exchange(A& archive, Touch& touch)
{
  auto& [pair, a, b, vertex, face, corner, member_a, member_b, normal, arm, reach, gap, separation, along, elasticity, approach, impulse,
         capture, force, rested, active] = touch;
  archive(pair, a, b, vertex, face, corner, member_a, member_b, normal, arm, reach, gap, separation, along, elasticity, approach, impulse,
          capture, force, rested, active);
}

template <class A>
void exchange(A& archive, Rest& rest)
{
  auto& [touch, force, along, degree] = rest;
  archive(touch, force, along, degree);
}

template <class A>
void exchange(A& archive, Work& work)
{
  auto& [degree, series] = work;
  archive(degree, series);
}

template <class A>
void exchange(A& archive, Works& works)
{
  auto& [thrust, loss] = works;
  archive(thrust, loss);
}

template <class A>
void exchange(A& archive, Island& island)
{
  auto& [bodies, rests, works] = island;
  archive(bodies, rests, works);
}

}  // namespace block_world
