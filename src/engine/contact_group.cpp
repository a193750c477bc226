#include "contact_group.h"

#include <algorithm>
#include <cmath>

namespace block_world
{
double ContactGroup::velocityOf(int i) const
{
  const Touch& t = touches[i];
  return normalVelocity(t, members[t.member_a], members[t.member_b]);
}

/// Equations (7)-(10): the impulse along the normal on a, its opposite on b.
void ContactGroup::push(int i, double impulse)
{
  const Touch& t = touches[i];
  Member &a = members[t.member_a], &b = members[t.member_b];
  a.velocity += impulse * a.inverse_mass * t.normal;
  a.omega += impulse * a.inverse_inertia * cross(t.arm, t.normal);
  b.velocity -= impulse * b.inverse_mass * t.normal;
  b.omega -= impulse * b.inverse_inertia * cross(t.reach, t.normal);
  const auto grow = [&](Size& size, const Member& m, const Vec2& lever) {
    size.x += std::abs(impulse * m.inverse_mass * t.normal.x());
    size.y += std::abs(impulse * m.inverse_mass * t.normal.y());
    size.omega += std::abs(impulse * m.inverse_inertia * cross(lever, t.normal));
  };
  grow(sizes_[t.member_a], a, t.arm);
  grow(sizes_[t.member_b], b, t.reach);
}

/// A velocity whose parts cancel to rounding is zero: it would only breed turns and drifts too small to mean anything.
void ContactGroup::clean()
{
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    Member& m = members[i];
    if (std::abs(m.velocity.x()) <= kCancelled * sizes_[i].x)
      m.velocity.x() = 0.0;
    if (std::abs(m.velocity.y()) <= kCancelled * sizes_[i].y)
      m.velocity.y() = 0.0;
    if (std::abs(m.omega) <= kCancelled * sizes_[i].omega)
      m.omega = 0.0;
  }
}

/// Memory for so many touches of so many members. For those of most events it is there from the start, so that the first hit takes no longer.
void ContactGroup::provide(std::size_t rows, std::size_t bodies)
{
  rows_room_.provide(rows, all_, approaching_, bouncing_, candidates_, pressed_, others_, plan_, stopped_, independent_, held_, extended_rows_,
                     rates_, depth_, rest_speed_, over_, accelerations_, row_, solution_, impulses_, minus_one_, meets_, presses_);
  members_room_.provide(bodies, sizes_, changes_, velocities_, start_, speeds_, worst_);
}

void ContactGroup::prepare()
{
  const int n = static_cast<int>(touches.size());
  provide(touches.size(), members.size());
  gram_.resize(n);
  sizes_.resize(members.size());
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j <= i; ++j)
      gram_(i, j) = gram_(j, i) = contactGram(touches[i], touches[j], members);
    touches[i].approach = velocityOf(i);
  }
}

void ContactGroup::scale(const ContactScales& scales)
{
  acceleration_scale_ = 0.0;
  double speed = 0.0;
  for (const Member& m : members)
  {
    if (m.inverse_mass == 0.0)
      continue;
    const double gyration = m.gyration();
    acceleration_scale_ = std::max(acceleration_scale_, m.acceleration.norm() + (std::abs(m.alpha) + m.omega * m.omega) * gyration);
    speed = std::max(speed, m.velocity.norm() + std::abs(m.omega) * gyration);
  }
  // Rounding of a velocity that is a difference of larger ones, those before the event included.
  noise_ = std::max(noise_, kSpeedNoise * speed);
  // A bounce at speed v under the acceleration a rises v^2 / 2a: below sqrt(8 a delta) never more than 4 delta, so that the rest of the
  // decaying series of bounces is replaced by its limit. A contact that loses nothing has no such limit; there only what
  // cannot be seen is taken away: a touch left alone sinks by the guard and comes back with v^2 = 2 a guard, of which this is twice as much.
  rest_speed_.resize(touches.size());
  depth_.resize(touches.size());
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    const bool lossless = touches[i].elasticity == 1.0 && !scales.dissipative;
    depth_[i] = lossless ? 0.5 * scales.guard : scales.tolerance;
    rest_speed_[i] = std::max(noise_, std::sqrt(8.0 * depth_[i] * acceleration_scale_));
  }
}

/// Vertices of one pair that land within the tolerance land together (flat on flat); those of other pairs only where their gaps are closed too,
/// else the order of their hits in time is kept.
void ContactGroup::findSimultaneous()
{
  const int n = static_cast<int>(touches.size());
  meets_.assign(n, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n && !meets_[i]; ++j)
      meets_[i] = touches[j].gap <= closed_ && touches[j].pair == touches[i].pair;
}

bool ContactGroup::anyElastic(const std::vector<int>& rows) const
{
  return std::any_of(rows.begin(), rows.end(), [&](int i) { return touches[i].elasticity > 0.0; });
}

/// One stage of reflection (Smith et al. 2012, with the elasticity in every stage): l minimises the kinetic energy after an inelastic impact of the
/// approaching touches; the impulse is (1 + e) l. For one touch this is equation (11).
///
/// With c = M^-1 J'l the velocities v end at v + c inelastically, at v + c + z with z = M^-1 J'E l elastically, z not longer than keeps the energy.
void ContactGroup::reflect(const std::vector<int>& rows)
{
  solver_.begin(gram_);
  for (int i : rows)
  {
    rates_[i] = velocityOf(i);
    solver_.suppose(i);
  }
  solver_.solve(rows, rates_);
  solver_.refine();  // elastic impacts keep their energy to rounding, however many there are
  impulses_.clear();
  for (int i : rows)
    impulses_.push_back(solver_.value()[i]);
  const double rebound = shareOfRebound(rows);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const double impulse = (1.0 + rebound * touches[rows[k]].elasticity) * impulses_[k];
    if (impulse == 0.0)
      continue;
    touches[rows[k]].impulse += impulse;
    push(rows[k], impulse);
    const double* changes = gram_.row(rows[k]);
    for (std::size_t i = 0; i < rates_.size(); ++i)
      rates_[i] += impulse * changes[i];
  }
}

/// s <= 1 with |v + c + s z| <= |v| in the mass metric; 1 but where different elasticities meet. There c.M z = l'A E l, v.M z = w'E l.
double ContactGroup::shareOfRebound(const std::vector<int>& rows)
{
  const double e = touches[rows.front()].elasticity;
  if (std::all_of(rows.begin(), rows.end(), [&](int i) { return touches[i].elasticity == e; }))
    return 1.0;
  double square = 0.0, given = 0.0, along = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    double change = 0.0, back = 0.0;
    for (std::size_t j = 0; j < rows.size(); ++j)
    {
      const double term = gram_(rows[k], rows[j]) * impulses_[j];
      change += term;
      back += touches[rows[j]].elasticity * term;
    }
    const double z = touches[rows[k]].elasticity * impulses_[k];
    square += z * back;
    given += impulses_[k] * change;
    along += z * (rates_[rows[k]] + change);
  }
  return square > 0.0 ? std::min(1.0, (std::sqrt(along * along + square * given) - along) / square) : 1.0;
}

/// Inelastic end: no touch approaches any more, min |dv| in the mass metric with w >= 0.
void ContactGroup::stop()
{
  measureRates();
  solver_.begin(gram_);
  solver_.solve(all_, rates_);
  stopped_ = solver_.support();
  bringToRestWithNeighbours(stopped_);
  measureRates();
}

/// Gordan's alternative: no velocity opens all these touches exactly if some l >= 0, sum l = 1, has l'A l = 0. With c = (1, ..., 1),
/// min 1/2 l'(A + c c')l - c'l over l >= 0 has the value -1/2 in that case and a larger one otherwise.
bool ContactGroup::isLocked(const std::vector<int>& rows)
{
  const int n = static_cast<int>(rows.size());
  extended_.resize(n);
  double size = 0.0;
  for (int i = 0; i < n; ++i)
    size = std::max(size, gram_(rows[i], rows[i]));
  extended_rows_.resize(n);
  minus_one_.assign(n, -1.0);
  for (int i = 0; i < n; ++i)
  {
    extended_rows_[i] = i;
    for (int j = 0; j < n; ++j)
      extended_(i, j) = gram_(rows[i], rows[j]) / size + 1.0;
  }
  solver_.begin(extended_);
  for (int i : extended_rows_)
    solver_.suppose(i);
  solver_.solve(extended_rows_, minus_one_);
  double sum = 0.0;
  for (double l : solver_.value())
    sum += l;
  return 1.0 - sum < 1e-12;  // the minimum is -sum/2
}

/// Whether every closed touch opens faster than it could come to rest: then nothing is left to do.
bool ContactGroup::allLeave() const
{
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (touches[i].gap <= closed_ && rates_[i] <= rest_speed_[i])
      return false;
  return true;
}

/// The normal velocities, without what rounding has left in them of stage after stage.
void ContactGroup::measureRates()
{
  rates_.resize(touches.size());
  for (std::size_t i = 0; i < touches.size(); ++i)
    rates_[i] = velocityOf(static_cast<int>(i));
}

/// What approaches faster than could come to rest; else of what the last plan pushes whatever approaches still, however slowly: that bounces before
/// another plan is made.
void ContactGroup::takeApproaching()
{
  approaching_.clear();
  for (int i : all_)
    if (rates_[i] < -rest_speed_[i])
      approaching_.push_back(i);
  if (!approaching_.empty())
    bouncing_.clear();
  for (int i : bouncing_)
    if (rates_[i] < -noise_)
      approaching_.push_back(i);
}

double ContactGroup::collide(const ContactScales& scales)
{
  const int n = static_cast<int>(touches.size());
  for (Touch& touch : touches)
  {
    touch.impulse = touch.capture = touch.force = 0.0;
    touch.active = false;
  }
  closed_ = scales.closed;
  scale(scales);
  findSimultaneous();
  all_.clear();
  for (int i = 0; i < n; ++i)
    if (meets_[i])
      all_.push_back(i);

  start_ = velocities();
  measureRates();
  pressing_.begin(gram_);
  planned_.begin(gram_);
  bouncing_.clear();
  bool planned = false;
  // A free cone needs few stages; in one that no velocity opens, or with more stages than any free cone is known to need, what is left ends
  // inelastically.
  const int cap = 100 * (n + 10);
  for (int stage = 0; stage < cap; ++stage)
  {
    if (stage == 50 && isLocked(all_))
      break;
    takeApproaching();
    if (approaching_.empty())
    {
      measureRates();
      takeApproaching();
    }
    if (approaching_.empty() && allLeave())
    {
      clean();
      return lossSince(start_);
    }
    const bool slow = approaching_.empty() || !bouncing_.empty();
    if (slow && !anyElastic(approaching_))
    {
      planCapture();
      bouncing_.clear();
      for (int i : others_)
        if (planned_.value()[i] > 0.0)
          bouncing_.push_back(i);
      takeApproaching();
      planned = !anyElastic(approaching_);
      if (planned)
        break;
    }
    if (anyElastic(approaching_))
      reflect(approaching_);
    else
      stop();
  }
  if (!planned)
  {
    stop();
    planCapture();
  }
  capture();
  clean();
  return lossSince(start_);
}

void ContactGroup::place(Member& member, const Vec2& shift, double turn)
{
  member.frame.position += shift;
  member.angle += turn;
  member.frame = Frame(member.frame.position, member.angle);
}

bool ContactGroup::struck() const
{
  return std::any_of(touches.begin(), touches.end(), [](const Touch& t) { return t.impulse != 0.0 || t.capture != 0.0; });
}

bool ContactGroup::settles(const Touch& t, double resolution) const
{
  return !t.corner && (t.active || std::max(t.gap, t.separation) < -resolution);
}

double ContactGroup::misfit(double resolution) const
{
  double sum = 0.0;
  for (const Touch& t : touches)
    if (settles(t, resolution))
      sum += t.gap * t.gap;
  return sum;
}

ContactGroup::Moves ContactGroup::settlePositions(double resolution)
{
  // min |dq| in the mass metric with gap + J dq = 0. A gap that takes far larger moves to close, on a short lever, stays as it is.
  constexpr double kShortLever = 1e-6;  // square of the share of the others' lengths
  pressed_.clear();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (settles(touches[i], resolution))
      pressed_.push_back(static_cast<int>(i));
  const auto open = [&](int i) { return touches[i].gap != 0.0; };
  if (std::none_of(pressed_.begin(), pressed_.end(), open))
    return {};
  independent(pressed_, kShortLever);
  pressed_ = independent_;
  solution_.resize(pressed_.size());
  Moves moves;
  for (std::size_t k = 0; k < pressed_.size(); ++k)
  {
    moves.gap = std::max(moves.gap, std::abs(touches[pressed_[k]].gap));
    solution_[k] = -touches[pressed_[k]].gap;
  }
  factor_.solve(solution_.data());

  sumChanges(pressed_, solution_, changes_);
  for (std::size_t m = 0; m < members.size(); ++m)
  {
    if (members[m].inverse_mass == 0.0)
      continue;
    const Vec2& shift = changes_[m].velocity;
    const double turn = changes_[m].omega;
    place(members[m], shift, turn);
    moves.farthest = std::max(moves.farthest, shift.norm() + std::abs(turn) * members[m].gyration());
  }
  return moves;
}

}  // namespace block_world
