#pragma once

#include <rviz/tool.h>

#include <QPointer>
#include <QTimer>

#include <optional>

#include "drag.h"
#include "drive_keys.h"
#include "world_client.h"

namespace rviz
{
class StringProperty;
class ViewportMouseEvent;
}  // namespace rviz

namespace block_world
{
/// Drives a block world from rviz: the mouse pulls blocks by a spring, or moves them while the world is paused; keys
/// fire thrusters for as long as they are held. Whatever takes the keyboard away releases everything.
class DriveTool : public rviz::Tool
{
public:
  DriveTool();
  ~DriveTool() override;

  void activate() override;
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

  /// Sees the keys of the render panel before rviz does, which would take some for shortcuts and passes no releases on.
  bool eventFilter(QObject* watched, QEvent* event) override;

protected:
  void onInitialize() override;

private:
  void connectWorld();
  std::optional<Eigen::Vector2d> pointUnder(rviz::ViewportMouseEvent& event) const;
  bool onKey(const QKeyEvent& event);
  void sendThrust();
  void sendThrust(int block);
  void refresh();
  void releaseAll();

  rviz::StringProperty* world_name_;
  rviz::StringProperty* block_names_[2];

  WorldClient world_;
  Drag drag_;
  DriveKeys keys_;
  std::vector<double> sent_levels_[2];
  QTimer refresh_timer_;
  QPointer<QObject> panel_;
};

}  // namespace block_world
