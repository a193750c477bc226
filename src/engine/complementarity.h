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
    truncate(0);
  }
  int size() const
  {
    return size_;
  }
  /// Appends row[0..size()] (the last is the diagonal). Refuses, returning false, a row that depends on the former ones: one whose pivot falls
  /// below that share of its diagonal, or that would magnify rounding by more than its inverse in the loads of former ones.
  bool append(const double* row, double share = kDependent);
  /// Takes the rows of another one.
  void copy(const Cholesky& other);
  /// Keeps the first rows only.
  void truncate(int size)
  {
    size_ = size;
    while (!doubtful_.empty() && doubtful_.back() >= size)
      doubtful_.pop_back();
  }
  /// Whether some row depends on the former ones so nearly that digits of x are lost.
  bool doubtful() const
  {
    return !doubtful_.empty();
  }
  /// x = (L L^T)^-1 x.
  void solve(double* x) const;

private:
  void provide(int size);
  double heaviest(const double* l);
  const double* row(int i) const
  {
    return lower_.data() + i * (i + 1) / 2;
  }

  int size_ = 0;
  std::vector<double> lower_;  ///< rows of the lower triangle, one after the other
  std::vector<double> z_;
  std::vector<int> first_;     ///< by row: its first entry that is not zero
  std::vector<int> doubtful_;  ///< rows with small pivots
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

private:
  int size_ = 0;
  Room room_;
  std::vector<double> entries_;
};

/// Minimises 1/2 l'A l + b'l over l >= 0 for the rows and columns of A that are named; A is positive semi-definite.
///
/// Equivalent: 0 <= l, A l + b >= 0, l.(A l + b) = 0. Active sets after Lawson & Hanson (1974, ch. 23): the passive set stays linearly
/// independent; a redundant row enters only in exchange for another one. Finite.
class Complementarity
{
public:
  Complementarity()
  {
    provide(2);
  }
  /// rows: indices into A; b: one value per row; guess: positions within rows that may carry load, from which the search starts. The result is read from
  /// value() and support().
  void solve(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b, const std::vector<int>& guess = {});

  /// The first rows, those of the factor `held`, are equations instead: (A l + b)_i = 0 with l_i of any sign. What is above -noise does not count as
  /// negative.
  void solveHeld(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b, const Cholesky& held, double noise);

  /// The last digits of l after a solve without held rows.
  void refine();

  /// l, one value per row of the last solve.
  const std::vector<double>& value() const
  {
    return l_;
  }
  /// Positions within rows at which l > 1e-10 of the largest l, ascending: those that carry load. Linearly independent. (A contact force ends below
  /// -1e-12 of the largest: what lies between is neither taken up nor let go, and rounding cannot do both in turn.)
  const std::vector<int>& support() const
  {
    return support_;
  }

private:
  void provide(std::size_t rows);
  void start(const SymmetricMatrix& a, const std::vector<int>& rows, const std::vector<double>& b);
  void search(double noise);
  double gradient(int i, double& magnitude) const;
  bool enter(int i);
  void settle();
  void keep();
  void undo(int entered);
  void refactor(int from);
  void solvePassive(std::vector<double>& x);
  void improve(std::vector<double>& x);
  bool rowOf(int position, int candidate);

  Room room_;
  const SymmetricMatrix* a_ = nullptr;
  const std::vector<int>* rows_ = nullptr;
  const std::vector<double>* b_ = nullptr;
  Cholesky factor_;
  std::vector<int> passive_;
  int held_ = 0;             ///< the first so many passive rows stay passive
  std::vector<char> state_;  ///< 0 at zero, 1 passive, 2 redundant for now
  std::vector<double> l_, x_, residual_, row_;
  std::vector<int> before_;          ///< the passive rows before one entered
  std::vector<double> l_before_;
  bool kept_ = false;                ///< whether these two are known
  std::vector<int> support_;
};

}  // namespace block_world
