#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Wrench.h>
#include <geometry_msgs/WrenchStamped.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <block_world/BodyStates.h>
#include <block_world/Contacts.h>
#include <block_world/DeleteBlock.h>
#include <block_world/Energy.h>
#include <block_world/Input.h>
#include <block_world/LoadScene.h>
#include <block_world/RestoreState.h>
#include <block_world/SaveState.h>
#include <block_world/SetState.h>
#include <block_world/SpawnBlock.h>
#include <block_world/SpringForce.h>
#include <block_world/Step.h>
#include <block_world/Thrust.h>

namespace block_world
{
/// The messages of this package, as msg::X.
namespace msg
{
using block_world::BodyState;
using block_world::Contact;
using block_world::Energy;
using block_world::BodyStates;
using block_world::Contacts;
using block_world::DeleteBlock;
using block_world::Input;
using block_world::LoadScene;
using block_world::RestoreState;
using block_world::SaveState;
using block_world::SetState;
using block_world::SpawnBlock;
using block_world::SpringForce;
using block_world::Step;
using block_world::Thrust;
}  // namespace msg
}  // namespace block_world
