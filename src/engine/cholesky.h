#pragma once

#include <vector>

#include "room.h"

namespace block_world
{
/// Share of its diagonal below which a pivot says that its row depends on others: such rows carry nothing. Of rows that were independent in one order
/// the pivots in another are smaller, but not by more than the second.
constexpr double kDependent = 1e-11, kTrusted = 1e-14;

/// Cholesky factor of a growing symmetric positive definite matrix, row by row. Zeros at the beginning of a row stay zero in the factor and are
/// skipped (skyline storage; George & Liu 1981, ch. 4): bodies that touch only their neighbours make narrow rows.
class Cholesky
{
public:
  Cholesky()
  {
    provide(1);
  }
  void clear()
  {
    size_ = 0;
    doubtful_ = false;
  }
  int size() const
  {
    return size_;
  }
  /// Appends row[0..size()] (the last is the diagonal). Refuses, returning false, a row that depends on the former ones: one whose pivot falls
  /// below that share of its diagonal, or that would magnify rounding by more than its inverse in the loads of former ones.
  bool append(const double* row, double share = kDependent);
  /// Takes that row and column out of the matrix. Pivots only grow.
  void remove(int which);
  /// Keeps the first rows only.
  void truncate(int size)
  {
    size_ = size;
  }
  /// Whether some row since the last clear() depends on the former ones so nearly that digits of x are lost.
  bool doubtful() const
  {
    return doubtful_;
  }
  /// x = (L L^T)^-1 x.
  void solve(double* x) const;

private:
  void provide(int size);
  double heaviest(const double* l);
  double* row(int i)
  {
    return lower_.data() + i * (i + 1) / 2;
  }
  const double* row(int i) const
  {
    return lower_.data() + i * (i + 1) / 2;
  }

  /// Takes two columns and with them what is left of one that was removed.
  struct Rotation
  {
    double cosine, sine;
  };

  int size_ = 0;
  std::vector<double> lower_;  ///< rows of the lower triangle, one after the other
  std::vector<double> z_;
  std::vector<Rotation> rotations_;
  std::vector<int> first_;  ///< by row: its first entry that is not zero
  bool doubtful_ = false;
};

/// Dense symmetric matrix that keeps its memory.
class SymmetricMatrix
{
public:
  void resize(int size)
  {
    size_ = size;
    const std::size_t entries = static_cast<std::size_t>(size) * size;
    room_.provide(entries, entries_);
    entries_.assign(entries, 0.0);
  }
  int size() const
  {
    return size_;
  }
  double& operator()(int i, int j)
  {
    return entries_[static_cast<std::size_t>(i) * size_ + j];
  }
  double operator()(int i, int j) const
  {
    return entries_[static_cast<std::size_t>(i) * size_ + j];
  }
  const double* row(int i) const
  {
    return entries_.data() + static_cast<std::size_t>(i) * size_;
  }

private:
  int size_ = 0;
  Room room_;
  std::vector<double> entries_;
};

}  // namespace block_world
