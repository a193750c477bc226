#pragma once

#include <functional>

#include "case.h"
#include "result.h"

namespace campaign
{
/// Makes a failing case smaller for as long as the same check fails: a later start, an earlier end, fewer blocks,
/// springs, commands and walls, simpler numbers.
class Shrinker
{
public:
  using Judge = std::function<Result(const Case&)>;

  /// judge must survive whatever the engine does. seconds: time that may pass.
  Shrinker(const Case& item, const Failure& failure, Judge judge, double seconds);

  Case shrink();
  /// Of the case as it is now.
  const Failure& failure() const
  {
    return failure_;
  }

private:
  bool tryOn(const Case& candidate);
  bool startLater();
  bool endEarlier();
  bool dropBlocks();
  bool simplify();
  template <class Count, class Without>
  bool dropSome(std::size_t largest, const Count& count, const Without& without);
  template <class List>
  bool dropFrom(const List& list);
  bool outOfTime() const;

  Case case_;
  Failure failure_;
  Judge judge_;
  double end_;
};

}  // namespace campaign
