#include "shapes.h"

#include <algorithm>

#include "block_world/scene.h"

namespace campaign
{
namespace
{
using block_world::Block;

/// A point of the unit circle by its rational parametrisation, since the last digit of cos and sin depends on the
/// machine.
Vector2d onCircle(double u, bool left)
{
  const double c = (1.0 - u * u) / (1.0 + u * u), s = 2.0 * u / (1.0 + u * u);
  return left ? Vector2d(-c, -s) : Vector2d(c, s);
}

/// Corners on an ellipse, in counter-clockwise order.
std::vector<Vector2d> onEllipse(Dice& dice, int count, const Vector2d& radii)
{
  std::vector<double> right, left;
  for (int i = 0; i < count; ++i)
    (dice.chance(0.5) ? right : left).push_back(dice.in(-1.0, 1.0));
  std::vector<Vector2d> vertices;
  for (auto* half : { &right, &left })
  {
    std::sort(half->begin(), half->end());
    for (const double u : *half)
    {
      const Vector2d p = onCircle(u, half == &left).cwiseProduct(radii);
      vertices.emplace_back(Dice::few(p.x()), Dice::few(p.y()));
    }
  }
  return vertices;
}

/// Least distance between parallel lines along a side that hold the polygon.
double leastWidth(const std::vector<Vector2d>& vertices)
{
  double least = 1e300;
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const Vector2d side = (vertices[(i + 1) % vertices.size()] - vertices[i]).normalized();
    double width = 0.0;
    for (const Vector2d& v : vertices)
      width = std::max(width, side.x() * (v - vertices[i]).y() - side.y() * (v - vertices[i]).x());
    least = std::min(least, width);
  }
  return least;
}

/// Centres the block on its mass; false where its vertices are no polygon to be used.
bool complete(Block& block)
{
  block_world::Scene alone;
  alone.tolerance = 1e-9;
  alone.blocks.assign(1, block);
  try
  {
    block_world::completeScene(alone);
  }
  catch (const block_world::SceneError&)
  {
    return false;
  }
  block = alone.blocks.front();
  return true;
}
}  // namespace

std::vector<Vector2d> corners(const Vector2d& size)
{
  const double x = size.x() / 2.0, y = size.y() / 2.0;
  return { Vector2d(-x, -y), Vector2d(x, -y), Vector2d(x, y), Vector2d(-x, y) };
}

Block makeShape(Dice& dice)
{
  Block block;
  block.name = "shape";
  const double width = std::min(dice.octaves(0.1, 5), 3.0),
               height = Dice::few(std::min(3.0, width * dice.in(0.3, 3.0)));
  if (dice.chance(0.5))
  {
    block.size = Vector2d(width, height);
    block.vertices = corners(*block.size);
    return block;
  }
  const double thin = 0.2 * std::min(width, height);
  do
  {
    block.vertices = onEllipse(dice, dice.from(3, 8), 0.5 * Vector2d(width, height));
  } while (leastWidth(block.vertices) < thin || !complete(block));
  return block;
}

double areaOf(const Block& block)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < block.vertices.size(); ++i)
  {
    const Vector2d &p = block.vertices[i], &q = block.vertices[(i + 1) % block.vertices.size()];
    sum += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return sum;
}

double widthOf(const Block& block)
{
  double radius = 0.0;
  for (const Vector2d& v : block.vertices)
    radius = std::max(radius, v.norm());
  return 2.0 * radius;
}

}  // namespace campaign
