#include "touch.h"

#include <algorithm>
#include <limits>

namespace block_world
{
void locate(Touch& touch, const Body& a, const Frame& frame_a, const Body& b, const Frame& frame_b)
{
  const Face& face = b.shape->faces[touch.face];
  touch.arm = frame_a.rotate(a.shape->vertices[touch.vertex]);
  touch.reach = frame_a.position - frame_b.position + touch.arm;
  if (!touch.corner)
    touch.normal = frame_b.rotate(face.normal);
  touch.gap = touch.normal.dot(touch.reach) - face.offset;
  const Vec2 start = std::isinf(face.length) ? Vec2(Vec2::Zero()) : frame_b.rotate(b.shape->vertices[touch.face]);
  touch.along = perp(touch.normal).dot(touch.reach - start);
}

double normalVelocity(const Touch& touch, const Member& a, const Member& b)
{
  return touch.normal.dot(a.velocity + a.omega * perp(touch.arm) - b.velocity - b.omega * perp(touch.reach));
}

double normalAcceleration(const Touch& touch, const Member& a, const Member& b)
{
  const Vec2 point_rate = a.velocity + a.omega * perp(touch.arm) - b.velocity;  // d'
  const Vec2 point = a.acceleration + a.alpha * perp(touch.arm) - a.omega * a.omega * touch.arm - b.acceleration;
  return touch.normal.dot(point - 2.0 * b.omega * perp(point_rate) - b.alpha * perp(touch.reach) -
                          b.omega * b.omega * touch.reach);
}

double contactGram(const Touch& p, const Touch& q, const std::vector<Member>& members)
{
  // Sum over the shared bodies; a body enters a touch as (n, r x n) on side a, as -(n, d x n) on side b.
  double sum = 0.0;
  const auto add = [&](int member, const Vec2& lever_p, double sign_p) {
    if (member < 0 || members[member].inverse_mass == 0.0)
      return;
    const Member& m = members[member];
    const auto with = [&](const Vec2& lever_q, double sign_q) {
      sum += sign_p * sign_q *
             (m.inverse_mass * p.normal.dot(q.normal) + m.inverse_inertia * cross(lever_p, p.normal) * cross(lever_q, q.normal));
    };
    if (q.member_a == member)
      with(q.arm, 1.0);
    if (q.member_b == member)
      with(q.reach, -1.0);
  };
  add(p.member_a, p.arm, 1.0);
  add(p.member_b, p.reach, -1.0);
  return sum;
}

void TouchFinder::collect(const Body& face_body, const Member& face_member, const Body& vertex_body,
                          const Member& vertex_member, bool of_first)
{
  const Polygon& vertex_shape = *vertex_body.shape;
  if (vertex_shape.vertices.empty())
    return;
  const auto& faces = face_body.shape->faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const double gap = faceGap(faces[f], face_member.frame, vertex_shape, vertex_member.frame);
    if (!candidates_.empty() && gap < candidates_.front().gap - tolerance_)
      continue;
    const Candidate candidate{ of_first, static_cast<int>(f), face_member.frame.rotate(faces[f].normal), gap, -1 };
    if (!candidates_.empty() && gap > candidates_.front().gap)
      candidates_.insert(candidates_.begin(), candidate);
    else
      candidates_.push_back(candidate);
  }
}

void TouchFinder::gather(const Candidate& candidate, const Body& face_body, const Member& face_member,
                         const Body& vertex_body, const Member& vertex_member, std::vector<Touch>& touches) const
{
  const Face& face = face_body.shape->faces[candidate.face];
  for (std::size_t k = 0; k < vertex_body.shape->vertices.size(); ++k)
  {
    Touch touch;
    touch.vertex = static_cast<int>(k);
    touch.face = candidate.face;
    locate(touch, vertex_body, vertex_member.frame, face_body, face_member.frame);
    if (touch.gap > 0.5 * tolerance_)
      continue;
    const bool endless = std::isinf(face.length);
    if (!endless && (touch.along < -0.5 * tolerance_ || touch.along > face.length + 0.5 * tolerance_))
      continue;
    touch.a = vertex_member.body;
    touch.b = face_member.body;
    touch.separation = candidates_.front().gap;
    touch.elasticity = std::min(face_body.elasticity, vertex_body.elasticity);
    touches.push_back(touch);
  }
}

void TouchFinder::find(const Body& body_a, const Member& a, const Body& body_b, const Member& b, double tolerance,
                       std::vector<Touch>& touches, double closed, double still, bool ties)
{
  const auto speed = [](const Body& body, const Member& m) {
    return m.velocity.norm() + (m.omega == 0.0 ? 0.0 : std::abs(m.omega) * body.shape->radius);
  };
  still = std::max(still, 1e-13 * (speed(body_a, a) + speed(body_b, b)));
  velocity_decided_ = false;
  tolerance_ = tolerance;
  candidates_.clear();
  collect(body_a, a, body_b, b, true);
  collect(body_b, b, body_a, a, false);
  if (candidates_.empty() || candidates_.front().gap > 0.5 * tolerance)
    return;
  const double best = candidates_.front().gap;
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& c) { return c.gap < best - tolerance; }),
                    candidates_.end());

  // Clusters of parallel faces; two faces are parallel if turning one into the other moves no point of the shorter by more than the shell.
  int clusters = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
  {
    Candidate& c = candidates_[i];
    const Vec2 outward = c.of_first ? c.normal : Vec2(-c.normal);
    const Face& face = (c.of_first ? body_a : body_b).shape->faces[c.face];
    for (std::size_t j = 0; j < i && c.cluster < 0; ++j)
    {
      const Candidate& other = candidates_[j];
      const Vec2 other_outward = other.of_first ? other.normal : Vec2(-other.normal);
      const Face& other_face = (other.of_first ? body_a : body_b).shape->faces[other.face];
      if (outward.dot(other_outward) > 0.0 &&
          std::abs(cross(outward, other_outward)) * std::min(face.length, other_face.length) <= 2.0 * tolerance)
        c.cluster = other.cluster;
    }
    if (c.cluster < 0)
      c.cluster = clusters++;
  }

  const std::size_t first = touches.size();
  double best_velocity = -std::numeric_limits<double>::infinity(), best_acceleration = best_velocity;
  bool undecided = false;
  Vec2 bisector = Vec2::Zero();
  Touch corner;
  bool any = false;
  for (int cluster = 0; cluster < clusters; ++cluster)
  {
    found_.clear();
    Vec2 normal_sum = Vec2::Zero();
    // Candidates come with the largest gap in front, and so do the clusters.
    bool tied = false;
    for (const Candidate& c : candidates_)
      tied = tied || (c.cluster == cluster && c.gap >= best - closed);
    if (any && !tied)
      continue;
    for (const Candidate& c : candidates_)
    {
      if (c.cluster != cluster)
        continue;
      if (c.of_first)
        gather(c, body_a, a, body_b, b, found_);
      else
        gather(c, body_b, b, body_a, a, found_);
      normal_sum += c.of_first ? Vec2(-c.normal) : c.normal;  // from b to a
    }
    if (found_.empty())
      continue;
    double velocity = std::numeric_limits<double>::infinity(), acceleration = velocity;
    for (const Touch& touch : found_)
    {
      const bool straight = touch.a == a.body;
      velocity = std::min(velocity, normalVelocity(touch, straight ? a : b, straight ? b : a));
      acceleration = std::min(acceleration, normalAcceleration(touch, straight ? a : b, straight ? b : a));
    }
    bisector += normal_sum.normalized();
    const bool level = any && std::abs(velocity - best_velocity) <= still;
    undecided = level || (undecided && velocity < best_velocity);
    if (!any || (level ? acceleration > best_acceleration : velocity > best_velocity))
    {
      best_velocity = velocity;
      best_acceleration = acceleration;
      corner = found_.front();
      touches.resize(first);
      touches.insert(touches.end(), found_.begin(), found_.end());
    }
    velocity_decided_ = velocity_decided_ || any;
    any = true;
  }
  if (undecided && std::abs(best_velocity) <= still && !ties)
  {
    touches.resize(first);
    return;
  }
  if (velocity_decided_ && best_velocity < -still && bisector.squaredNorm() > 1e-6)
  {
    corner.corner = true;
    corner.normal = corner.a == a.body ? Vec2(bisector.normalized()) : Vec2(-bisector.normalized());
    touches.resize(first);
    touches.push_back(corner);
    return;
  }

  // One touch of two that coincide, vertex on vertex, is enough: keep the one whose vertex lies within the face. Where that is rounding, that of the
  // lighter body, whatever the order of blocks and vertices.
  const auto inside = [&](const Touch& t) {
    const Face& face = (t.b == b.body ? body_b : body_a).shape->faces[t.face];
    return std::min(t.along, face.length - t.along);
  };
  const auto lighter = [&](const Touch& p, const Touch& q) {
    const double of_p = (p.a == a.body ? a : b).inverse_mass, of_q = (q.a == a.body ? a : b).inverse_mass;
    return of_p == of_q ? inside(p) > inside(q) : of_p > of_q;
  };
  for (std::size_t i = first; i < touches.size(); ++i)
    for (std::size_t j = i + 1; j < touches.size();)
    {
      const Touch &p = touches[i], &q = touches[j];
      const Vec2 at_p = (p.a == a.body ? a : b).frame.position + p.arm;
      const Vec2 at_q = (q.a == a.body ? a : b).frame.position + q.arm;
      if (p.a == q.a || (at_p - at_q).squaredNorm() > 4.0 * tolerance * tolerance)
      {
        ++j;
        continue;
      }
      const double deeper = inside(q) - inside(p);
      if (deeper > closed || (deeper >= -closed && lighter(q, p)))
        touches[i] = touches[j];
      touches.erase(touches.begin() + j);
    }
}

}  // namespace block_world
