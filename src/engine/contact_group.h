#pragma once

#include <vector>

#include "complementarity.h"
#include "touch.h"

namespace block_world
{
/// A normal velocity below this share of the speeds that make it up is rounding.
constexpr double kSpeedNoise = 1e-13;

/// What bounds the answer of a contact group to an event.
struct ContactScales
{
  double tolerance = 1e-6;      ///< m, the contact shell
  double guard = 1.6e-13;       ///< m, how far a gap may sink below zero before it is an event
  double closed = 1e-13;        ///< m, a gap up to this is zero but for rounding
  bool dissipative = false;     ///< damping or a damper takes energy between impacts
};

/// Bodies that touch at one instant, and what happens to them there: impacts, capture into rest, and which touches carry force afterwards.
///
/// Fixed bodies are members with inverse masses 0.
class ContactGroup
{
public:
  std::vector<Member> members;
  std::vector<Touch> touches;

  ContactGroup()
  {
    members.reserve(4);
    touches.reserve(4);
    provide(4, 4);
  }
  void clear()
  {
    members.clear();
    touches.clear();
    sizes_.clear();
    noise_ = 0.0;
  }

  /// Rows and Gram matrix A = J M^-1 J^T of the present touches, their approach velocities.
  void prepare();

  /// Impacts by staged reflections, then capture of the slow touches that forces press together. Returns the kinetic energy lost.
  /// Fills in impulse, capture, force and active of the touches.
  double collide(const ContactScales& scales);

  /// Whether the last collide pushed anything.
  bool struck() const;

  struct Moves
  {
    double gap = 0.0;       ///< m, the largest that is closed
    double farthest = 0.0;  ///< m, the longest move: the centre's shift and the turn at the radius of gyration
  };
  /// Moves the members as little as possible (mass metric) so that the gaps of the active touches, and those deeper than the resolution, vanish.
  Moves settlePositions(double resolution);

  /// m^2, what settlePositions is to take away: the sum of the squares of those gaps.
  double misfit(double resolution) const;

  /// After settlePositions and with the new geometry: the active touches neither approach nor open. Returns the energy lost.
  double holdActive();

  /// Speed below which a velocity is rounding, m/s.
  double noise() const
  {
    return noise_;
  }

private:
  struct Twist
  {
    Vec2 velocity = Vec2::Zero();
    double omega = 0.0;
  };

  void provide(std::size_t rows, std::size_t bodies);
  double velocityOf(int i) const;
  void push(int i, double impulse);
  void scale(const ContactScales& scales);
  void findSimultaneous();
  void reflect(const std::vector<int>& rows);
  double shareOfRebound(const std::vector<int>& rows);
  void stop();
  void clean();
  bool allLeave() const;
  void measureRates();
  void takeApproaching();
  bool anyElastic(const std::vector<int>& rows) const;
  bool isLocked(const std::vector<int>& rows);

  // capture.cpp
  double accelerationNoise(const Touch& touch) const;
  void planCapture();
  void accelerate();
  void solveRest();
  void solvePlan();
  void plannedSpeeds();
  bool leaveOut();
  void carryOut();
  void capture();

  // standstill.cpp
  void independent(const std::vector<int>& rows, double share);
  void sumChanges(const std::vector<int>& rows, const std::vector<double>& impulses, std::vector<Twist>& changes) const;
  const std::vector<Twist>& velocities();
  double lossSince(const std::vector<Twist>& start);
  bool atRest(const std::vector<int>& rows) const;
  void bringToRest(const std::vector<int>& rows);
  void projectOut(const std::vector<int>& rows);
  void bringToRestWithNeighbours(std::vector<int>& rows, const std::vector<int>& but = {});

  bool settles(const Touch& touch, double resolution) const;
  void place(Member& member, const Vec2& shift, double turn);

  Room rows_room_, members_room_;
  SymmetricMatrix gram_;
  Complementarity solver_;    ///< of impacts
  Complementarity pressing_;  ///< of the forces of what may rest
  Complementarity planned_;   ///< of the impulses that bring the pressed touches to rest and keep the others from approaching then
  Cholesky factor_;
  std::vector<int> all_, approaching_, bouncing_, candidates_, pressed_, others_, plan_, stopped_, independent_, held_;
  std::vector<double> rates_;          ///< m/s, by touch: normal velocities
  std::vector<double> accelerations_;  ///< m/s^2, by candidate touch: free accelerations of the gaps
  std::vector<char> presses_;          ///< by candidate touch: whether its free acceleration presses by more than its rounding
  std::vector<double> depth_;          ///< m, by touch: hops lower than four times this are left out
  std::vector<double> rest_speed_;     ///< m/s, by touch: what is faster cannot be such a hop
  std::vector<double> over_;           ///< by pressed touch: how far its hop would go, against what may be left out
  std::vector<double> worst_;          ///< by member: the largest of these
  std::vector<double> row_, solution_, impulses_;
  std::vector<char> meets_;  ///< by touch: closed, or of a pair that is closed at another vertex
  /// Sums of the absolute values of what made up a member's velocity.
  struct Size
  {
    double x = 0.0, y = 0.0, omega = 0.0;
  };
  std::vector<Size> sizes_;
  std::vector<Twist> changes_, velocities_, start_;  ///< by member
  std::vector<double> speeds_;                       ///< m/s, by member: what the plan changes
  double acceleration_scale_ = 0.0, noise_ = 0.0, closed_ = 0.0;

  /// Workspace of isLocked.
  SymmetricMatrix extended_;
  std::vector<int> extended_rows_;
  std::vector<double> minus_one_;
};

}  // namespace block_world
