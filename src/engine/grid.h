#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry.h"
#include "room.h"

namespace block_world
{
/// Who may meet whom: square cells on several levels.
///
/// A body lives on the finest level whose cells it cannot reach across: their size s holds its circle's diameter and the contact shell with an eighth to spare. It
/// is listed in one cell there and in the cells of the coarser levels that hold that cell. Bodies may meet only if, on the level of the larger
/// one, their cells are the same or next to each other; and a body keeps its cells until its centre is s/16 outside, so that none goes to and
/// fro between two of them. Memory is fixed once configured.
class Grid
{
public:
  /// radii: m, of the bodies' circles, infinite for those that have no place in the grid; shell: m.
  void configure(const std::vector<double>& radii, double shell);

  /// Whether no body ever leaves its cell.
  bool endless() const
  {
    return few_;
  }

  /// Lists the body where its centre is. Returns whether that changed its cell.
  bool place(int body, const Vec2& centre);

  /// Whether two listed bodies may meet before either changes its cell.
  bool near(int a, int b) const;

  /// All bodies near a listed one.
  void neighbours(int body, std::vector<int>& found) const;

  /// Where a body's centre may be without a change of its cell.
  struct Box
  {
    Vec2 low, high;
  };
  Box keeps(int body) const;

  template <class A>
  void exchange(A& archive)
  {
    archive(few_, levels_, homes_, entries_, blocks_);
  }

private:
  struct Cell
  {
    std::int64_t x = 0, y = 0;
    bool operator==(const Cell& other) const
    {
      return x == other.x && y == other.y;
    }
    template <class A>
    void exchange(A& archive)
    {
      archive(x, y);
    }
  };
  /// One listing of a body; those whose cells hash alike form a list.
  struct Entry
  {
    Cell cell;
    int level = 0;
    int body = -1;
    int next = -1, previous = -1;
    template <class A>
    void exchange(A& archive)
    {
      archive(cell, level, body, next, previous);
    }
  };
  struct Home
  {
    int level = -1;  ///< -1: not in the grid
    int first = -1;  ///< its entries, one a level from its own up
    bool listed = false;
    template <class A>
    void exchange(A& archive)
    {
      archive(level, first, listed);
    }
  };
  struct Level
  {
    double size = 0.0;  ///< m
    int shift = 0;      ///< cells of this level hold 2^shift of the finest, along each axis
    template <class A>
    void exchange(A& archive)
    {
      archive(size, shift);
    }
  };

  /// First entries of the lists of 4 x 4 cells: neighbours are near to each other in memory, too.
  struct alignas(kCacheLine) Block
  {
    std::array<int, 16> heads;
    template <class A>
    void exchange(A& archive)
    {
      archive(heads);
    }
  };

  const Cell& cell(int body, int level) const
  {
    return entries_[homes_[body].first + level - homes_[body].level].cell;
  }
  std::size_t block(int level, const Cell& cell) const;
  static std::size_t within(const Cell& cell)
  {
    return static_cast<std::size_t>(4 * (cell.y & 3) + (cell.x & 3));
  }
  void link(int entry);
  void unlink(int entry);

  bool few_ = false;            ///< so few bodies that all are near each other
  std::vector<Level> levels_;  ///< those that bodies live on, finest first
  std::vector<Home> homes_;
  std::vector<Entry> entries_;
  std::vector<Block> blocks_;  ///< by hash of level and place
};

}  // namespace block_world
