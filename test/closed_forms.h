#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "block_world/world.h"

// What the engine must find, worked out without it: closed forms, one-dimensional integrals, and ordinary differential
// equations of one or two unknowns with an integrator of their own.

namespace closed_form
{
using block_world::MotionState;
using Eigen::Vector2d;

inline double cross(const Vector2d& a, const Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

// ---------------------------------------------------------------------------------------------------- flight

/// (1 - exp(-z)) / z, whose limit at 0 is 1.
inline double phi1(double z)
{
  return z == 0.0 ? 1.0 : -std::expm1(-z) / z;
}

/// (1 - phi1(z)) / z, whose limit at 0 is 1/2; below 0.1 by its series 1/2! - z/3! + z^2/4! - ...
inline double phi2(double z)
{
  if (z > 0.1)
    return (1.0 - phi1(z)) / z;
  double sum = 0.0, term = 0.5;
  for (int n = 3; n < 16; ++n)
  {
    sum += term;
    term *= -z / n;
  }
  return sum;
}

/// m v' = -k v - m g and I w' = -k r w: speeds decay exponentially towards v = -g m/k and w = 0.
inline MotionState dampedFlight(const MotionState& from, double mass, double inertia, double damping, double ratio,
                              double gravity, double t)
{
  const double z = damping / mass * t, turn = damping * ratio / inertia * t;
  const Vector2d g(0.0, -gravity);
  MotionState to;
  to.position = from.position + t * phi1(z) * from.velocity + t * t * phi2(z) * g;
  to.velocity = std::exp(-z) * from.velocity + t * phi1(z) * g;
  to.angle = from.angle + t * phi1(turn) * from.omega;
  to.omega = std::exp(-turn) * from.omega;
  return to;
}

// ---------------------------------------------------------------------------------------------------- drops

/// Height over the floor of what was dropped from `height` and bounces without loss: parabolas about the tops, one
/// every 2 sqrt(2 h / g).
inline double elasticDrop(double height, double gravity, double t)
{
  const double period = 2.0 * std::sqrt(2.0 * height / gravity);
  const double since_top = t - period * std::round(t / period);
  return height - 0.5 * gravity * since_top * since_top;
}

/// Bounces of a drop from `height`: t0 = sqrt(2 h / g) to the floor, then hops of 2 e^n t0; their sum is
/// t0 (1 + e) / (1 - e).
struct BouncingDrop
{
  double height, gravity, elasticity;

  double fallTime() const
  {
    return std::sqrt(2.0 * height / gravity);
  }
  double restTime() const
  {
    return fallTime() * (1.0 + elasticity) / (1.0 - elasticity);
  }
  /// Number of landings faster than a speed; the n-th comes in at g t0 e^(n-1).
  int landingsFasterThan(double speed) const
  {
    int n = 0;
    for (double in = gravity * fallTime(); in > speed; in *= elasticity)
      ++n;
    return n;
  }
};

// ---------------------------------------------------------------------------------------------------- impact

struct Struck
{
  MotionState a, b;
  double impulse = 0.0;
};

/// Equation (11): one point of contact, normal n from b to a, j = -(1 + e) w / (1/ma + 1/mb + (ra x n)^2/Ia + (rb x
/// n)^2/Ib), with w the normal velocity before.
inline Struck strike(const MotionState& a, double mass_a, double inertia_a, const MotionState& b, double mass_b,
                     double inertia_b, const Vector2d& point, const Vector2d& normal, double elasticity)
{
  const Vector2d arm_a = point - a.position, arm_b = point - b.position;
  const double turn_a = cross(arm_a, normal), turn_b = cross(arm_b, normal);
  const double before = normal.dot(a.velocity - b.velocity) + turn_a * a.omega - turn_b * b.omega;
  const double yielding = 1.0 / mass_a + 1.0 / mass_b + turn_a * turn_a / inertia_a + turn_b * turn_b / inertia_b;
  Struck after{ a, b, -(1.0 + elasticity) * before / yielding };
  after.a.velocity += after.impulse / mass_a * normal;
  after.b.velocity -= after.impulse / mass_b * normal;
  after.a.omega += after.impulse * turn_a / inertia_a;
  after.b.omega -= after.impulse * turn_b / inertia_b;
  return after;
}

/// Speeds after block a ran into block b centrally: momentum is kept, the relative speed is reversed times e.
inline std::pair<double, double> centralImpact(double mass_a, double va, double mass_b, double vb, double e)
{
  const double common = (mass_a * va + mass_b * vb) / (mass_a + mass_b);
  return { common + e * mass_b * (vb - va) / (mass_a + mass_b), common + e * mass_a * (va - vb) / (mass_a + mass_b) };
}

/// Unit masses on a line that hit one another in pairs, one hit after the other in the order of their times; returns the speeds once all is over.
inline std::vector<double> rowOfHits(std::vector<double> x, std::vector<double> v, double e)
{
  for (;;)
  {
    std::size_t next = x.size();
    double soonest = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
    {
      if (!(v[i] > v[i + 1]))
        continue;
      const double span = (x[i + 1] - x[i]) / (v[i] - v[i + 1]);
      if (next == x.size() || span < soonest)
      {
        next = i;
        soonest = span;
      }
    }
    if (next == x.size())
      return v;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += soonest * v[i];
    x[next + 1] = x[next];
    std::tie(v[next], v[next + 1]) = centralImpact(1.0, v[next], 1.0, v[next + 1], e);
  }
}

// ---------------------------------------------------------------------------------------------------- quadrature

/// Gauss-Legendre with 20 points on each of 16 panels; the nodes by Newton's method on the Legendre polynomial.
inline double integral(const std::function<double(double)>& f, double from, double to)
{
  constexpr int points = 20, panels = 16;
  const double pi = std::acos(-1.0), half = 0.5 * (to - from) / panels;
  double sum = 0.0;
  for (int i = 0; i < points; ++i)
  {
    double x = std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 1.0;
    for (int pass = 0; pass < 10; ++pass)
    {
      double last = 1.0, now = x;
      for (int n = 2; n <= points; ++n)
      {
        const double next = ((2 * n - 1) * x * now - (n - 1) * last) / n;
        last = now;
        now = next;
      }
      slope = points * (x * now - last) / (x * x - 1.0);
      x -= now / slope;
    }
    const double weight = 2.0 / ((1.0 - x * x) * slope * slope);
    for (int panel = 0; panel < panels; ++panel)
      sum += weight * f(from + (2 * panel + 1 + x) * half);
  }
  return half * sum;
}

/// Time of a fall from rest at angle `top` to `angle` with rate(angle) = sqrt(sin top - sin angle) x slow(angle):
/// angle = top - u^2 takes the root's singularity away.
inline double fallTime(double top, double angle, const std::function<double(double)>& slow)
{
  const auto per_u = [&](double u) {
    const double drop = u * u;
    const double lost = 2.0 * std::cos(top - 0.5 * drop) * std::sin(0.5 * drop);  // sin top - sin(top - drop)
    return 2.0 * u / (std::sqrt(lost) * slow(top - drop));
  };
  return integral(per_u, 0.0, std::sqrt(top - angle));
}

// ---------------------------------------------------------------------------------------------------- ladder

/// A ladder of half-length 1 and moment of inertia I (per kg) that slides down wall and floor from rest at angle a0:
/// the centre moves on the unit circle, so w^2 (1 + I) / 2 = g (sin a0 - sin a). The wall pushes with m times
/// d^2/dt^2 cos a = -cos a w^2 - sin a a'', zero where 2 (sin a0 - sin a) = sin a: sin a = 2/3 sin a0. From there on
/// the centre keeps w sin a sideways.
struct Ladder
{
  double gravity, inertia, start;

  double rate(double angle) const
  {
    return std::sqrt(2.0 * gravity * (std::sin(start) - std::sin(angle)) / (1.0 + inertia));
  }
  double releaseAngle() const
  {
    return std::asin(2.0 / 3.0 * std::sin(start));
  }
  double releaseTime() const
  {
    const double slow = std::sqrt(2.0 * gravity / (1.0 + inertia));
    return fallTime(start, releaseAngle(), [slow](double) { return slow; });
  }
  double releaseSpeed() const
  {
    return rate(releaseAngle()) * std::sin(releaseAngle());
  }
};

// ---------------------------------------------------------------------------------------------------- falling rod

/// A body that falls from rest while one corner slides on the floor: no force acts sideways, so its centre falls
/// straight down, at height R sin b with R the corner's distance and b the angle of the line from corner to centre.
/// Energy: b'^2 (K^2 + R^2 cos^2 b) / 2 = g R (sin b0 - sin b), with K^2 the moment of inertia per kg.
struct SlidingFall
{
  double gravity, gyration, distance, start;

  double slow(double angle) const
  {
    const double c = distance * std::cos(angle);
    return std::sqrt(2.0 * gravity * distance / (gyration + c * c));
  }
  double rate(double angle) const
  {
    return slow(angle) * std::sqrt(std::sin(start) - std::sin(angle));
  }
  double timeAt(double angle) const
  {
    return fallTime(start, angle, [this](double b) { return slow(b); });
  }
  /// Newton's method on timeAt, whose slope is -1 / rate.
  double angleAt(double t) const
  {
    double angle = start - 0.25 * gravity * distance * std::cos(start) * t * t / (gyration + distance * distance);
    for (int pass = 0; pass < 30; ++pass)
      angle += (timeAt(angle) - t) * rate(angle);
    return angle;
  }
};

// ---------------------------------------------------------------------------------------------------- integrator

/// Classical Runge-Kutta with fixed steps: at 1e-4 s and rates of a few 1/s the error is of the order of rounding.
template <class Vector>
Vector integrate(const std::function<Vector(const Vector&)>& slope, Vector y, double span, int steps)
{
  const double h = span / steps;
  for (int i = 0; i < steps; ++i)
  {
    const Vector k1 = slope(y);
    const Vector k2 = slope(y + 0.5 * h * k1);
    const Vector k3 = slope(y + 0.5 * h * k2);
    const Vector k4 = slope(y + h * k3);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return y;
}

/// A body on a spring from a point of it to a point of the world. rest > 0: spring and damper act along the line of the
/// points; rest = 0: force -k d - c d'.
struct SpringBody
{
  double mass, inertia, gravity;
  Vector2d point, anchor;
  double stiffness, rest, damping;

  using Vector6 = Eigen::Matrix<double, 6, 1>;  ///< x, y, angle and their rates

  Vector6 slope(const Vector6& y) const
  {
    const double c = std::cos(y(2)), s = std::sin(y(2));
    const Vector2d arm(c * point.x() - s * point.y(), s * point.x() + c * point.y());
    const Vector2d d = y.head<2>() + arm - anchor;
    const Vector2d rate = y.segment<2>(3) + y(5) * Vector2d(-arm.y(), arm.x());
    Vector2d force = -stiffness * d - damping * rate;
    if (rest > 0.0)
    {
      const Vector2d along = d.normalized();
      force = -(stiffness * (d.norm() - rest) + damping * along.dot(rate)) * along;
    }
    Vector6 out;
    out << y.tail<3>(), force.x() / mass, force.y() / mass - gravity, cross(arm, force) / inertia;
    return out;
  }

  MotionState after(const MotionState& from, double t) const
  {
    Vector6 y;
    y << from.position, from.angle, from.velocity, from.omega;
    y = integrate<Vector6>([this](const Vector6& at) { return slope(at); }, y, t, static_cast<int>(1e4 * t) + 1);
    MotionState to;
    to.position = y.head<2>();
    to.angle = y(2);
    to.velocity = y.segment<2>(3);
    to.omega = y(5);
    return to;
  }
};

/// m x'' = -k x - c x' from rest at x0, below critical damping: x = x0 exp(-c t / 2m) (cos qt + c / (2 m q) sin qt)
/// with q^2 = k/m - (c / 2m)^2.
inline double dampedOscillation(double x0, double mass, double stiffness, double damping, double t)
{
  const double decay = 0.5 * damping / mass, q = std::sqrt(stiffness / mass - decay * decay);
  return x0 * std::exp(-decay * t) * (std::cos(q * t) + decay / q * std::sin(q * t));
}

}  // namespace closed_form
