#include "detect.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace block_world
{
namespace
{
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Whether a body's angle changes along its arc.
bool turns(const View& view)
{
  return view.now->omega != 0.0 || view.now->alpha != 0.0 || view.body->arc.degree > 2;
}

/// Latest time up to which g + v s - m s^2 / 2, which opens, is certain to have come back no lower than zero; g may start below.
double backIn(double g, double v, double m)
{
  return m > 0.0 ? (v + std::sqrt(v * v + 2.0 * m * g)) / m : kNever;
}
}  // namespace

double Detector::apart(const Body& a, const Snapshot& now_a, const Body& b, const Snapshot& now_b, double horizon) const
{
  const double jerk = a.arc.jerk + b.arc.jerk;
  double gap, speed, acceleration;
  bool certain_curvature = false;
  if (a.shape->vertices.empty() || b.shape->vertices.empty())
  {
    // Height of the centre over the half-plane, which is exactly a polynomial of the arc's degree.
    const bool wall_is_a = a.shape->vertices.empty();
    const Face& wall = (wall_is_a ? a : b).shape->faces.front();
    const Snapshot& now = wall_is_a ? now_b : now_a;
    gap = wall.normal.dot(now.position) - wall.offset - (wall_is_a ? b : a).shape->radius;
    speed = wall.normal.dot(now.velocity);
    acceleration = wall.normal.dot(now.acceleration);
    certain_curvature = true;
  }
  else
  {
    const Vec2 between = now_b.position - now_a.position;
    const Vec2 relative = now_b.velocity - now_a.velocity;
    const Vec2 relative_acceleration = now_b.acceleration - now_a.acceleration;
    const double reach = a.shape->radius + b.shape->radius;
    const double square = between.squaredNorm();
    if (square <= reach * reach)
      return -1.0;
    const double bound = relative_acceleration.norm();
    if (bound == 0.0 && jerk == 0.0)
    {
      // Straight relative motion: the circles meet where |between + relative s| = reach, or never.
      const double approach = between.dot(relative), v2 = relative.squaredNorm();
      const double discriminant = approach * approach - v2 * (square - reach * reach);
      if (approach >= 0.0 || discriminant < 0.0)
        return horizon;
      const double near = std::sqrt(square) - reach;
      return near < 0.02 * reach ? -1.0 : std::min(horizon, (square - reach * reach) / (std::sqrt(discriminant) - approach));
    }
    const double distance = std::sqrt(square);
    gap = distance - reach;
    speed = between.dot(relative) / distance;
    acceleration = -bound;  // distance'' >= -|relative acceleration|
  }
  const double radius = std::min(a.shape->radius, b.shape->radius);
  if (gap < 0.02 * radius && !(certain_curvature && gap > 0.0 && firstZero(gap, speed, acceleration) == kNever && jerk == 0.0))
    return -1.0;
  if (jerk == 0.0)
    return std::min(horizon, firstZero(gap, speed, acceleration));
  const double first_guess = firstZero(gap, speed, acceleration);
  const double span = std::min(horizon, std::max(2.0 * first_guess, 1e-3 * horizon));
  return std::min(span, firstZero(gap, speed, acceleration - jerk * span));
}

double Detector::within(const Body& body, const Snapshot& now, const Vec2& low, const Vec2& high, double horizon) const
{
  if (std::isinf(high.x()))
    return horizon;
  const auto span = [&](double jerk_span) {
    const double slack = body.arc.jerk > 0.0 ? body.arc.jerk * jerk_span : 0.0;
    double first = horizon;
    for (int axis : { 0, 1 })
    {
      const double x = now.position[axis], v = now.velocity[axis], a = now.acceleration[axis];
      first = std::min(first, x > low[axis] ? firstZero(x - low[axis], v, a - slack) : 0.0);
      first = std::min(first, x < high[axis] ? firstZero(high[axis] - x, -v, -a - slack) : 0.0);
    }
    return first;
  };
  if (body.arc.jerk == 0.0)
    return span(0.0);
  const double reach = std::min(horizon, std::max(2.0 * span(0.0), 1e-3 * horizon));
  return std::min(reach, span(reach));
}

/// Bound of |g''| over the horizon for every vertex of one body and every face of the other:
/// g'' = n.(d'' - alpha perp d - 2 w perp d' - w^2 d), d from the face body's centre to the vertex.
double Detector::curvature(const View& f, const View& v, double horizon) const
{
  const double jerk = f.body->arc.jerk + v.body->arc.jerk;
  const double a = (v.now->acceleration - f.now->acceleration).norm() + (jerk > 0.0 ? jerk * horizon : 0.0);
  const auto spin = [horizon](const View& view, double& omega, double& alpha) {
    const double angular_jerk = view.body->arc.angular_jerk;
    alpha = std::abs(view.now->alpha) + (angular_jerk > 0.0 ? angular_jerk * horizon : 0.0);
    omega = std::abs(view.now->omega) + (alpha > 0.0 ? alpha * horizon : 0.0);
  };
  double w_v, alpha_v, w_f, alpha_f;
  spin(v, w_v, alpha_v);
  spin(f, w_f, alpha_f);
  const double radius = v.body->shape->radius;
  double bound = a + (alpha_v + w_v * w_v) * radius;
  if (w_f > 0.0)
  {
    const double speed = (v.now->velocity - f.now->velocity).norm() + (a > 0.0 ? a * horizon : 0.0);
    const double distance = (v.now->position - f.now->position).norm() + speed * horizon + radius;
    bound += 2.0 * w_f * (speed + w_v * radius) + (alpha_f + w_f * w_f) * distance;
  }
  return bound;
}

void Detector::localSeries(const View& view, bool of_face)
{
  Local& local = of_face ? face_local_ : vertex_local_;
  const Body& body = *view.body;
  local.body = &body;
  local.degree = body.arc.degree;
  local.x.fill(0.0);
  local.y.fill(0.0);
  local.c.fill(0.0);
  local.s.fill(0.0);
  Series angle{};
  if (body.arc.degree <= 2)
  {
    local.x[0] = view.now->position.x();
    local.y[0] = view.now->position.y();
    local.x[1] = view.now->velocity.x();
    local.y[1] = view.now->velocity.y();
    local.x[2] = 0.5 * view.now->acceleration.x();
    local.y[2] = 0.5 * view.now->acceleration.y();
    angle[1] = view.now->omega;
    angle[2] = 0.5 * view.now->alpha;
  }
  else
  {
    const double shift = time_ - body.arc.start;
    local.x = shifted(body.arc.series(&Coefficients::x), body.arc.degree, shift);
    local.y = shifted(body.arc.series(&Coefficients::y), body.arc.degree, shift);
    angle = shifted(body.arc.series(&Coefficients::angle), body.arc.degree, shift);
  }
  local.c[0] = view.frame.cosine;
  local.s[0] = view.frame.sine;
  if (turns(view))
    trigonometricSeries(angle, std::max(2, body.arc.degree), order_, local.c, local.s);
}

/// The gap of one vertex within the shell, as a polynomial: g = N.(X_v + P - X_f) - o.
Detector::Certificate Detector::shell(const Face& face, const Vec2& vertex, double gap, const View& f, const View& v, double horizon)
{
  if (face_local_.body != f.body)
    localSeries(f, true);
  if (vertex_local_.body != v.body)
    localSeries(v, false);
  // Where nothing turns the gap has the degree of the arcs.
  const bool face_turns = turns(f), vertex_turns = turns(v);
  const int order = face_turns || vertex_turns ? order_ : std::max(face_local_.degree, vertex_local_.degree);
  Series nx, ny, dx, dy, g{};
  for (int k = 0; k <= order; ++k)
  {
    nx[k] = face_local_.c[k] * face.normal.x() - face_local_.s[k] * face.normal.y();
    ny[k] = face_local_.s[k] * face.normal.x() + face_local_.c[k] * face.normal.y();
    dx[k] = vertex_local_.x[k] - face_local_.x[k] + vertex_local_.c[k] * vertex.x() - vertex_local_.s[k] * vertex.y();
    dy[k] = vertex_local_.y[k] - face_local_.y[k] + vertex_local_.s[k] * vertex.x() + vertex_local_.c[k] * vertex.y();
  }
  for (int k = 0; k <= order; ++k)
    g[k] = face_turns ? cauchy(nx, dx, k) + cauchy(ny, dy, k) : nx[0] * dx[k] + ny[0] * dy[k];
  g[0] = gap;

  // Directions keep their digits up to a turn of one radian, of a quarter with half the orders: turn^(order + 1) / (order + 1)!.
  const double most = order_ == kOrder ? 1.0 : 0.25;
  const double turn = std::max(std::abs(f.now->omega), std::abs(v.now->omega));
  const double twist = std::max(std::abs(f.now->alpha), std::abs(v.now->alpha));
  double span = horizon;
  if (turn > 0.0)
    span = std::min(span, most / turn);
  if (twist > 0.0)
    span = std::min(span, std::sqrt(most / twist));
  if (std::isinf(span))
  {
    // Nothing turns and nothing ends: a parabola, which from zero either opens by more than can be resolved or is guarded a level below.
    const bool opens = gap > resolution_ || (g[1] > 0.0 && g[1] * g[1] > -4.0 * resolution_ * g[2]);
    const double zero = firstZero(opens ? std::max(gap, 0.0) : guard_, g[1], 2.0 * g[2]);
    return { zero, zero < kNever };
  }
  if (gap > resolution_)
  {
    const double zero = firstBelow(g, order, span, 0.0);
    return zero < kNever ? Certificate{ zero, true } : Certificate{ span, false };
  }
  // From zero the gap may open like s, s^2 or s^3, and rounding hides its first coefficients: guard a level below, then go back to the last zero
  // from above if the gap did open in between.
  double end = firstBelow(g, order, span, std::min(gap, 0.0) - guard_);
  if (end == kNever)
    return { span, false };
  constexpr int kLooks = 16;
  for (int i = kLooks - 1; i >= 1; --i)
  {
    double low = end * i / kLooks;
    if (evaluate(g, order, low) <= resolution_)
      continue;
    const double after = firstBelow(shifted(g, order, low), order, end - low, 0.0);
    if (after < kNever)
      end = low + after;
    break;
  }
  return { end, true };
}

Detector::Certificate Detector::face(const Pair& pair, bool of_a, int index, const View& f, const View& v, double horizon)
{
  const Face& face = f.body->shape->faces[index];
  const Vec2 normal = f.frame.rotate(face.normal);
  const Vec2 between = v.now->position - f.now->position;
  const Vec2 relative = v.now->velocity - f.now->velocity;
  const auto& vertices = v.body->shape->vertices;
  open_.clear();
  for (std::size_t k = 0; k < vertices.size(); ++k)
  {
    if (pair.resting.contains({ of_a, static_cast<unsigned>(index), static_cast<int>(k) }))
      continue;
    const Vec2 arm = v.frame.rotate(vertices[k]);
    const Vec2 d = between + arm;
    open_.push_back({ static_cast<int>(k), normal.dot(d) - face.offset,
                      normal.dot(relative + v.now->omega * perp(arm) - f.now->omega * perp(d)) });
  }

  // The bound of the curvature over twice the span that the bound at this instant suggests.
  const double bound_now = curvature(f, v, 0.0);
  // Those in the shell that do not leave it at once have no need of a bound.
  double span = kNever;
  for (const Open& o : open_)
    if (o.gap > 0.5 * tolerance_ || (o.rate > 0.0 && o.rate * o.rate > 2.0 * bound_now * tolerance_))
      span = std::min(span, firstZero(std::max(o.gap, 0.5 * tolerance_), o.rate, -bound_now));
  span = std::min(horizon, 2.0 * std::max(span, std::sqrt(tolerance_ / (bound_now + 1e-300))));
  const double bound = std::isinf(span) ? bound_now : curvature(f, v, span);

  Certificate certificate{ horizon, false };
  for (const Open& o : open_)
  {
    Certificate one{ kNever, false };
    if (o.gap > 0.5 * tolerance_)
      one.span = std::min(span, firstZero(o.gap - 0.25 * tolerance_, o.rate, -bound));  // into the shell, not through it
    else if (o.rate > 0.0 && o.rate * o.rate > 2.0 * bound * tolerance_)
      one.span = std::min(span, backIn(o.gap - 0.25 * tolerance_, o.rate, bound));
    else
      one = shell(face, vertices[o.vertex], o.gap, f, v, horizon);
    if (one.span < certificate.span || (one.span == certificate.span && one.contact))
      certificate = one;
  }
  return certificate;
}

/// Where nothing turns and both accelerate alike every gap changes at a constant rate: the bodies meet when the last of the closing gaps is
/// closed, if none of the others is open by then. Returns whether that decides; not where gaps close and open within the tolerance of each
/// other, and not where so long a way has been gone by then that the gap is off by more than coordinates resolve.
bool Detector::closing(Pair& pair, const View& a, const View& b, double horizon, Certificate& certificate)
{
  const Vec2 relative = b.now->velocity - a.now->velocity;
  const Side* last = nullptr;
  double span = 0.0;
  for (Side& side : sides_)
  {
    const View& f = side.of_a ? a : b;
    const double rate = f.frame.rotate(f.body->shape->faces[side.face].normal).dot(relative);
    side.rate = side.of_a ? rate : -rate;
    if (side.rate < 0.0 && side.gap > -side.rate * span)
    {
      span = side.gap / -side.rate;
      last = &side;
    }
  }
  certificate = { horizon, false };
  if (last == nullptr || span >= horizon)
    return true;
  double opened = -kNever;
  for (const Side& side : sides_)
    if (side.rate >= 0.0)
      opened = std::max(opened, side.gap + side.rate * span);
  if (opened > tolerance_)
    return true;
  if (opened > -tolerance_ || std::numeric_limits<double>::epsilon() * relative.norm() * span > resolution_)
    return false;
  pair.face_of_a = last->of_a;
  pair.face = last->face;
  certificate = { span, true };
  return true;
}

double Detector::certify(Pair& pair, const View& a, const View& b, const Time& time, double horizon)
{
  time_ = time;
  const int degree = std::max(a.body->arc.degree, b.body->arc.degree);
  order_ = degree > 2 && degree <= kLowOrder ? kLowOrder : kOrder;
  pair.contact_due = false;
  face_local_.body = vertex_local_.body = nullptr;
  const bool straight = !turns(a) && !turns(b) && a.now->acceleration == b.now->acceleration;
  if (pair.face >= 0 && !straight)
  {
    const View &f = pair.face_of_a ? a : b, &v = pair.face_of_a ? b : a;
    const double gap = faceGap(f.body->shape->faces[pair.face], f.frame, *v.body->shape, v.frame);
    if (gap > tolerance_ && gap > 0.5 * pair.face_gap)
      return face(pair, pair.face_of_a, pair.face, f, v, horizon).span;
  }
  sides_.clear();
  for (int side = 0; side < 2; ++side)
  {
    const View &f = side == 0 ? a : b, &v = side == 0 ? b : a;
    const Polygon &face_shape = *f.body->shape, &vertex_shape = *v.body->shape;
    if (!vertex_shape.vertices.empty())
      for (std::size_t i = 0; i < face_shape.faces.size(); ++i)
        sides_.push_back({ side == 0, static_cast<int>(i), faceGap(face_shape.faces[i], f.frame, vertex_shape, v.frame), 0.0 });
  }
  const auto best = std::max_element(sides_.begin(), sides_.end(), [](const Side& p, const Side& q) { return p.gap < q.gap; });
  pair.face_of_a = best->of_a;
  pair.face = best->face;
  pair.face_gap = best->gap;
  if (best->gap > 0.5 * tolerance_)
  {
    Certificate certificate;
    if (!straight || !closing(pair, a, b, horizon, certificate))
      certificate = face(pair, pair.face_of_a, pair.face, pair.face_of_a ? a : b, pair.face_of_a ? b : a, horizon);
    pair.contact_due = certificate.contact;
    return certificate.span;
  }

  // In the shell several faces may separate the bodies; they stay apart as long as one of them does.
  const double least = std::min(best->gap, 0.0) - 2.0 * guard_;
  Certificate longest{ -1.0, false };
  for (const Side& side : sides_)
  {
    if (side.gap < least)
      continue;
    const Certificate one = face(pair, side.of_a, side.face, side.of_a ? a : b, side.of_a ? b : a, horizon);
    if (one.span > longest.span)
    {
      longest = one;
      pair.face_of_a = side.of_a;
      pair.face = side.face;
    }
  }
  pair.contact_due = longest.contact;
  return longest.span;
}

}  // namespace block_world
