#pragma once

#include <vector>

#include "body.h"
#include "complementarity.h"
#include "touch.h"

namespace block_world
{
/// A sum that cancels to less than this share of its terms is zero: what is left is rounding, and would otherwise grow from order to order.
constexpr double kCancelled = 64 * 2.220446049250313e-16;

/// A touch that carries force along an arc.
struct Rest
{
  Touch touch;
  Series force{};  ///< N
  Series along{};  ///< m, of the vertex from the start of the face, where the face ends somewhere
  int degree = 0;  ///< of the arcs; the force's is lower by two
};

/// Points fixed in two bodies (or one in the world) as series: what a spring needs along an arc.
struct SpringSeries
{
  Series from_x{}, from_y{}, to_x{}, to_y{};  ///< arms R p of the two ends
  Series dx{}, dy{};                          ///< from the second end to the first
  Series length{}, ux{}, uy{};                ///< of a spring with a rest length
  bool coincident = false;                    ///< its ends meet at the start
  Series fx{}, fy{};                          ///< force on the first end
};

/// Length and direction of the vector (dx, dy) up to an order, from length^2 = d.d and direction x length = d; values of lower orders are there
/// already. Where the ends meet at the start the length is s |e| with e = d / s, so that the order above is needed of d.
void lengthSeries(const Series& dx, const Series& dy, int order, bool coincident, Series& length, Series& ux, Series& uy);

/// Whether the ends meet: their distance is the rounding of their places.
bool endsMeet(double dx, double dy, double size);

/// Expands the motion of an island, bodies that move as one, into arcs: Taylor series by recurrences, with resting contact enforced on the
/// position at every order (structural analysis of DAEs, Nedialkov & Pryce; no index reduction, hence no drift). One Cholesky factor of
/// A = J M^-1 J^T serves all orders.
class Flow
{
public:
  /// members: state of the island's bodies at start, all movable; rests: their active touches, linearly independent, member indices into
  /// `members` or -1 for a fixed side. Writes the arcs of the bodies and the forces of the rests.
  void expand(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Field& field, const Time& start,
              const std::vector<Member>& members, std::vector<Rest>& rests);

private:
  struct BodyWork
  {
    Series c{}, s{};
    bool rotating = false, trigonometric = false;
    double next_c = 0.0, next_s = 0.0;  ///< order n + 2 without its newest angle coefficient
    double ax = 0.0, ay = 0.0, alpha = 0.0;
    double ax_size = 0.0, ay_size = 0.0, alpha_size = 0.0;
  };
  struct RestWork
  {
    Series nx{}, ny{}, px{}, py{}, dx{}, dy{}, ta{}, tb{};
    int a = -1, b = -1;
  };
  struct LinkWork
  {
    const SpringLink* link = nullptr;
    const MouseSpring* mouse = nullptr;
    int first = -1, second = -1;  ///< work indices; -1 = fixed
    Vec2 first_point = Vec2::Zero(), second_point = Vec2::Zero();
    double stiffness = 0.0, rest_length = 0.0, damping = 0.0;
    SpringSeries series;
    Vec2 world = Vec2::Zero();  ///< the second end where it does not move
  };

  void begin(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Time& start,
             const std::vector<Member>& members, std::vector<Rest>& rests);
  void trigonometry(int n);
  void freeAcceleration(int n);
  void contactGeometry(int n);
  void contactKnown(int n);
  void contactSolve(int n);
  bool store(int n);
  void finish(const std::vector<Body>& bodies, int degree);
  bool endsEarly() const;

  // springs.cpp
  void gatherLinks(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const std::vector<Member>& members);
  void springForce(LinkWork& link, int n);

  const Field* field_ = nullptr;
  std::vector<Body*> body_;
  std::vector<BodyWork> work_;
  std::vector<RestWork> rest_work_;
  std::vector<Rest>* rests_ = nullptr;
  std::vector<LinkWork> links_;
  Cholesky factor_;
  SymmetricMatrix gram_;
  std::vector<double> row_, rhs_, residual_;
};

}  // namespace block_world
