#include "live_parameters.h"

namespace block_world
{
LiveParameters::LiveParameters(const ros::NodeHandle& handle, const BlockWorldConfig& values, const Change& change)
  : handle_(handle)
{
  remember();
  // The server begins with what it finds there, else with the defaults of the .cfg file.
  values.__toServer__(handle_);
  server_ = std::make_unique<dynamic_reconfigure::Server<BlockWorldConfig>>(mutex_, handle_);
  server_->updateConfig(values);
  server_->setCallback([change](BlockWorldConfig& asked, std::uint32_t) { change(asked); });
}

LiveParameters::~LiveParameters()
{
  server_.reset();
  for (const auto& [name, value] : before_)
    if (value)
      handle_.setParam(name, *value);
    else
      handle_.deleteParam(name);
}

void LiveParameters::remember()
{
  for (const auto& description : BlockWorldConfig::__getParamDescriptions__())
  {
    XmlRpc::XmlRpcValue value;
    const bool is_set = handle_.getParam(description->name, value);
    before_[description->name] = is_set ? std::make_unique<XmlRpc::XmlRpcValue>(value) : nullptr;
  }
}

void LiveParameters::update(const BlockWorldConfig& values)
{
  server_->updateConfig(values);
}

}  // namespace block_world
