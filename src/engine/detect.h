#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "body.h"

namespace block_world
{
/// A vertex that rests on a face: their gap is kept zero by the arcs and needs no guard.
struct Resting
{
  unsigned face_of_a : 1, face : 31;
  int vertex;

  bool operator==(const Resting& other) const
  {
    return face_of_a == other.face_of_a && face == other.face && vertex == other.vertex;
  }
};

/// What rests of a pair: as rests are independent of each other, no more than two bodies have freedoms against each other. Memory is fixed.
class RestingOnes
{
public:
  void clear()
  {
    ones_.fill(kNone);
  }
  bool empty() const
  {
    return ones_.front().vertex < 0;
  }
  void add(const Resting& one)
  {
    const auto free = std::find(ones_.begin(), ones_.end(), kNone);
    if (free != ones_.end())
      *free = one;
  }
  bool contains(const Resting& one) const
  {
    return !empty() && std::find(ones_.begin(), ones_.end(), one) != ones_.end();
  }

  template <class A>
  void exchange(A& archive)
  {
    for (Resting& one : ones_)
    {
      int side = one.face_of_a, face = one.face;
      archive(side, face, one.vertex);
      one.face_of_a = side;
      one.face = face;
    }
  }

private:
  static constexpr Resting kNone{ 0, 0, -1 };

  std::array<Resting, 3> ones_{ kNone, kNone, kNone };
};

/// Two bodies that may meet; at least one of them can move. In the list of pairs of either of them.
struct alignas(kCacheLine) Pair
{
  int a = -1, b = -1;
  std::array<int, 2> next{ -1, -1 }, previous{ -1, -1 };  ///< in the list of a, in that of b
  double face_gap = 0.0;                                  ///< m, when the face was chosen
  int face = -1;                                          ///< the face that was last seen to separate the bodies
  RestingOnes resting;
  bool face_of_a = true;
  bool contact_due = false;  ///< the promise ends with a contact, not with a new look

  int side(int body) const
  {
    return body == a ? 0 : 1;
  }
  int nextOf(int body) const
  {
    return next[side(body)];
  }
  int other(int body) const
  {
    return body == a ? b : a;
  }
};

static_assert(sizeof(Pair) == kCacheLine, "a pair is a line of the cache");

/// One body as the detector sees it at an instant.
struct View
{
  const Body* body = nullptr;
  const Snapshot* now = nullptr;
  Frame frame;
};

/// Promises that two bodies do not meet before a certain time, without sampling.
///
/// In the plane two convex bodies are disjoint exactly if a face of one of them separates them. The gap of a vertex over a face has a second
/// derivative that the arcs bound, so a one-sided Newton step (Bannerman et al. 2011) never passes its zero and converges quadratically.
/// Within the contact shell the gap itself is expanded as a polynomial, whose first zero is found rigorously.
class Detector
{
public:
  /// tolerance: the contact shell; resolution: what the coordinates resolve, both in m.
  void configure(double tolerance, double resolution)
  {
    tolerance_ = tolerance;
    resolution_ = resolution;
    guard_ = std::min(0.25 * tolerance, 16.0 * resolution);
  }

  /// m; a gap that is zero but for rounding is guarded this far below: above its rounding, far below the tolerance.
  double guard() const
  {
    return guard_;
  }

  /// Cheap part of the promise: span in s for which the circles (or circle and half-plane) stay apart; negative if they are near.
  double apart(const Body& a, const Snapshot& now_a, const Body& b, const Snapshot& now_b, double horizon) const;

  /// Span in s, at most horizon, for which a body's centre is certified to stay within a box.
  double within(const Body& body, const Snapshot& now, const Vec2& low, const Vec2& high, double horizon) const;

  /// Span in s, at most horizon, for which the pair is certified not to meet; sets pair.contact_due if it meets then.
  double certify(Pair& pair, const View& a, const View& b, const Time& time, double horizon);

private:
  struct Certificate
  {
    double span;
    bool contact;
  };
  double curvature(const View& face_view, const View& vertex_view, double horizon) const;
  Certificate face(const Pair& pair, bool of_a, int face, const View& face_view, const View& vertex_view, double horizon);
  bool closing(Pair& pair, const View& a, const View& b, double horizon, Certificate& certificate);
  Certificate shell(const Face& face, const Vec2& vertex, double gap, const View& face_view, const View& vertex_view, double horizon);
  void localSeries(const View& view, bool of_face);

  double tolerance_ = 1e-6, resolution_ = 1e-14;
  double guard_ = 1e-13;
  Time time_;
  int order_ = kOrder;  ///< of the gaps where something turns: as of the arcs
  struct Local
  {
    const Body* body = nullptr;
    int degree = 0;
    Series x{}, y{}, c{}, s{};
  };
  Local face_local_, vertex_local_;
  /// A vertex that nothing holds on the face.
  struct Open
  {
    int vertex;
    double gap, rate;
  };
  std::vector<Open> open_;
  /// A face and the gap that it leaves.
  struct Side
  {
    bool of_a;
    int face;
    double gap, rate;
  };
  std::vector<Side> sides_;
};

}  // namespace block_world
