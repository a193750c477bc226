#include "markers.h"

#include <algorithm>
#include <cmath>

#include "conversions.h"

namespace block_world
{
namespace
{
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;
using Point = Eigen::Vector2d;

// Heights above the plane order what is drawn on what when seen from above.
constexpr double WALL_Z = -0.02, BLOCK_Z = 0.0, OUTLINE_Z = 0.01, NAME_Z = 0.02, OVERLAY_Z = 0.03;
// s of simulated time for which an impulse is shown, and the most of them at once.
constexpr double IMPULSE_SHOWN = 0.15;
constexpr std::size_t MOST_IMPULSES = 500;

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha = 1.0)
{
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(red);
  color.g = static_cast<float>(green);
  color.b = static_cast<float>(blue);
  color.a = static_cast<float>(alpha);
  return color;
}

Marker makeMarker(const std::string& frame_id, const std::string& kind, int id, int type)
{
  Marker marker;
  marker.header.frame_id = frame_id;
  marker.ns = kind;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.a = 1.0f;  // rviz multiplies the alpha of single colours by this one
  return marker;
}

/// Extent of blocks and walls together.
struct Extent
{
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = Eigen::Vector2d::Constant(-1e300);

  void add(const Eigen::Vector2d& point)
  {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

Extent extentOf(const World& world)
{
  Extent extent;
  extent.add(Eigen::Vector2d::Zero());
  for (int body = 0; body < world.bodyCount(); ++body)
  {
    const MotionState state = world.state(body);
    for (const Eigen::Vector2d& vertex : world.block(body).vertices)
    {
      extent.add(state.position + Eigen::Vector2d::Constant(vertex.norm()));
      extent.add(state.position - Eigen::Vector2d::Constant(vertex.norm()));
    }
  }
  return extent;
}

/// A wall as a bar whose inner side lies on the half-plane's edge.
Marker wallMarker(const std::string& frame_id, int id, const Eigen::Vector2d& low, const Eigen::Vector2d& high)
{
  Marker marker = makeMarker(frame_id, "walls", id, Marker::CUBE);
  marker.pose.position = toPoint((low + high) / 2.0, WALL_Z);
  marker.scale.x = high.x() - low.x();
  marker.scale.y = high.y() - low.y();
  marker.scale.z = 0.001;
  marker.color = color(.45, .45, .5);
  return marker;
}

void addWalls(MarkerArray& array, const World& world, const std::string& frame_id)
{
  const Walls& walls = world.scene().walls;
  Extent extent = extentOf(world);
  // Walls end at their neighbours; where there is none, a little beyond everything else.
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.1 * (extent.high - extent.low).maxCoeff());
  const double left = walls.left.value_or(extent.low.x() - margin.x());
  const double right = walls.right.value_or(extent.high.x() + margin.x());
  const double bottom = walls.bottom.value_or(extent.low.y() - margin.y());
  const double top = walls.top.value_or(extent.high.y() + margin.y());
  const double thick = 0.02 * std::max(right - left, top - bottom);

  if (walls.left)
    array.markers.push_back(wallMarker(frame_id, 0, Point(left - thick, bottom), Point(left, top)));
  if (walls.right)
    array.markers.push_back(wallMarker(frame_id, 1, Point(right, bottom), Point(right + thick, top)));
  if (walls.bottom)
    array.markers.push_back(wallMarker(frame_id, 2, Point(left - thick, bottom - thick), Point(right + thick, bottom)));
  if (walls.top)
    array.markers.push_back(wallMarker(frame_id, 3, Point(left - thick, top), Point(right + thick, top + thick)));
}

void addBlock(MarkerArray& array, const Block& block, int id, const std::string& frame)
{
  Marker face = makeMarker(frame, "blocks", id, Marker::TRIANGLE_LIST);
  face.frame_locked = true;
  face.color = color(block.color[0], block.color[1], block.color[2]);
  for (std::size_t i = 1; i + 1 < block.vertices.size(); ++i)
    for (const std::size_t corner : { std::size_t(0), i, i + 1 })
      face.points.push_back(toPoint(block.vertices[corner], BLOCK_Z));
  array.markers.push_back(face);

  double radius = 0.0;
  Marker outline = makeMarker(frame, "outlines", id, Marker::LINE_STRIP);
  outline.frame_locked = true;
  for (std::size_t i = 0; i <= block.vertices.size(); ++i)
  {
    outline.points.push_back(toPoint(block.vertices[i % block.vertices.size()], OUTLINE_Z));
    radius = std::max(radius, block.vertices[i % block.vertices.size()].norm());
  }
  outline.scale.x = 0.03 * radius;
  outline.color = color(.1, .1, .1);
  array.markers.push_back(outline);

  Marker name = makeMarker(frame, "names", id, Marker::TEXT_VIEW_FACING);
  name.frame_locked = true;
  name.pose.position.z = NAME_Z;
  name.scale.z = 0.25 * radius;
  name.color = color(.1, .1, .1);
  name.text = block.name;
  array.markers.push_back(name);
}

Eigen::Vector2d turned(const Eigen::Vector2d& vector, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return Eigen::Vector2d(c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y());
}

void addLine(Marker& marker, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  marker.points.push_back(toPoint(from, OVERLAY_Z));
  marker.points.push_back(toPoint(to, OVERLAY_Z));
}

/// A line with a head, as three lines.
void addArrow(Marker& marker, const Eigen::Vector2d& from, const Eigen::Vector2d& arrow)
{
  const Eigen::Vector2d to = from + arrow;
  addLine(marker, from, to);
  addLine(marker, to, to - turned(0.3 * arrow, 0.4));
  addLine(marker, to, to - turned(0.3 * arrow, -0.4));
}

/// rviz complains about a list without points.
void deleteIfEmpty(Marker& marker)
{
  if (marker.points.empty())
    marker.action = Marker::DELETE;
}

}  // namespace

MarkerArray sceneMarkers(const World& world, const std::string& frame_id, const std::string& tf_prefix)
{
  MarkerArray array;
  Marker clear;
  clear.header.frame_id = frame_id;
  clear.action = Marker::DELETEALL;
  array.markers.push_back(clear);
  addWalls(array, world, frame_id);
  for (int body = 0; body < world.bodyCount(); ++body)
    addBlock(array, world.block(body), body, tf_prefix + world.name(body));
  return array;
}

Overlay::Overlay(const World& world)
{
  double mass = 0.0, size = 0.0;
  int movable = 0;
  for (int body = 0; body < world.bodyCount(); ++body)
  {
    if (world.isFixed(body))
      continue;
    double radius = 0.0;
    for (const Eigen::Vector2d& vertex : world.block(body).vertices)
      radius = std::max(radius, vertex.norm());
    size += radius;
    mass += world.block(body).mass;
    ++movable;
  }
  size_ = movable > 0 ? size / movable : 1.0;
  // The weight of a block, or its thrust where there is little gravity, draws half a block; an impulse that gives a
  // block 1 m/s the same.
  const double mean_mass = movable > 0 ? mass / movable : 1.0;
  metre_per_n_ = 0.5 * size_ / std::max({ mean_mass * world.scene().gravity, world.scene().thrust, 1e-9 });
  metre_per_ns_ = 0.5 * size_ / std::max(mean_mass, 1e-9);
}

void Overlay::remember(const std::vector<ContactEvent>& contacts)
{
  for (const ContactEvent& contact : contacts)
    if (contact.kind == ContactKind::Impact)
      impacts_.push_back(contact);
  while (impacts_.size() > MOST_IMPULSES)
    impacts_.pop_front();
}

void Overlay::forgetImpulses()
{
  impacts_.clear();
}

MarkerArray Overlay::markers(const World& world, const std_msgs::Header& header)
{
  MarkerArray array;
  array.markers = { springs(world), flames(world), forces(world), impulses(world) };
  for (Marker& marker : array.markers)
  {
    marker.header = header;
    deleteIfEmpty(marker);
  }
  return array;
}

Marker Overlay::springs(const World& world) const
{
  Marker marker = makeMarker("", "springs", 0, Marker::LINE_LIST);
  marker.scale.x = 0.04 * size_;
  for (const SpringState& spring : world.springs())
  {
    addLine(marker, spring.from, spring.to);
    marker.colors.insert(marker.colors.end(), 2, spring.mouse ? color(.9, .1, .6) : color(.1, .5, .2));
  }
  return marker;
}

Marker Overlay::flames(const World& world) const
{
  Marker marker = makeMarker("", "flames", 0, Marker::TRIANGLE_LIST);
  for (int body = 0; body < world.bodyCount(); ++body)
  {
    const std::vector<double> levels = world.thrustLevels(body);
    const MotionState state = world.state(body);
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      const Thruster& thruster = world.thrusters(body)[i];
      if (levels[i] <= 0.0)
        continue;
      // A flame points against the force.
      const Eigen::Vector2d root = state.position + turned(thruster.point, state.angle);
      const Eigen::Vector2d along = -turned(thruster.direction, state.angle);
      const Eigen::Vector2d across = 0.14 * size_ * Eigen::Vector2d(-along.y(), along.x());
      const double length = 0.3 * size_ + levels[i] * thruster.strength * metre_per_n_;
      for (const Eigen::Vector2d& corner : { Point(root - across), Point(root + length * along), Point(root + across) })
        marker.points.push_back(toPoint(corner, OVERLAY_Z));
      marker.colors.push_back(color(1., .8, .1));
      marker.colors.push_back(color(1., .2, 0.));
      marker.colors.push_back(color(1., .8, .1));
    }
  }
  return marker;
}

Marker Overlay::forces(const World& world) const
{
  Marker marker = makeMarker("", "contact_forces", 0, Marker::LINE_LIST);
  marker.scale.x = 0.045 * size_;
  marker.color = color(.8, 0., 0.);
  for (const ContactEvent& contact : world.restingContacts())
    if (contact.impulse > 0.0)
      addArrow(marker, contact.point, contact.impulse * metre_per_n_ * contact.normal);
  return marker;
}

Marker Overlay::impulses(const World& world)
{
  while (!impacts_.empty() && world.now() - impacts_.front().time > IMPULSE_SHOWN)
    impacts_.pop_front();

  Marker marker = makeMarker("", "impulses", 0, Marker::LINE_LIST);
  marker.scale.x = 0.05 * size_;
  for (const ContactEvent& contact : impacts_)
  {
    const double age = world.now() - contact.time;
    // Hard hits would draw across the whole view.
    const double length = std::min(contact.impulse * metre_per_ns_, 2.0 * size_);
    addArrow(marker, contact.point, length * contact.normal);
    marker.colors.resize(marker.points.size(), color(.1, .2, 1., 1.0 - age / IMPULSE_SHOWN));
  }
  return marker;
}

}  // namespace block_world
