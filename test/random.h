#pragma once

#include <Eigen/Core>

#include <random>

namespace block_world
{
/// Reproducible numbers: the same on every machine.
class Random
{
public:
  explicit Random(unsigned seed) : generator_(seed)
  {
  }
  double in(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0);
  }
  Eigen::Vector2d vector(double size)
  {
    const double x = in(-size, size);
    return Eigen::Vector2d(x, in(-size, size));
  }
  int below(int end)
  {
    return static_cast<int>(generator_() % static_cast<unsigned>(end));
  }

private:
  std::mt19937 generator_;
};

}  // namespace block_world
