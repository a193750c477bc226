#pragma once

#include <vector>

namespace block_world
{
/// The range of values that an axis shows; 0 is always in it. What comes to lie outside is let in at once; room that is
/// not used any more goes little by little, and only when it is much, so that what is drawn does not jump.
class EnergyScale
{
public:
  /// low and high are what there is to show now, dt the s since the last time.
  void adapt(double low, double high, double dt);

  double low() const;
  double high() const;

  /// Round numbers in the range, at most so many.
  std::vector<double> ticks(int most) const;

private:
  /// One end, as a distance from 0.
  struct End
  {
    double reach = 0.0;
    bool shrinks = false;

    void adapt(double needed, double dt);
  };

  End low_, high_;
};

}  // namespace block_world
