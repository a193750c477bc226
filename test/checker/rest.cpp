#include "rest.h"

#include <array>
#include <type_traits>

#include "limits.h"

namespace checker
{
namespace
{
/// Weights that integrate the polynomial through n values at 0, 1 ... n - 1 over [start, start + 1], once and twice, and the one
/// through n values and as many slopes (Hermite).
struct Weights
{
  std::array<double, 6> once{}, twice{}, of_value{}, of_slope{};
};

// Six Gauss points are exact up to degree 11, the highest here.
Weights weightsOf(size_t n, size_t start)
{
  static const double node[] = { 0.2386191860831969, 0.6612093864662645, 0.9324695142031521 };
  static const double share[] = { 0.4679139345726910, 0.3607615730481386, 0.1713244923791704 };
  Weights weights;
  for (int g = 0; g < 6; ++g)
  {
    const double s = 0.5 + (g < 3 ? -0.5 : 0.5) * node[g % 3], weight = 0.5 * share[g % 3];
    for (size_t i = 0; i < n; ++i)
    {
      double basis = 1.0, basis_slope = 0.0;  // Lagrange's, and its slope at node i
      for (size_t j = 0; j < n; ++j)
      {
        if (j == i)
          continue;
        const double apart = static_cast<double>(i) - static_cast<double>(j);
        basis *= (start + s - j) / apart;
        basis_slope += 1.0 / apart;
      }
      const double aside = start + s - i;
      weights.once[i] += weight * basis;
      weights.twice[i] += weight * (1.0 - s) * basis;
      weights.of_value[i] += weight * basis * basis * (1.0 - 2.0 * basis_slope * aside);
      weights.of_slope[i] += weight * basis * basis * aside;
    }
  }
  return weights;
}

/// A window of n of `count` values that lies around [interval, interval + 1] where there are values.
struct Window
{
  Window(size_t n, size_t interval, size_t count) : n(n)
  {
    const size_t before = n / 2 - 1;
    start = interval < before ? 0 : std::min(interval - before, count - n);
    static const std::array<std::array<Weights, 5>, 7> table = [] {
      std::array<std::array<Weights, 5>, 7> all;
      for (const size_t size : { 4, 5, 6 })
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
  /// With the slopes as well; the error falls with twice the power of the sample interval.
  template <class Value, class Slope>
  double hermite(double h, const Value& value, const Slope& slope) const
  {
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
      sum += weights->of_value[i] * value(start + i) + weights->of_slope[i] * h * slope(start + i);
    return h * sum;
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

double magnitude(double value)
{
  return std::abs(value);
}

double magnitude(const Vec2& value)
{
  return value.norm();
}

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
  const size_t interval = sample - 1 - first;
  const Window fine(6, interval, instants.size()), medium(5, interval, instants.size()), coarse(4, interval, instants.size());
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
    // exceed it a few times over. One order's step may vanish by chance, or be undone by the next one's: their sizes count.
    const auto doubt = [&](const auto& value) {
      const auto low = coarse.once(value), middle = medium.once(value), high = fine.once(value);
      return 30.0 * h * (magnitude(high - middle) + magnitude(middle - low));
    };
    const double guess = doubt(a), turn_guess = doubt(alpha);
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
  addWork(h, interval, instants, account);
  account.known = account.known && sure;
  (sure ? judged_ : skipped_) += 1.0;
}

// Powers may change faster than accelerations do, as that of a damper whose ends pass close to each other; but their slopes at the samples
// are known as well. Order 12 is far more exact than order 8, so that the difference bounds its error.
void RestMotion::addWork(double h, size_t interval, const std::vector<Instant>& instants, Account& account) const
{
  const auto integrate = [&](double Power::*part, double& work, double& error) {
    const auto value = [&](size_t k) { return instants[k].power.*part; };
    const auto slope = [&](size_t k) { return instants[k].rates.*part; };
    const double fine = Window(6, interval, instants.size()).hermite(h, value, slope);
    work += fine;
    error += std::abs(fine - Window(4, interval, instants.size()).hermite(h, value, slope));
  };
  integrate(&Power::thrust, account.thrust, account.thrust_error);
  integrate(&Power::damping, account.damping, account.damping_error);
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
  result.rates = motion_.powerRates(cluster, drive, states, loads);
  for (const int body : motion_.clusters()[cluster])
  {
    result.a.push_back(loads[body].force / drive.bodies[body].mass);
    result.alpha.push_back(loads[body].torque / motion_.inertia(drive, body));
  }
  return result;
}

}  // namespace checker
