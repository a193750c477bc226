#include "rest.h"

#include <array>
#include <type_traits>

#include "limits.h"

namespace checker
{
namespace
{
/// Weights that integrate the polynomial through n values at 0, 1 ... n - 1 over [start, start + 1], once and twice.
struct Weights
{
  std::array<double, 6> once{}, twice{};
};

// Five Gauss points are exact for the degrees met here.
Weights weightsOf(size_t n, size_t start)
{
  static const double node[] = { 0.0, 0.5384693101056831, 0.9061798459386640 };
  static const double share[] = { 0.5688888888888889, 0.4786286704993665, 0.2369268850561891 };
  Weights weights;
  for (int g = -2; g <= 2; ++g)
  {
    const double s = 0.5 + (g < 0 ? -0.5 : 0.5) * node[std::abs(g)];
    for (size_t i = 0; i < n; ++i)
    {
      double basis = 0.5 * share[std::abs(g)];
      for (size_t j = 0; j < n; ++j)
      {
        if (j != i)
          basis *= (start + s - j) / (static_cast<double>(i) - static_cast<double>(j));
      }
      weights.once[i] += basis;
      weights.twice[i] += (1.0 - s) * basis;
    }
  }
  return weights;
}

/// A window of n of `count` values that lies around [interval, interval + 1], or beside it by one where there are values.
struct Window
{
  Window(size_t n, size_t interval, size_t count, int aside = 0) : n(n)
  {
    const size_t before = n / 2 - 1 - aside;
    start = interval < before ? 0 : std::min(interval - before, count - n);
    static const std::array<std::array<Weights, 5>, 7> table = [] {
      std::array<std::array<Weights, 5>, 7> all;
      for (const size_t size : { 4, 6 })
      {
        for (size_t at = 0; at + 1 < size; ++at)
          all[size][at] = weightsOf(size, at);
      }
      return all;
    }();
    weights = &table[n][interval - start];
  }
  template <class Value>
  auto once(const Value& value) const
  {
    std::decay_t<decltype(value(start))> sum = weights->once[0] * value(start);
    for (size_t i = 1; i < n; ++i)
      sum += weights->once[i] * value(start + i);
    return sum;
  }
  template <class Value>
  auto twice(const Value& value) const
  {
    std::decay_t<decltype(value(start))> sum = weights->twice[0] * value(start);
    for (size_t i = 1; i < n; ++i)
      sum += weights->twice[i] * value(start + i);
    return sum;
  }

  size_t n, start;
  const Weights* weights;
};

constexpr double force_error = 1e-9;    ///< relative; forces come from a linear solve that may be ill-conditioned
constexpr double largest_guess = 1e-6;  ///< m/s or rad/s: an interval with a larger uncertainty is not judged
constexpr double largest_share = 0.25;  ///< of the intervals of all bodies that may stay unjudged
}  // namespace

RestMotion::RestMotion(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion,
                       Replay& replay, Report& report)
  : scene_(scene)
  , run_(run)
  , timeline_(timeline)
  , motion_(motion)
  , replay_(replay)
  , position_(report.check("rest.position", "motion under the listed contact forces, in units of its limit"))
  , velocity_(report.check("rest.velocity", "the same for velocities"))
  , coverage_(report.check("coverage.unjudged", "share of sample intervals in which contact forces change unseen"))
{
}

void RestMotion::checkAll()
{
  for (size_t cluster = 0; cluster < motion_.clusters().size(); ++cluster)
    checkCluster(static_cast<int>(cluster));
  if (judged_ + skipped_ > 0.0)
    coverage_.add(skipped_ / (judged_ + skipped_), largest_share, run_.times.back());
}

bool RestMotion::evenlySpaced(size_t sample) const
{
  const double last = run_.times[sample] - run_.times[sample - 1],
               former = run_.times[sample - 1] - run_.times[sample - 2];
  return std::abs(last - former) < 1e-9 * last;
}

// Stretches of samples between which nothing happens to the cluster.
void RestMotion::checkCluster(int cluster)
{
  size_t sample = 1;
  while (sample < run_.times.size())
  {
    if (replay_.regime(sample, cluster) != Regime::Smooth)
    {
      (replay_.regime(sample, cluster) == Regime::Flight ? judged_ : skipped_) += 1.0;
      ++sample;
      continue;
    }
    const size_t first = sample - 1;
    do
      ++sample;
    while (sample < run_.times.size() && replay_.regime(sample, cluster) == Regime::Smooth && evenlySpaced(sample));
    checkStretch(cluster, first, sample - 1);
  }
}

void RestMotion::checkStretch(int cluster, size_t first, size_t last)
{
  // Six samples make two orders that can be compared.
  if (last - first < 5)
  {
    for (size_t sample = first + 1; sample <= last; ++sample)
    {
      replay_.account(sample).known = false;
      skipped_ += 1.0;
    }
    return;
  }
  std::vector<Instant> instants;
  for (size_t sample = first; sample <= last; ++sample)
    instants.push_back(instant(cluster, sample));
  for (size_t sample = first + 1; sample <= last; ++sample)
    checkInterval(cluster, sample, instants, first);
}

void RestMotion::checkInterval(int cluster, size_t sample, const std::vector<Instant>& instants, size_t first)
{
  const double h = run_.times[sample] - run_.times[sample - 1];
  const Window fine(6, sample - 1 - first, instants.size());
  Account& account = replay_.account(sample);
  bool sure = true;
  for (size_t i = 0; i < motion_.clusters()[cluster].size(); ++i)
  {
    const int body = motion_.clusters()[cluster][i];
    const State &from = run_.state(sample - 1, body), &to = run_.state(sample, body);
    Limits limits = stateLimits(to, scene_.blocks[body].shape.radius, run_.times[sample]);
    const auto a = [&](size_t k) { return instants[k].a[i]; };
    const auto alpha = [&](size_t k) { return instants[k].alpha[i]; };
    const Vec2 gain = h * fine.once(a);
    const double turn = h * fine.once(alpha);
    // The difference of two orders is an estimate of the finer one's error, not a bound: forces that grow by a fifth from sample to sample
    // exceed it a few times over. It may vanish by chance, but not for three windows.
    double guess = 0.0, turn_guess = 0.0;
    for (const int aside : { -1, 0, 1 })
    {
      const Window coarse(4, sample - 1 - first, instants.size(), aside);
      guess = std::max(guess, 30.0 * (gain - h * coarse.once(a)).norm());
      turn_guess = std::max(turn_guess, 30.0 * std::abs(turn - h * coarse.once(alpha)));
    }
    sure = sure && guess < largest_guess && turn_guess < largest_guess;
    if (!sure)
      break;
    const double weight = timeline_.at(run_.times[sample]).gravity + a(sample - first).norm();
    limits.velocity += guess + force_error * h * weight;
    limits.omega +=
        turn_guess + force_error * h * (std::abs(alpha(sample - first)) + weight / scene_.blocks[body].shape.radius);
    limits.position += h * limits.velocity;
    limits.angle += h * limits.omega;
    const Vec2 move = h * from.velocity + h * h * fine.twice(a);
    const double swing = h * from.omega + h * h * fine.twice(alpha);
    velocity_.add(std::max((to.velocity - from.velocity - gain).norm() / limits.velocity,
                           std::abs(to.omega - from.omega - turn) / limits.omega),
                  1.0, run_.times[sample], body);
    position_.add(std::max((to.position - from.position - move).norm() / limits.position,
                           std::abs(to.angle - from.angle - swing) / limits.angle),
                  1.0, run_.times[sample], body);
  }
  account.thrust += h * fine.once([&](size_t k) { return instants[k].power.thrust; });
  account.damping += h * fine.once([&](size_t k) { return instants[k].power.damping; });
  account.known = account.known && sure;
  (sure ? judged_ : skipped_) += 1.0;
}

void RestMotion::addContacts(int cluster, size_t sample, std::vector<Load>& loads) const
{
  for (size_t i = replay_.rowsEnd(sample); i-- > 0 && run_.contacts[i].time == run_.times[sample];)
  {
    const ContactRow& row = run_.contacts[i];
    if (row.kind != Kind::Rest)
      continue;
    for (const int body : { row.a, row.b })
    {
      if (!scene_.movable(body) || motion_.clusterOf(body) != cluster)
        continue;
      const Vec2 force = (body == row.a ? 1.0 : -1.0) * row.impulse * row.normal;
      loads[body].force += force;
      loads[body].torque += cross(row.point - run_.state(sample, body).position, force);
    }
  }
}

RestMotion::Instant RestMotion::instant(int cluster, size_t sample) const
{
  const Drive& drive = timeline_.at(run_.times[sample]);
  const std::vector<State> states(run_.states.begin() + sample * run_.bodies,
                                  run_.states.begin() + (sample + 1) * run_.bodies);
  std::vector<Load> loads(run_.bodies);
  Instant result;
  result.power = motion_.loads(cluster, drive, states, loads);
  addContacts(cluster, sample, loads);
  for (const int body : motion_.clusters()[cluster])
  {
    result.a.push_back(loads[body].force / drive.bodies[body].mass);
    result.alpha.push_back(loads[body].torque / motion_.inertia(drive, body));
  }
  return result;
}

}  // namespace checker
