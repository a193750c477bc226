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
  const Resting& first() const
  {
    return ones_.front();
  }
  /// Whether this holds for any two of them.
  template <class Condition>
  bool anyTwo(const Condition& condition) const
  {
    for (std::size_t i = 1; i < ones_.size() && ones_[i].vertex >= 0; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (condition(ones_[i], ones_[j]))
          return true;
    return false;
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

/// Whether the vertices that rest keep the bodies from turning against each other: two on one face, or one on a face of either that ends at the other.
bool restsFlat(const Pair& pair, const Polygon& a, const Polygon& b);

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
    // Of most polygons.
    open_.reserve(8);
    sides_.reserve(16);
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
  /// Series of a body about the instant of a look: of its centre, and of the cosine and sine of its angle.
  struct Local
  {
    const Body* body = nullptr;
    int order = 0;
    Series x{}, y{}, c{}, s{};
  };
  /// A vertex that nothing holds on the face.
  struct Open
  {
    int vertex;
    double gap, rate;
  };
  double curvature(const View& face_view, const View& vertex_view, double radius, double horizon) const;
  double roundAbove(double gap, double rate, const View& face_view, const View& vertex_view, double horizon) const;
  Certificate face(const Pair& pair, bool of_a, int face, const View& face_view, const View& vertex_view, double horizon);
  double upright(const Resting& one, const View& face_view, const View& vertex_view, double horizon) const;
  void findSides(const View& face_view, const View& vertex_view, bool of_a, double least);
  bool closing(Pair& pair, const View& a, const View& b, double horizon, Certificate& certificate);
  Certificate parabola(const Vec2& normal, const Open& open, const View& face_view, const View& vertex_view, double horizon) const;
  Certificate shell(const Face& face, const Vec2& vertex, double gap, const View& face_view, const View& vertex_view, double horizon);
  void localSeries(const View& view, int order, Local& local) const;

  double tolerance_ = 1e-6, resolution_ = 1e-14;
  double guard_ = 1e-13;
  Time time_;
  Local face_local_, vertex_local_;
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
