#pragma once

#include <random>

#include "case.h"

namespace block_world::speed
{
/// Makes random versions of a scene: every number within a share of its nominal value. Seed 0 leaves all as they are.
class Variation
{
public:
  explicit Variation(unsigned seed) : random_(seed != 0), generator_(seed)
  {
  }
  /// nominal x (1 - share ... 1 + share)
  double operator()(double nominal, double share)
  {
    return nominal * (1.0 + (random_ ? share * in(-1.0, 1.0) : 0.0));
  }
  /// For what has no nominal value.
  double in(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0);
  }

private:
  bool random_;
  std::mt19937 generator_;
};

/// A scene family and the few words that choose it on the command line.
struct Family
{
  std::string name;
  bool quick;  ///< in the short form
  std::function<Case(Variation&)> make;
};

/// In the order of the report.
std::vector<Family> families();

// One file for each.
void addSingles(std::vector<Family>& families);   // one block
void addContacts(std::vector<Family>& families);  // blocks that touch one another or walls and stay there
void addCrowds(std::vector<Family>& families);    // many blocks

// What the files share.
Block box(double width, double height, double x, double y, double angle = 0.0);
Block moving(Block block, double vx, double vy, double omega = 0.0);
/// Names the blocks and completes the scene.
Scene finished(Scene scene, const std::string& name);

}  // namespace block_world::speed
