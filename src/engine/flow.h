#pragma once

#include <vector>

#include "body.h"
#include "cholesky.h"
#include "touch.h"

namespace block_world
{
/// A touch that carries force along an arc.
struct Rest
{
  Touch touch;
  Series force{};  ///< N
  Series along{};  ///< m, of the vertex from the start of the face, where the face ends somewhere
  int degree = 0;  ///< of the arcs; the force's is lower by two
};

/// Work along the arcs of an island since their start, J.
struct Work
{
  int degree = 0;  ///< 0: nothing works
  ProductSeries series{};

  double after(double span) const
  {
    return degree > 0 ? evaluate(series, degree, span) : 0.0;
  }
};

struct Works
{
  Work thrust;  ///< done by thrusters and wrenches
  Work loss;    ///< taken by damping and by the dampers of springs
};

/// Points fixed in two bodies (or one in the world) as series: what a spring needs along an arc. Scalars stand twice, to multiply vectors.
struct SpringSeries
{
  VectorSeries from, to;    ///< arms R p of the two ends
  VectorSeries d;           ///< from the second end to the first
  VectorSeries rate;        ///< n d[n]
  VectorSeries length;      ///< of a spring with a rest length
  VectorSeries u;           ///< and its direction
  bool coincident = false;  ///< its ends meet at the start: their distance is the rounding of their places
  double inverse = 0.0;     ///< of the first coefficient of the length; 0 where that is
  Vec2 lengthening;         ///< of the newest order: derivative of the length times the direction
  Vec2 force;               ///< and that on the first end
  VectorSeries turned;      ///< forces turned by -90 degrees: arm times this is the torque
};

/// Expands the motion of an island, bodies that move as one, into arcs: Taylor series by recurrences, with resting contact enforced on the
/// position at every order (structural analysis of DAEs, Nedialkov & Pryce; no index reduction, hence no drift). One Cholesky factor of
/// A = J M^-1 J^T serves all orders.
class Flow
{
public:
  /// members: state of the island's bodies at start, all movable; rests: their active touches, linearly independent, member indices into
  /// `members` or -1 for a fixed side; order: the highest of the arcs. Writes the arcs of the bodies, the forces of the rests and the works.
  void expand(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Field& field, const Time& start, int order,
              const std::vector<Member>& members, std::vector<Rest>& rests, Works& works);

private:
  /// With the accelerations of the newest order, and the sums of the absolute values of their terms.
  struct BodyWork
  {
    Body* body = nullptr;
    VectorSeries place;      ///< of the centre
    VectorSeries direction;  ///< cosine and sine of the angle since the start
    VectorSeries rate;       ///< n angle[n], twice
    bool rotating = false, trigonometric = false, pushed = false;
    double inverse_mass = 0.0, inverse_inertia = 0.0;
    Vec2 known = Vec2::Zero();  ///< direction two orders on, without its angle coefficient
    Vec2 push = Vec2::Zero();   ///< at the start, in the world
    Vec2 a = Vec2::Zero(), a_size = Vec2::Zero();
    double alpha = 0.0, alpha_size = 0.0;

    void act(const Vec2& force, const Vec2& force_size, double torque, double torque_size)
    {
      a += inverse_mass * force;
      a_size += inverse_mass * force_size;
      alpha += inverse_inertia * torque;
      alpha_size += inverse_inertia * torque_size;
    }
  };
  struct RestWork
  {
    VectorSeries normal, arm, reach;
    VectorSeries turned;  ///< normals turned by -90 degrees: arm times this is the torque of 1 N
    VectorSeries levers;  ///< these torques on a and on b
    VectorSeries force;   ///< twice
    Vec2 along = Vec2::Zero();  ///< parts of arm and reach along the normal, at the start
    int a = -1, b = -1;
  };
  struct LinkWork
  {
    int first = -1, second = -1;  ///< work indices; second may be -1 = fixed
    double stiffness = 0.0, rest_length = 0.0, damping = 0.0;
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< arms at the start
    Vec2 world = Vec2::Zero();                    ///< the second end where it does not move
    SpringSeries series;
  };

  void begin(std::vector<Body>& bodies, const std::vector<SpringLink>& links, const Time& start,
             const std::vector<Member>& members, std::vector<Rest>& rests);
  void freeAcceleration(int n);
  void placeRests(int n);
  void findLevers(RestWork& rest, int n);
  void push(const RestWork& rest, const SizedSum& force, const SizedSum& torque);
  void press(RestWork& rest, int n, double force);
  void contactKnown(int n);
  double turning(const RestWork& rest, int n) const;
  double opening(const RestWork& rest) const;
  void contactSolve(int n);
  bool store(int n);
  bool endsEarly() const;
  bool turns(const RestWork& rest) const
  {
    return rest.b >= 0 && work_[rest.b].rotating;
  }

  // horizon.cpp: how long the arcs last, and what follows from them
  double horizon(int degree) const;
  void finish(const std::vector<Body>& bodies, int degree);
  void findWorks(int degree, Works& works);

  // springs.cpp
  void gatherLinks(const std::vector<Body>& bodies, const std::vector<SpringLink>& links, const std::vector<Member>& members);
  void springForce(LinkWork& link, int n) const;
  void placeEnds(LinkWork& link, int n) const;
  void pull(LinkWork& link, int n);

  Room members_room_, rests_room_;
  const Field* field_ = nullptr;
  std::vector<BodyWork> work_;
  std::vector<RestWork> rest_work_;
  std::vector<Rest>* rests_ = nullptr;
  std::vector<LinkWork> links_;
  Cholesky factor_;
  std::vector<double> row_, forces_, turning_;
};

}  // namespace block_world
