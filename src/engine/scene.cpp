#include "block_world/scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "geometry.h"
#include "scene_checks.h"

namespace block_world
{
namespace
{
// The tolerance as a share of the smallest block.
constexpr double least_share = 1e-12, largest_share = 1e-2;

/// A block's shape and pose as completeScene checks them.
struct Placed
{
  Polygon polygon;
  Frame frame;
  double low, high;  ///< m, its reach along x
};

/// A wall's half-plane and its name.
struct Wall
{
  std::string name;
  Polygon half_plane;
};

std::vector<Wall> makeWalls(const Walls& walls)
{
  std::vector<Wall> made;
  if (walls.left)
    made.push_back({ "wall_left", makeHalfPlane(Vec2(1, 0), *walls.left) });
  if (walls.right)
    made.push_back({ "wall_right", makeHalfPlane(Vec2(-1, 0), -*walls.right) });
  if (walls.bottom)
    made.push_back({ "wall_bottom", makeHalfPlane(Vec2(0, 1), *walls.bottom) });
  if (walls.top)
    made.push_back({ "wall_top", makeHalfPlane(Vec2(0, -1), -*walls.top) });
  return made;
}

void checkWalls(const Walls& walls)
{
  const std::array<std::pair<const char*, std::optional<double>>, 4> given{ { { "walls.left", walls.left },
                                                                              { "walls.right", walls.right },
                                                                              { "walls.bottom", walls.bottom },
                                                                              { "walls.top", walls.top } } };
  for (const auto& [key, position] : given)
    if (position)
      requireFinite(*position, key);
  if (walls.left && walls.right && !(*walls.left < *walls.right))
    refuse("walls.right", "must be greater than walls.left, " + shown(*walls.left) + ", is " + shown(*walls.right));
  if (walls.bottom && walls.top && !(*walls.bottom < *walls.top))
    refuse("walls.top", "must be greater than walls.bottom, " + shown(*walls.bottom) + ", is " + shown(*walls.top));
}

std::vector<Vec2> rectangle(const Vec2& size)
{
  const double x = size.x() / 2.0, y = size.y() / 2.0;
  return { Vec2(-x, -y), Vec2(x, -y), Vec2(x, y), Vec2(-x, y) };
}

/// Refuses a polygon that is not strictly convex; turn is 1 where its vertices go counter-clockwise, else -1.
void requireConvex(const std::vector<Vec2>& vertices, double turn, const std::string& key)
{
  const std::size_t n = vertices.size();
  double extent = 0.0;
  for (const Vec2& p : vertices)
    extent = std::max(extent, (p - vertices.front()).norm());
  const double least = 1e-9 * extent;
  for (std::size_t i = 0; i < n; ++i)
    if (!((vertices[(i + 1) % n] - vertices[i]).norm() > least))
      refuse(indexed(key, (i + 1) % n), "lies on the vertex before it");

  // Every vertex inside of every side: this finds dents, straight corners and sides that cross.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = (i + 2) % n; j != i; j = (j + 1) % n)
    {
      const std::size_t next = (i + 1) % n;
      const Vec2 side = vertices[next] - vertices[i];
      if (!(turn * cross(side, vertices[j] - vertices[i]) > least * side.norm()))
        refuse(indexed(key, j), "is not strictly inside of the side from vertex " + std::to_string(i) + " to " +
                                    std::to_string(next) + ": the polygon must be convex, without straight corners");
    }
}

/// Least distance of two parallel lines that hold the polygon.
double leastWidth(const Polygon& polygon)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : polygon.faces)
  {
    double width = 0.0;
    for (const Vec2& p : polygon.vertices)
      width = std::max(width, face.offset - face.normal.dot(p));
    least = std::min(least, width);
  }
  return least;
}

/// Moves the centre of mass to the origin. What is there already to rounding stays untouched, so that completing twice
/// changes no bit.
void recentre(std::vector<Vec2>& vertices)
{
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Polygon polygon = makePolygon(vertices);
  const double noise = 64.0 * epsilon * polygon.radius * (polygon.radius / leastWidth(polygon));
  Vec2 centroid = areaMoments(vertices).centroid;
  if (centroid.norm() <= noise)
    return;
  // Far from the origin the first centroid is no better than the coordinates' last digit: take the rest out as well.
  for (int pass = 0; pass < 4 && centroid.norm() > 0.0; ++pass)
  {
    for (Vec2& p : vertices)
      p -= centroid;
    centroid = areaMoments(vertices).centroid;
  }
}

void completeShape(Block& block, const std::string& key)
{
  if (block.size)
  {
    requireFinite(*block.size, key + ".size");
    if (!(block.size->minCoeff() > 0.0))
      refuse(key + ".size", "width and height must be > 0, are " + shown(*block.size));
    block.vertices = rectangle(*block.size);
  }
  const std::string vertices_key = key + (block.size ? ".size" : ".vertices");
  if (block.vertices.size() < 3)
    refuse(vertices_key, "a polygon needs 3 vertices or more");
  for (std::size_t i = 0; i < block.vertices.size(); ++i)
    requireFinite(block.vertices[i], indexed(vertices_key, i));

  const AreaMoments moments = areaMoments(block.vertices);
  if (!(moments.area != 0.0 && std::isfinite(moments.area) && moments.gyration > 0.0 &&
        std::isfinite(moments.gyration)))
    refuse(vertices_key, "encloses no area that can be computed with");
  if (block.size)
    return;
  requireConvex(block.vertices, moments.area < 0.0 ? -1.0 : 1.0, vertices_key);
  if (moments.area < 0.0)
    std::reverse(block.vertices.begin() + 1, block.vertices.end());
  recentre(block.vertices);
}

void completeThrusters(std::vector<Thruster>& thrusters, const std::string& key)
{
  for (std::size_t i = 0; i < thrusters.size(); ++i)
  {
    Thruster& thruster = thrusters[i];
    const std::string own = indexed(key, i);
    requireFinite(thruster.point, own + ".point");
    requireFinite(thruster.direction, own + ".direction");
    requireNotNegative(thruster.strength, own + ".strength");
    const double length = thruster.direction.norm();
    if (!(length > 0.0) || !std::isfinite(length))
      refuse(own + ".direction", "must have a length, is " + shown(thruster.direction));
    if (std::abs(length - 1.0) > 4.0 * std::numeric_limits<double>::epsilon())
      thruster.direction /= length;
  }
}

void completeBlock(Block& block, const std::string& key)
{
  completeShape(block, key);
  requireFinite(block.mass, key + ".mass");
  if (!block.fixed && !(block.mass > 0.0))
    refuse(key + ".mass", "must be > 0, is " + shown(block.mass));
  requireFinite(block.position, key + ".pose");
  requireFinite(block.angle, key + ".pose");
  requireFinite(block.velocity, key + ".velocity");
  requireFinite(block.omega, key + ".velocity");
  if (block.fixed && (!block.velocity.isZero(0.0) || block.omega != 0.0))
    refuse(key + ".velocity", "a fixed block cannot move");
  if (block.elasticity)
    requireShare(*block.elasticity, key + ".elasticity");
  for (const double part : block.color)
    requireShare(part, key + ".color");
  if (block.thrusters)
    completeThrusters(*block.thrusters, key + ".thrusters");
}

void checkName(const std::string& name, const std::string& key)
{
  // Names go into CSV files and become TF frames.
  if (name.empty())
    refuse(key, "must not be empty");
  for (const char c : name)
    if (c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      refuse(key, "must not hold commas, double quotes or control characters");
  if (name.front() == '/')
    refuse(key, "must not begin with '/', which TF does not allow");
  for (const char* wall : { "wall_left", "wall_right", "wall_bottom", "wall_top" })
    if (name == wall)
      refuse(key, "'" + name + "' is the name of a wall");
}

void completeBlocks(std::vector<Block>& blocks)
{
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const std::string key = indexed("blocks", i);
    checkName(blocks[i].name, key + ".name");
    const auto [other, is_new] = seen.emplace(blocks[i].name, i);
    if (!is_new)
      refuse(key + ".name", "'" + blocks[i].name + "' is the name of " + indexed("blocks", other->second) + " already");
    completeBlock(blocks[i], key);
  }
}

std::vector<Placed> placeBlocks(const std::vector<Block>& blocks)
{
  std::vector<Placed> placed;
  placed.reserve(blocks.size());
  for (const Block& block : blocks)
  {
    Placed one{ makePolygon(block.vertices), Frame(block.position, block.angle), 0.0, 0.0 };
    one.low = block.position.x() - one.polygon.radius;
    one.high = block.position.x() + one.polygon.radius;
    placed.push_back(std::move(one));
  }
  return placed;
}

/// Largest number that a coordinate of a block or wall has at the start.
double largestCoordinate(const Walls& walls, const std::vector<Placed>& placed)
{
  double largest = 0.0;
  for (const auto& wall : { walls.left, walls.right, walls.bottom, walls.top })
    largest = std::max(largest, std::abs(wall.value_or(0.0)));
  for (const Placed& one : placed)
    largest = std::max(largest, one.frame.position.cwiseAbs().maxCoeff() + one.polygon.radius);
  return largest;
}

/// Checks the tolerance and raises it to what the coordinates can resolve; returns a note where it did.
std::vector<std::string> completeTolerance(Scene& scene, const std::vector<Placed>& placed)
{
  requireFinite(scene.tolerance, "tolerance");
  if (!(scene.tolerance > 0.0))
    refuse("tolerance", "must be > 0, is " + shown(scene.tolerance));
  double smallest = std::numeric_limits<double>::infinity();
  for (const Placed& one : placed)
    smallest = std::min(smallest, leastWidth(one.polygon));
  // The limits are products: 0.01 * 0.3 may be a digit below 0.003.
  const double low = least_share * smallest * (1.0 - 1e-12), high = largest_share * smallest * (1.0 + 1e-12);
  if (!placed.empty() && (scene.tolerance < low || scene.tolerance > high))
    refuse("tolerance", "must be 1e-12 to 1e-2 of the smallest block, here " + shown(low) + " to " + shown(high) +
                            " m, is " + shown(scene.tolerance));

  const double largest = largestCoordinate(scene.walls, placed);
  const double resolved = 8.0 * (std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest);
  if (scene.tolerance >= resolved)
    return {};
  if (!placed.empty() && resolved > high)
    refuse("tolerance", "coordinates as large as " + shown(largest) + " m resolve only " + shown(resolved) +
                            " m, more than 1e-2 of the smallest block");
  std::ostringstream note;
  note << "tolerance raised from " << shown(scene.tolerance) << " to " << shown(resolved)
       << " m, all that coordinates as large as " << shown(largest) << " m can resolve";
  scene.tolerance = resolved;
  return { note.str() };
}

/// Refuses the later of two blocks that overlap.
void checkPair(const Scene& scene, const std::vector<Placed>& placed, std::size_t i, std::size_t j)
{
  if (scene.blocks[i].fixed && scene.blocks[j].fixed)
    return;
  const Placed &a = placed[i], &b = placed[j];
  const double reach = a.polygon.radius + b.polygon.radius;
  if ((a.frame.position - b.frame.position).squaredNorm() > reach * reach)
    return;
  const double overlap = -separation(a.polygon, a.frame, b.polygon, b.frame);
  if (overlap < scene.tolerance)
    return;
  const std::size_t late = std::max(i, j), early = std::min(i, j);
  refuse(indexed("blocks", late) + ".pose", scene.blocks[late].name + " overlaps " + scene.blocks[early].name + " by " +
                                                shown(overlap) + " m, the tolerance is " + shown(scene.tolerance) +
                                                " m");
}

void checkOverlaps(const Scene& scene, const std::vector<Placed>& placed)
{
  const std::vector<Wall> walls = makeWalls(scene.walls);
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (const Wall& wall : walls)
    {
      const double overlap = -separation(placed[i].polygon, placed[i].frame, wall.half_plane, Frame());
      if (!scene.blocks[i].fixed && overlap >= scene.tolerance)
        refuse(indexed("blocks", i) + ".pose", scene.blocks[i].name + " overlaps " + wall.name + " by " +
                                                   shown(overlap) + " m, the tolerance is " + shown(scene.tolerance) +
                                                   " m");
    }

  // Sweep along x, so that thousands of blocks cost no time.
  std::vector<std::size_t> order(placed.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return placed[i].low < placed[j].low; });
  for (std::size_t p = 0; p < order.size(); ++p)
    for (std::size_t q = p + 1; q < order.size() && placed[order[q]].low <= placed[order[p]].high; ++q)
      checkPair(scene, placed, order[p], order[q]);
}

}  // namespace

std::vector<Thruster> defaultThrusters(const std::vector<Eigen::Vector2d>& vertices, double strength)
{
  Vec2 low = vertices.front(), high = vertices.front();
  for (const Vec2& p : vertices)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 extent = high - low;
  const bool is_wide = extent.x() > extent.y();
  const double arm = 3.0 * extent.maxCoeff() / 10.0;

  struct Row
  {
    double side;
    Vec2 direction;
    double factor;
  };
  const std::array<Row, 6> table{ { { 1.0, Vec2(-1.0, 0.0), 0.4 },
                                    { 1.0, Vec2(1.0, 0.0), 0.4 },
                                    { 1.0, Vec2(0.0, 1.0), 1.0 },
                                    { -1.0, Vec2(0.0, -1.0), 1.0 },
                                    { -1.0, Vec2(-1.0, 0.0), 0.4 },
                                    { -1.0, Vec2(1.0, 0.0), 0.4 } } };
  std::vector<Thruster> thrusters;
  for (const Row& row : table)
  {
    const Vec2 point(0.0, row.side * arm);
    const auto turn = [&](const Vec2& v) { return is_wide ? Vec2(v.y(), -v.x()) : v; };
    thrusters.push_back({ turn(point), turn(row.direction), row.factor * strength });
  }
  return thrusters;
}

std::vector<std::string> completeScene(Scene& scene)
{
  requireNotNegative(scene.gravity, "gravity");
  requireShare(scene.elasticity, "elasticity");
  requireNotNegative(scene.damping, "damping");
  requireNotNegative(scene.rotational_damping_ratio, "rotational_damping_ratio");
  requireNotNegative(scene.thrust, "thrusters.strength");
  checkWalls(scene.walls);
  completeBlocks(scene.blocks);
  checkSprings(scene);
  checkInputs(scene);
  const std::vector<Placed> placed = placeBlocks(scene.blocks);
  std::vector<std::string> notes = completeTolerance(scene, placed);
  checkOverlaps(scene, placed);
  return notes;
}

}  // namespace block_world
