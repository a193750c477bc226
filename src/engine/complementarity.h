#pragma once

#include <vector>

#include "cholesky.h"

namespace block_world
{
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
  /// The matrix of the solves that follow. Each of them starts from the rows that carried load in the one before.
  void begin(const SymmetricMatrix& a);

  /// The next solve starts with that row, too.
  void suppose(int row);

  /// rows: indices into A; b: one value per row of A; the result is read from value() and support(). The rows that are held, some of the others and
  /// independent of each other, are equations instead: (A l + b)_i = 0 with l_i of any sign. What is above -noise does not count as negative.
  void solve(const std::vector<int>& rows, const std::vector<double>& b, const std::vector<int>& held = {}, double noise = 0.0);

  /// The last digits of l after a solve without held rows.
  void refine();

  /// l, one value per row of A.
  const std::vector<double>& value() const
  {
    return l_;
  }
  /// Rows at which l > 1e-10 of the largest l, ascending: those that carry load. Linearly independent. (A contact force ends below
  /// -1e-12 of the largest: what lies between is neither taken up nor let go, and rounding cannot do both in turn.)
  const std::vector<int>& support() const
  {
    return support_;
  }

private:
  enum class State : char
  {
    Out,        ///< not among the rows of this solve
    Zero,       ///< carries nothing
    Redundant,  ///< carries nothing and depends on passive rows; looked at again when these change
    Passive,    ///< may carry load
    Held        ///< an equation: passive, with a load of any sign
  };

  void provide(std::size_t rows);
  void choose(const std::vector<int>& rows, const std::vector<int>& held);
  void hold(int row);
  void takePositive();
  void search(const std::vector<int>& rows, double noise);
  double gradient(int i, double& magnitude) const;
  bool enter(int i);
  void settle();
  void leave(int position, State state);
  void keep();
  void undo(int entered);
  void refactor(int from);
  void solvePassive(std::vector<double>& x);
  bool factorRow(int position, int row, double share = kDependent);

  Room room_;
  const SymmetricMatrix* a_ = nullptr;
  const std::vector<double>* b_ = nullptr;
  Cholesky factor_;
  std::vector<int> passive_;
  std::vector<State> state_;
  std::vector<double> l_, x_, row_;
  std::vector<int> before_;  ///< the passive rows before one entered
  std::vector<double> l_before_;
  bool kept_ = false;  ///< whether these two are known
  std::vector<int> support_;
};

}  // namespace block_world
