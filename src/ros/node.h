#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "block_world/world.h"
#include "diagnostics.h"
#include "live_parameters.h"
#include "messages.h"
#include "pacing.h"
#include "parameters.h"
#include "publishers.h"
#include "time_base.h"
#include "warnings.h"

namespace block_world
{
/// The block world as a ROS node. One thread owns the world: callbacks of topics only queue, and a command acts at the
/// simulated time at which the loop takes it.
class Node
{
public:
  Node(const ros::NodeHandle& handle, const Parameters& parameters, const SceneSource& source, Scene scene);

  /// Runs until ROS shuts down or end() was called.
  void run();

  /// May be called by a signal handler.
  static void end();

private:
  struct Pending
  {
    const char* topic;
    Command command;
  };

  // node.cpp: time
  static bool isEnding();
  bool start();
  ros::WallDuration patience() const;
  void catchUp();
  void advance(std::int64_t target, std::int64_t deadline);
  void advanceWorld(std::int64_t goal, std::int64_t deadline);
  bool isSettled() const;
  void setPaused(bool paused);
  void setRealTimeFactor(double factor);
  void publishState();
  void publishDue();
  void publishDiagnostics(std::int64_t now);
  void tellNotes();
  void closeBag();

  // node_commands.cpp: topics and services
  void subscribe();
  void onThrust(const msg::Thrust::ConstPtr& message);
  void onSpring(const msg::SpringForce::ConstPtr& message);
  void onWrench(const geometry_msgs::WrenchStamped::ConstPtr& message);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool onStep(msg::Step::Request& request, msg::Step::Response& response);
  std::vector<Pending> commandsOf(const msg::Step::Request& request) const;
  void applyPending();
  std::string applyAll(const std::vector<Pending>& commands);
  std::string apply(const Command& command);
  void logSceneInputs();

  // node_scene.cpp: services that change the scene, and live parameters
  void serveScene();
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onLoadScene(msg::LoadScene::Request& request, msg::LoadScene::Response& response);
  bool onSetState(msg::SetState::Request& request, msg::SetState::Response& response);
  bool onSpawnBlock(msg::SpawnBlock::Request& request, msg::SpawnBlock::Response& response);
  bool onSaveState(msg::SaveState::Request& request, msg::SaveState::Response& response);
  bool onRestoreState(msg::RestoreState::Request& request, msg::RestoreState::Response& response);
  bool onDeleteBlock(msg::DeleteBlock::Request& request, msg::DeleteBlock::Response& response);
  std::string makeReady();
  std::string applyNow(const Command& command);
  void exchangeWorld(World world);
  std::string replaceWorld(const SceneSource& source, const std::optional<int>& count, const SetCommand& set);
  void showNewWorld();
  std::string restore(const std::string& path);
  template <class Response>
  bool answer(const char* done, const std::string& reason, Response& response) const;
  BlockWorldConfig liveValues() const;
  void shareLiveValues();
  void onLiveChange(BlockWorldConfig& values);
  std::string changeWorld(const BlockWorldConfig& now, const BlockWorldConfig& asked);
  std::string changeNode(const BlockWorldConfig& asked);

  ros::NodeHandle handle_;
  ros::CallbackQueue callbacks_;
  Parameters parameters_;
  SceneSource source_;
  World world_;
  TimeBase time_;
  std::unique_ptr<BagWriter> bag_;
  Publishers publishers_;
  Warnings warnings_;
  Pacer pacer_;
  Schedule schedule_;
  Diagnostics diagnostics_;
  std::unique_ptr<LiveParameters> live_;

  std::int64_t now_ns_ = 0;  ///< the world's time; behind it only while the engine is between two whole ns
  bool paused_;
  double lost_ = 0.0;  ///< s that simulated time has fallen behind for good
  std::int64_t state_ns_ = 0, state_sent_ = 0, overlay_sent_ = 0;
  bool overlay_changed_ = true;
  bool blocks_changed_ = false;  ///< some were spawned or deleted since the scene was loaded
  std::size_t notes_told_ = 0;
  bool bag_failed_ = false;
  std::vector<Pending> pending_;

  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace block_world
