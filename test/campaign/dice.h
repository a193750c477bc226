#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <random>

namespace campaign
{
/// The same numbers from the same seed on every machine: the engine of the standard library is prescribed to the bit,
/// its distributions are not, so these are made by hand, without functions whose last digit depends on the library.
class Dice
{
public:
  explicit Dice(std::uint64_t seed) : generator_(seed)
  {
  }
  double in(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  /// With few digits, so that a scene can be read; zero stays possible.
  double round(double low, double high)
  {
    return few(in(low, high));
  }
  /// Within a rectangle about the origin. (Two throws in one call's arguments would have no order.)
  Eigen::Vector2d vector(const Eigen::Vector2d& half)
  {
    const double x = round(-half.x(), half.x());
    return Eigen::Vector2d(x, round(-half.y(), half.y()));
  }
  Eigen::Vector2d vector(double half)
  {
    return vector(Eigen::Vector2d(half, half));
  }
  /// Every octave above `low` is as likely as any other.
  double octaves(double low, int count)
  {
    const int octave = below(count);
    return few(std::ldexp(in(low, 2.0 * low), octave));
  }
  int below(int end)
  {
    return static_cast<int>(generator_() % static_cast<std::uint64_t>(end));
  }
  int from(int low, int high)
  {
    return low + below(high - low + 1);
  }
  bool chance(double share)
  {
    return in(0.0, 1.0) < share;
  }
  static double few(double value)
  {
    return std::nearbyint(value * 1000.0) / 1000.0;
  }

private:
  std::mt19937_64 generator_;
};

}  // namespace campaign
