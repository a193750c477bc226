#include "drive_tool.h"

#include <OGRE/OgrePlane.h>
#include <OGRE/OgreQuaternion.h>
#include <OGRE/OgreVector3.h>
#include <OGRE/OgreViewport.h>
#include <pluginlib/class_list_macros.hpp>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/geometry.h>
#include <rviz/properties/string_property.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/viewport_mouse_event.h>

#include <QKeyEvent>
#include <QPainter>
#include <QPixmap>

#include <algorithm>

#include "topics.h"

namespace block_world
{
namespace
{
constexpr int REFRESH_MS = 100;

const char* const HELP = "<b>Drag</b> pulls a block; while paused moves it, with Ctrl turns it. "
                         "<b>SDFE</b>, <b>JKLI</b> or arrows thrust, with Shift spin. "
                         "<b>Space</b> pauses, <b>R</b> resets, <b>N</b> steps.";
const char* const DRIVEN_BY[] = { "S, D, F and E drive it.", "J, K, L, I and the arrows drive it." };

/// A block on a spring.
QIcon makeIcon()
{
  QPixmap pixmap(32, 32);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(30, 30, 30), 2));
  painter.setBrush(QColor(255, 165, 0));
  painter.drawPolygon(QPolygon({ QPoint(3, 18), QPoint(13, 14), QPoint(18, 26), QPoint(8, 30) }));
  painter.setPen(QPen(QColor(230, 25, 150), 3));
  painter.drawLine(12, 19, 27, 4);
  return QIcon(pixmap);
}

}  // namespace

DriveTool::DriveTool() : drag_(world_), keys_([this] { sendThrust(); })
{
  world_.on_input = [this](const msg::Input& input) { drag_.onInput(input); };
  world_.on_answer = [this](const QString& text) { setStatus(text); };
  connect(&refresh_timer_, &QTimer::timeout, this, [this] { refresh(); });

  rviz::Property* properties = getPropertyContainer();
  world_name_ =
      new rviz::StringProperty("World", topics::NODE, "Name of the node that simulates the world.", properties);
  connect(world_name_, &rviz::Property::changed, this, [this] { connectWorld(); });
  for (int block : { 0, 1 })
  {
    block_names_[block] = new rviz::StringProperty(QString("Block %1").arg(block + 1),
                                                   QString("block%1").arg(block + 1), DRIVEN_BY[block], properties);
    sent_levels_[block] = keys_.levels(block);
  }
}

DriveTool::~DriveTool()
{
  releaseAll();
}

void DriveTool::onInitialize()
{
  setIcon(makeIcon());
  setCursor(Qt::CrossCursor);
  connectWorld();
}

void DriveTool::connectWorld()
{
  releaseAll();
  world_.connect(world_name_->getStdString());
}

void DriveTool::activate()
{
  panel_ = context_->getViewManager()->getRenderPanel();
  panel_->installEventFilter(this);
  refresh_timer_.start(REFRESH_MS);
  setStatus(HELP);
}

void DriveTool::deactivate()
{
  releaseAll();
  refresh_timer_.stop();
  if (panel_)
    panel_->removeEventFilter(this);
}

bool DriveTool::eventFilter(QObject*, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
      return onKey(*static_cast<QKeyEvent*>(event));
    case QEvent::FocusOut:
    case QEvent::WindowDeactivate:
    case QEvent::Hide:
      releaseAll();
      return false;
    default:
      return false;
  }
}

bool DriveTool::onKey(const QKeyEvent& event)
{
  if (keys_.handle(event))
    return true;
  if (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier))
    return false;
  if (event.key() != Qt::Key_Space && event.key() != Qt::Key_R && event.key() != Qt::Key_N)
    return false;
  if (event.type() == QEvent::KeyRelease || event.isAutoRepeat())
    return true;
  if (event.key() == Qt::Key_Space)
    world_.togglePause();
  else if (event.key() == Qt::Key_R)
    world_.reset();
  else
    world_.step();
  return true;
}

void DriveTool::sendThrust()
{
  for (int block : { 0, 1 })
    if (keys_.levels(block) != sent_levels_[block])
      sendThrust(block);
}

void DriveTool::sendThrust(int block)
{
  sent_levels_[block] = keys_.levels(block);
  world_.thrust(block_names_[block]->getStdString(), sent_levels_[block]);
}

void DriveTool::refresh()
{
  drag_.refresh();
  for (int block : { 0, 1 })
    if (std::any_of(sent_levels_[block].begin(), sent_levels_[block].end(), [](double level) { return level > 0.0; }))
      sendThrust(block);
}

void DriveTool::releaseAll()
{
  keys_.releaseAll();
  drag_.release();
}

int DriveTool::processMouseEvent(rviz::ViewportMouseEvent& event)
{
  const bool pressed = event.acting_button == Qt::LeftButton &&
                       (event.type == QEvent::MouseButtonPress || event.type == QEvent::MouseButtonDblClick);
  // The other buttons and the wheel move the view as with every other tool.
  if (drag_.isIdle() && !pressed)
  {
    if (!event.left() && event.panel->getViewController())
      event.panel->getViewController()->handleMouseEvent(event);
    setStatus(HELP);  // the view has told what its own buttons do
    return Render;
  }
  if (event.leftUp() || !event.left())
    drag_.release();
  else if (const auto point = pointUnder(event))
    pressed ? drag_.press(*point) : drag_.move(*point, event.alt() || event.control());
  return Render;
}

/// The point of the world's plane under the mouse.
std::optional<Eigen::Vector2d> DriveTool::pointUnder(rviz::ViewportMouseEvent& event) const
{
  // The plane stands where its frame is, which need not be the fixed one.
  Ogre::Vector3 origin = Ogre::Vector3::ZERO;
  Ogre::Quaternion turned = Ogre::Quaternion::IDENTITY;
  const std::string& frame = world_.bodies().header.frame_id;
  if (!frame.empty() && frame != context_->getFixedFrame().toStdString())
    context_->getFrameManager()->getTransform(frame, ros::Time(), origin, turned);

  // Qt's pixels need not be the screen's.
  const double scale = static_cast<double>(event.viewport->getActualWidth()) / std::max(event.panel->width(), 1);
  Ogre::Plane plane(turned * Ogre::Vector3::UNIT_Z, origin);
  Ogre::Vector3 point;
  if (!rviz::getPointOnPlaneFromWindowXY(event.viewport, plane, static_cast<int>(event.x * scale),
                                         static_cast<int>(event.y * scale), point))
    return std::nullopt;
  const Ogre::Vector3 local = turned.Inverse() * (point - origin);
  return Eigen::Vector2d(local.x, local.y);
}

}  // namespace block_world

PLUGINLIB_EXPORT_CLASS(block_world::DriveTool, rviz::Tool)
