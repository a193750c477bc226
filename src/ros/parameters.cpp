#include "parameters.h"

#include <ros/package.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "block_world/scene_yaml.h"

namespace block_world
{
namespace
{
constexpr double INFINITE = std::numeric_limits<double>::infinity();

const char* typeName(const XmlRpc::XmlRpcValue& value)
{
  switch (value.getType())
  {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return "a boolean";
    case XmlRpc::XmlRpcValue::TypeInt:
      return "a whole number";
    case XmlRpc::XmlRpcValue::TypeDouble:
      return "a number";
    case XmlRpc::XmlRpcValue::TypeString:
      return "a text";
    case XmlRpc::XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpc::XmlRpcValue::TypeStruct:
      return "a group of parameters";
    default:
      return "of another type";
  }
}

/// Reads single values; NodeHandle::param would pass over a wrong type in silence.
class Reader
{
public:
  explicit Reader(const ros::NodeHandle& handle) : handle_(handle)
  {
  }

  std::optional<XmlRpc::XmlRpcValue> raw(const std::string& name) const
  {
    XmlRpc::XmlRpcValue value;
    if (!handle_.getParam(name, value))
      return std::nullopt;
    return value;
  }

  [[noreturn]] void refuse(const std::string& name, const std::string& reason) const
  {
    throw ParameterError("parameter " + handle_.resolveName(name) + ": " + reason);
  }

  [[noreturn]] void refuseType(const std::string& name, const char* wanted, const XmlRpc::XmlRpcValue& value) const
  {
    refuse(name, std::string("must be ") + wanted + ", is " + typeName(value));
  }

  void read(const std::string& name, std::string& target) const
  {
    auto value = raw(name);
    if (!value)
      return;
    if (value->getType() != XmlRpc::XmlRpcValue::TypeString)
      refuseType(name, "a text", *value);
    target = static_cast<std::string&>(*value);
  }

  void read(const std::string& name, bool& target) const
  {
    auto value = raw(name);
    if (!value)
      return;
    if (value->getType() != XmlRpc::XmlRpcValue::TypeBoolean)
      refuseType(name, "true or false", *value);
    target = static_cast<bool&>(*value);
  }

  void read(const std::string& name, std::optional<int>& target, int least) const
  {
    auto value = raw(name);
    if (!value)
      return;
    if (value->getType() != XmlRpc::XmlRpcValue::TypeInt)
      refuseType(name, "a whole number", *value);
    if (static_cast<int&>(*value) < least)
      refuse(name, "must be at least " + std::to_string(least));
    target = static_cast<int&>(*value);
  }

  /// least_allowed says whether the number may be the least itself.
  template <class Target>
  void read(const std::string& name, Target& target, double least, bool least_allowed, double most = INFINITE) const
  {
    auto value = raw(name);
    if (!value)
      return;
    double number = 0.0;
    if (value->getType() == XmlRpc::XmlRpcValue::TypeInt)
      number = static_cast<int&>(*value);
    else if (value->getType() == XmlRpc::XmlRpcValue::TypeDouble)
      number = static_cast<double&>(*value);
    else
      refuseType(name, "a number", *value);
    if (!std::isfinite(number) || number < least || number > most || (number == least && !least_allowed))
    {
      std::ostringstream reason;
      reason << "must be finite and " << (least_allowed ? ">= " : "> ") << least;
      if (most < INFINITE)
        reason << " and <= " << most;
      reason << ", is " << number;
      refuse(name, reason.str());
    }
    target = number;
  }

private:
  const ros::NodeHandle& handle_;
};

std::string defaultScene()
{
  return ros::package::getPath("block_world") + "/config/scenes/six_blocks.yaml";
}

}  // namespace

Parameters readParameters(const ros::NodeHandle& handle)
{
  const Reader reader(handle);
  Parameters parameters;
  reader.read("scene", parameters.scene);
  reader.read("gravity", parameters.set.gravity, 0.0, true);
  reader.read("elasticity", parameters.set.elasticity, 0.0, true, 1.0);
  reader.read("damping", parameters.set.damping, 0.0, true);
  reader.read("thrust", parameters.set.thrust, 0.0, true);
  reader.read("mass", parameters.set.mass, 0.0, false);
  reader.read("tolerance", parameters.tolerance, 0.0, false);
  reader.read("count", parameters.count, 1);
  reader.read("mouse_stiffness", parameters.mouse_stiffness, 0.0, true);
  reader.read("mouse_damping", parameters.mouse_damping, 0.0, true);
  reader.read("real_time_factor", parameters.real_time_factor, 0.0, true, 1e6);
  reader.read("publish_rate", parameters.publish_rate, 0.0, false, 1e4);
  reader.read("paused", parameters.paused);
  reader.read("publish_clock", parameters.publish_clock);
  reader.read("frame_id", parameters.frame_id);
  reader.read("tf_prefix", parameters.tf_prefix);
  reader.read("record", parameters.record);

  if (parameters.scene.empty())
    parameters.scene = defaultScene();
  if (parameters.frame_id.empty() || parameters.frame_id[0] == '/')
    reader.refuse("frame_id", "must not be empty nor begin with a slash (tf2 refuses it)");
  if (!parameters.tf_prefix.empty() && parameters.tf_prefix[0] == '/')
    reader.refuse("tf_prefix", "must not begin with a slash (tf2 refuses it)");
  return parameters;
}

std::vector<std::string> unknownParameters(const ros::NodeHandle& handle)
{
  static const std::set<std::string> KNOWN = { "scene",           "gravity",       "elasticity",       "damping",
                                               "thrust",          "mass",          "tolerance",        "count",
                                               "mouse_stiffness", "mouse_damping", "real_time_factor", "publish_rate",
                                               "paused",          "publish_clock", "frame_id",         "tf_prefix",
                                               "record" };
  std::vector<std::string> names, unknown;
  handle.getParamNames(names);
  const std::string own = handle.getNamespace() + "/";
  for (const std::string& name : names)
    if (name.compare(0, own.size(), own) == 0 && KNOWN.count(name.substr(own.size())) == 0)
      unknown.push_back(name);
  return unknown;
}

SceneSource readSource(const Parameters& parameters)
{
  return { parameters.scene, readSceneFile(parameters.scene), parameters.tolerance };
}

Scene buildScene(const SceneSource& source, const std::optional<int>& count, const SetCommand& set)
{
  Scene scene = loadSceneText(source.text, source.name, { count, source.tolerance });
  scene.gravity = set.gravity.value_or(scene.gravity);
  scene.elasticity = set.elasticity.value_or(scene.elasticity);
  scene.damping = set.damping.value_or(scene.damping);
  scene.thrust = set.thrust.value_or(scene.thrust);
  if (set.mass)
  {
    if (scene.blocks.empty() || scene.blocks.front().fixed)
      throw ParameterError("parameter mass: the first block of " + source.name + " is none that can move");
    scene.blocks.front().mass = *set.mass;
  }
  return scene;
}

}  // namespace block_world
