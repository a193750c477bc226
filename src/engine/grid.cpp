#include "grid.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
/// Share of a cell's size by which a centre may leave it.
constexpr double kMargin = 1.0 / 16.0;

/// Up to so many bodies make no more pairs than they are: cells would spare nothing, and all are near each other.
constexpr int kFew = 3;

/// m; size of their cells, beyond any coordinate.
constexpr double kEndless = 0x1p1000;

/// Cells are counted as far as coordinates tell one from the next. Those at the end have no other end.
constexpr std::int64_t kFarthest = std::int64_t{ 1 } << 53;

std::int64_t indexOf(double cells)
{
  return static_cast<std::int64_t>(std::fmax(-0x1p53, std::fmin(0x1p53, std::floor(cells))));
}

std::int64_t halved(std::int64_t value, int times)
{
  const std::int64_t divisor = std::int64_t{ 1 } << times;
  const std::int64_t quotient = value / divisor;
  return value % divisor < 0 ? quotient - 1 : quotient;
}
}  // namespace

void Grid::configure(const std::vector<double>& radii, double shell)
{
  levels_.clear();
  homes_.assign(radii.size(), Home());
  // Two circles in cells that are not neighbours are at least a cell less two margins apart.
  const auto needed = [shell](double radius) { return (2.0 * radius + shell) / (1.0 - 2.0 * kMargin); };
  few_ = std::count_if(radii.begin(), radii.end(), [](double radius) { return std::isfinite(radius); }) <= kFew;
  double finest = few_ ? kEndless : HUGE_VAL;
  if (!few_)
    for (double radius : radii)
      finest = std::min(finest, needed(radius));
  std::vector<int> shifts(radii.size(), 0), used;
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    if (!std::isfinite(radii[i]))
      continue;
    while (std::ldexp(finest, shifts[i]) < needed(radii[i]))
      ++shifts[i];
    used.push_back(shifts[i]);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int shift : used)
    levels_.push_back({ std::ldexp(finest, shift), shift });

  int count = 0;
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    if (!std::isfinite(radii[i]))
      continue;
    homes_[i].level = static_cast<int>(std::lower_bound(used.begin(), used.end(), shifts[i]) - used.begin());
    homes_[i].first = count;
    count += static_cast<int>(levels_.size()) - homes_[i].level;
  }
  entries_.assign(count, Entry());
  Block empty;
  empty.heads.fill(-1);
  std::size_t blocks = 1;
  while (empty.heads.size() * blocks < 2 * entries_.size())
    blocks *= 2;
  blocks_.assign(blocks, empty);
}

std::size_t Grid::block(int level, const Cell& cell) const
{
  std::uint64_t hash = static_cast<std::uint64_t>(cell.x >> 2) * 0x9e3779b97f4a7c15u;
  hash ^= static_cast<std::uint64_t>(cell.y >> 2) * 0xc2b2ae3d27d4eb4fu + static_cast<std::uint64_t>(level) * 0x165667b19e3779f9u;
  hash ^= hash >> 32;
  return static_cast<std::size_t>(hash * 0x9e3779b97f4a7c15u >> 32) & (blocks_.size() - 1);
}

void Grid::link(int entry)
{
  int& first = blocks_[block(entries_[entry].level, entries_[entry].cell)].heads[within(entries_[entry].cell)];
  entries_[entry].previous = -1;
  entries_[entry].next = first;
  if (first >= 0)
    entries_[first].previous = entry;
  first = entry;
}

void Grid::unlink(int entry)
{
  const Entry& e = entries_[entry];
  if (e.previous >= 0)
    entries_[e.previous].next = e.next;
  else
    blocks_[block(e.level, e.cell)].heads[within(e.cell)] = e.next;
  if (e.next >= 0)
    entries_[e.next].previous = e.previous;
}

bool Grid::place(int body, const Vec2& centre)
{
  Home& home = homes_[body];
  if (home.level < 0)
    return false;
  const double size = levels_[home.level].size;
  const Cell own{ indexOf(centre.x() / size), indexOf(centre.y() / size) };
  if (home.listed && own == entries_[home.first].cell)
    return false;
  for (int level = home.level; level < static_cast<int>(levels_.size()); ++level)
  {
    const int entry = home.first + level - home.level;
    const int up = levels_[level].shift - levels_[home.level].shift;
    if (home.listed)
      unlink(entry);
    entries_[entry].body = body;
    entries_[entry].level = level;
    entries_[entry].cell = { halved(own.x, up), halved(own.y, up) };
    link(entry);
  }
  home.listed = true;
  return true;
}

bool Grid::near(int a, int b) const
{
  const int level = std::max(homes_[a].level, homes_[b].level);
  const Cell &p = cell(a, level), &q = cell(b, level);
  return std::abs(p.x - q.x) <= 1 && std::abs(p.y - q.y) <= 1;
}

void Grid::neighbours(int body, std::vector<int>& found) const
{
  found.clear();
  const int own = homes_[body].level;
  for (int level = own; level < static_cast<int>(levels_.size()); ++level)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
      {
        const Cell& centre = cell(body, level);
        const Cell wanted{ centre.x + dx, centre.y + dy };
        for (int entry = blocks_[block(level, wanted)].heads[within(wanted)]; entry >= 0; entry = entries_[entry].next)
        {
          const int other = entries_[entry].body;
          // On a coarser level only those that live there: with the others this body meets on a finer one.
          if (entries_[entry].cell == wanted && entries_[entry].level == level && other != body && (level == own || homes_[other].level == level))
            found.push_back(other);
        }
      }
}

Grid::Box Grid::keeps(int body) const
{
  if (few_)
    return { Vec2::Constant(-HUGE_VAL), Vec2::Constant(HUGE_VAL) };
  const Cell& own = cell(body, homes_[body].level);
  const double size = levels_[homes_[body].level].size;
  const auto low = [size](std::int64_t index) { return index == -kFarthest ? -HUGE_VAL : static_cast<double>(index) * size - kMargin * size; };
  const auto high = [size](std::int64_t index) { return index == kFarthest ? HUGE_VAL : static_cast<double>(index) * size + (1.0 + kMargin) * size; };
  return { Vec2(low(own.x), low(own.y)), Vec2(high(own.x), high(own.y)) };
}

}  // namespace block_world
