#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <string>

#include "block_world/command.h"
#include "block_world/world.h"
#include "messages.h"

// Between the engine's types and messages. Pure functions: same in, same out.
namespace block_world
{
ThrustCommand toCommand(const msg::Thrust& message);
/// Stiffness and damping of a command that gives none (both 0) are the defaults; a stiffness of 0 is the default alone
/// where a damping is given.
SpringCommand toCommand(const msg::SpringForce& message, double default_stiffness, double default_damping);
/// What of the wrench lies out of the plane is left out.
WrenchCommand toCommand(const geometry_msgs::Wrench& message, const std::string& body);

SetStateCommand toCommand(const msg::BodyState& message);

/// A command as logged; not for LOAD_SCENE and RESTORE, which replace the world. Throws std::runtime_error.
Command toCommand(const msg::Input& input);

/// Name of the block whose TF frame this is, given with or without the prefix and with or without a leading slash; the
/// frame without prefix where no block fits.
std::string bodyOfFrame(const World& world, const std::string& frame, const std::string& prefix);

msg::Thrust toMessage(const ThrustCommand& command);
msg::SpringForce toMessage(const SpringCommand& command);
geometry_msgs::Wrench toMessage(const WrenchCommand& command);
/// Kind and payload; header, time and index are the caller's.
msg::Input toInput(const Command& command);

msg::BodyState toMessage(const std::string& name, const MotionState& state);
/// All but the header.
msg::BodyStates bodyStates(const World& world);
msg::Energy energy(const World& world);
msg::Contact toMessage(const World& world, const ContactEvent& contact);

/// Without header.
geometry_msgs::Transform toTransform(const MotionState& state);
geometry_msgs::Point toPoint(const Eigen::Vector2d& point, double z = 0.0);

/// Simulated time of a message, origin + simulated; 1 ns where that is 0, which means "no time" in ROS.
ros::Time stamp(std::int64_t origin_ns, std::int64_t simulated_ns);

}  // namespace block_world
