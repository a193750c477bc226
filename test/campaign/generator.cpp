#include "generator.h"

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "dice.h"
#include "outline.h"
#include "shapes.h"

namespace campaign
{
namespace
{
using namespace block_world;

/// Makes one case, part by part; the order of the throws is the meaning of a seed.
class Generator
{
public:
  explicit Generator(std::uint64_t seed) : dice_(seed)
  {
    scene().name = "campaign " + std::to_string(seed);
  }

  Case make()
  {
    const double kind = dice_.in(0.0, 1.0);
    is_crowded_ = kind < 0.6;
    is_adrift_ = kind > 0.9;
    makeWorld();
    if (dice_.chance(0.15))
      makeLattice();
    else
      makeHeap();
    makeWalls();
    if (dice_.chance(0.35))
      makeSprings();
    if (!is_adrift_)
      CommandMaker(dice_, case_, size_).make();
    return case_;
  }

private:
  Scene& scene()
  {
    return case_.scene;
  }

  void makeWorld()
  {
    case_.duration = dice_.round(is_crowded_ ? 3.0 : 5.0, 10.0);
    scene().gravity = !is_adrift_ && dice_.chance(0.75) ? dice_.round(0.0, 10.0) : 0.0;
    elasticity_ = dice_.below(3);
    scene().elasticity = elasticity_ == 0 ? 1.0 : dice_.chance(0.2) ? 0.0 : dice_.round(0.0, 1.0);
    if (!is_adrift_ && dice_.chance(0.3))
      scene().damping = dice_.octaves(0.01, 8);
    scene().rotational_damping_ratio = dice_.round(0.0, 0.5);
    const double tolerances[] = { 1e-6, 1e-6, 1e-6, 1e-5, 1e-7, 1e-9 };
    scene().tolerance = tolerances[dice_.below(6)];
    scene().thrust = dice_.round(0.0, 5.0);
  }

  /// All elastic, all as the scene, or each its own.
  void makeMatter(Block& block)
  {
    block.mass = dice_.octaves(0.1, 10);
    if (elasticity_ == 2 && dice_.chance(0.7))
      block.elasticity = dice_.chance(0.2) ? dice_.below(2) : dice_.round(0.0, 1.0);
  }

  void makeMotion(Block& block)
  {
    if (block.fixed || dice_.chance(0.2))
      return;
    const double fastest = dice_.chance(0.1) ? 20.0 : 4.0;
    block.velocity = dice_.vector(fastest);
    // Without walls they would only part.
    if (!has_walls_)
      block.velocity += Vector2d(Dice::few(-block.position.x()), Dice::few(-block.position.y()));
    block.omega = dice_.chance(0.7) ? dice_.round(-3.0, 3.0) : 0.0;
  }

  /// Blocks of all sizes, thrown in where there is room.
  void makeHeap()
  {
    has_walls_ = !is_adrift_;
    const int wanted = dice_.from(1, 20);
    const bool has_fixed = !is_adrift_ && dice_.chance(0.25);
    std::vector<Block> blocks;
    double area = 0.0;
    for (int i = 0; i < wanted; ++i)
    {
      blocks.push_back(makeShape(dice_));
      makeMatter(blocks.back());
      blocks.back().fixed = has_fixed && i > 0 && dice_.chance(0.2);
      area += areaOf(blocks.back());
    }
    // The largest first: the small ones find room between them.
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Block& p, const Block& q) { return areaOf(p) > areaOf(q); });
    const double filled = is_crowded_ ? dice_.in(0.25, 0.6) : dice_.in(0.03, 0.2);
    const double shape = dice_.in(0.7, 1.4), side = std::sqrt(area / filled);
    const double room = 1.1 * widthOf(blocks.front());
    size_ = Vector2d(Dice::few(std::max(side * shape, room)), Dice::few(std::max(side / shape, room)));
    for (Block& block : blocks)
      place(block);
  }

  void place(Block& block)
  {
    constexpr double apart = 1e-3;
    const std::vector<Outline> walls = outlinesOf(box());
    for (int attempt = 0; attempt < 100; ++attempt)
    {
      block.position = dice_.vector(0.5 * size_);
      block.angle = dice_.chance(0.2) ? 0.0 : dice_.round(-3.141, 3.141);
      const Outline outline = outlineOf(block, block.position, block.angle);
      const auto clear = [&](const Outline& other) { return separation(outline, other, apart) > apart; };
      if (!std::all_of(walls.begin(), walls.end(), clear) || !std::all_of(outlines_.begin(), outlines_.end(), clear))
        continue;
      outlines_.push_back(outline);
      add(block);
      return;
    }
  }

  /// Equal rectangles side by side and on one another, exactly touching or apart by some power of two: simultaneous
  /// hits.
  void makeLattice()
  {
    has_walls_ = !is_adrift_;
    const int columns = dice_.from(1, 4), rows = dice_.from(1, 4);
    const double width = 0.25 * dice_.from(1, 8);
    const Vector2d cell(width, 0.25 * dice_.from(1, 8));
    const double gap = dice_.chance(0.4) ? 0.0 : std::ldexp(1.0, -dice_.from(1, 12));
    const Vector2d step = cell + Vector2d(dice_.chance(0.5) ? gap : 0.0, gap);
    const Vector2d margin = 0.25 * Vector2d(dice_.from(0, 8), 0.0);
    const bool equal = dice_.chance(0.5), together = dice_.chance(0.5);
    Block first;
    first.size = cell;
    makeMatter(first);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
      {
        Block block = first;
        if (!equal)
          makeMatter(block);
        block.vertices = corners(cell);
        block.position = Vector2d((column - 0.5 * (columns - 1)) * step.x(), (row - 0.5 * (rows - 1)) * step.y());
        if (together)
          block.velocity = Vector2d(0.0, -1.0);
        else
          makeMotion(block);
        if (dice_.chance(0.7))
          block.omega = 0.0;
        scene().blocks.push_back(named(block));
      }
    size_ = margin + Vector2d(columns * step.x(), rows * step.y() + 0.5 * dice_.from(0, 8));
  }

  void add(Block block)
  {
    makeMotion(block);
    scene().blocks.push_back(named(block));
  }

  Block named(Block block)
  {
    block.name = "b" + std::to_string(scene().blocks.size() + 1);
    return block;
  }

  Walls box() const
  {
    return Walls{ -0.5 * size_.x(), 0.5 * size_.x(), -0.5 * size_.y(), 0.5 * size_.y() };
  }

  /// All, some or none.
  void makeWalls()
  {
    if (is_adrift_)
      return;
    scene().walls = box();
    if (dice_.chance(0.75))
      return;
    const int kind = dice_.below(16);
    if (kind & 1)
      scene().walls.top.reset();
    if (kind & 2)
      scene().walls.left.reset();
    if (kind & 4)
      scene().walls.right.reset();
    if (kind & 8 && !is_crowded_)
      scene().walls.bottom.reset();
  }

  Vector2d pointIn(const Block& block)
  {
    return dice_.vector(0.5 * widthOf(block));
  }

  void makeSprings()
  {
    const int blocks = static_cast<int>(scene().blocks.size());
    for (int count = dice_.from(1, 5); count > 0; --count)
    {
      const Block& from = scene().blocks[dice_.below(blocks)];
      const Block& to = scene().blocks[dice_.below(blocks)];
      Spring spring;
      spring.from_block = from.name;
      spring.from_point = pointIn(from);
      spring.to_point = dice_.vector(0.5 * size_);
      if (is_adrift_ && to.name == from.name)
        continue;
      if (to.name != from.name && (is_adrift_ || dice_.chance(0.6)))
      {
        spring.to_block = to.name;
        spring.to_point = pointIn(to);
      }
      spring.stiffness = dice_.octaves(0.5, 8);
      spring.rest_length = dice_.chance(0.3) ? 0.0 : dice_.round(0.0, 2.0);
      spring.damping = dice_.chance(0.5) ? 0.0 : dice_.octaves(0.01, 8);
      scene().springs.push_back(spring);
    }
  }

  Dice dice_;
  Case case_;
  bool is_crowded_ = false;
  bool is_adrift_ = false;  ///< nothing from outside: momentum stays
  bool has_walls_ = true;
  int elasticity_ = 0;  ///< 0 all elastic, 1 all as the scene, 2 each its own
  Vector2d size_ = Vector2d::Ones();
  std::vector<Outline> outlines_;
};
}  // namespace

Case generate(std::uint64_t seed)
{
  return throughFile(Generator(seed).make());
}

}  // namespace campaign
