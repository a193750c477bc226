#pragma once

#include <cmath>
#include <vector>

#include "body.h"

namespace block_world
{
/// A body at the instant of an event: its pose, twist and free acceleration (without contact forces).
struct Member
{
  int body = -1;
  Frame frame;
  double angle = 0.0;
  Vec2 velocity = Vec2::Zero();
  double omega = 0.0;
  Vec2 acceleration = Vec2::Zero();
  double alpha = 0.0;
  double inverse_mass = 0.0, inverse_inertia = 0.0;

  /// m, radius of gyration of what can move.
  double gyration() const
  {
    return std::sqrt(inverse_mass / inverse_inertia);
  }
};

/// A vertex of body a within the shell of a face of body b. Gap g = n.(x_a + R_a p - x_b) - o; its gradient by the two twists is
/// J_a = (n, r x n), J_b = -(n, d x n), with r = R_a p and d = x_a + r - x_b.
struct Touch
{
  int pair = -1;
  int a = -1, b = -1;        ///< bodies
  int vertex = 0, face = 0;  ///< of a, of b
  bool corner = false;       ///< corner on corner: the normal is the bisector of several faces, good for an impact only
  int member_a = -1, member_b = -1;
  Vec2 normal = Vec2::Zero();  ///< from b to a
  Vec2 arm = Vec2::Zero();     ///< r
  Vec2 reach = Vec2::Zero();   ///< d
  double gap = 0.0;            ///< m
  double separation = 0.0;     ///< m, of the two bodies: more than the gap where another face parts them
  double along = 0.0;          ///< m, from the start of the face, of an endless one from the point nearest to the origin
  double elasticity = 1.0;

  double approach = 0.0;  ///< m/s, normal velocity before the event; negative = approaching
  double impulse = 0.0;   ///< N s, of reflections
  double capture = 0.0;   ///< N s, of the inelastic end
  double force = 0.0;     ///< N
  bool rested = false;    ///< carried force before the event
  bool active = false;    ///< carries force: a constraint of the next arcs
};

/// Whether the two are of the same vertex on the same face.
inline bool sameTouch(const Touch& p, const Touch& q)
{
  return p.a == q.a && p.b == q.b && p.vertex == q.vertex && p.face == q.face;
}

/// Where the touch is with its bodies in these frames: arm, reach, normal (a corner's stays), gap and place along the face.
void locate(Touch& touch, const Body& a, const Frame& frame_a, const Body& b, const Frame& frame_b);

/// (v_a - v_b).n, the rate of the gap.
double normalVelocity(const Touch& touch, const Member& a, const Member& b);
/// g'' at the given accelerations: n.(a_a + alpha_a perp r - w_a^2 r - a_b) - 2 w_b n.perp(d') - alpha_b n.perp(d) - w_b^2 n.d.
double normalAcceleration(const Touch& touch, const Member& a, const Member& b);

/// J_p M^-1 J_q^T: how much an impulse of 1 N s at one touch changes the normal velocity of the other; members by their indices in the touches
/// (-1: immovable).
double contactGram(const Touch& p, const Touch& q, const std::vector<Member>& members);

/// Finds the touches of a pair: vertices within `reach` of a face that separates the bodies best, seen from both bodies.
///
/// Where flat meets flat, parallel within the tolerance, the touches of both faces count, coinciding ones once. Where corner meets corner
/// several faces may separate the bodies equally well. There the feasible motions are the union of the half-spaces of the tied faces, so the bodies are in each other's way only if
/// they approach on every one: then one touch along the bisector is given, else the touches of the face on which they separate most. Where they
/// neither approach nor separate on several, no impact is in their way; what they may rest on is then the face on which the fewest forces press.
class TouchFinder
{
public:
  TouchFinder()
  {
    candidates_.reserve(8);
    found_.reserve(8);
  }
  /// tolerance: m, the contact shell; closed: m, below which a difference of gaps is rounding; still: m/s, the same of velocities; ties: whether
  /// touches on faces that tie in their velocities, too, are wanted.
  void find(const Body& body_a, const Member& a, const Body& body_b, const Member& b, double tolerance,
            std::vector<Touch>& touches, double closed, double still, bool ties);
  /// Whether the last find had to choose between tied faces by the velocities.
  bool velocityDecided() const
  {
    return velocity_decided_;
  }

private:
  struct Candidate
  {
    bool of_first;  ///< face of body a (else of body b)
    int face;
    Vec2 normal;    ///< outward, world
    double gap;
    int cluster;
  };
  void collect(const Body& face_body, const Member& face_member, const Body& vertex_body, const Member& vertex_member, bool of_first);
  void gather(const Candidate& candidate, const Body& face_body, const Member& face_member, const Body& vertex_body,
              const Member& vertex_member, std::vector<Touch>& touches) const;

  double tolerance_ = 0.0;
  std::vector<Candidate> candidates_;
  std::vector<Touch> found_;
  bool velocity_decided_ = false;
};

}  // namespace block_world
