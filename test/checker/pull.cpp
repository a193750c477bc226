#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "replay.h"

namespace checker
{
namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// min |y - C p| over p >= 0 by active sets (Lawson & Hanson 1974, ch. 23), as far as it takes to come below `enough`.
double leastDistance(const MatrixXd& c, const VectorXd& y, double enough)
{
  std::vector<int> passive;
  VectorXd p = VectorXd::Zero(c.cols()), left = y;
  for (int step = 0; step < 3 * c.cols() && left.norm() > enough; ++step)
  {
    const VectorXd slope = c.transpose() * left;
    int best = -1;
    for (int i = 0; i < c.cols(); ++i)
      if (slope[i] > 1e-13 * y.norm() && (best < 0 || slope[i] > slope[best]) &&
          std::find(passive.begin(), passive.end(), i) == passive.end())
        best = i;
    if (best < 0)
      break;
    passive.push_back(best);
    while (!passive.empty())
    {
      MatrixXd columns(c.rows(), passive.size());
      for (size_t k = 0; k < passive.size(); ++k)
        columns.col(k) = c.col(passive[k]);
      const VectorXd wanted = columns.colPivHouseholderQr().solve(y);
      double share = 1.0;
      size_t leaves = passive.size();
      for (size_t k = 0; k < passive.size(); ++k)
      {
        const double now = p[passive[k]];
        if (wanted[k] <= 0.0 && now / (now - wanted[k]) <= share)
        {
          share = now > 0.0 ? now / (now - wanted[k]) : 0.0;
          leaves = k;
        }
      }
      for (size_t k = 0; k < passive.size(); ++k)
        p[passive[k]] += share * (wanted[k] - p[passive[k]]);
      if (leaves == passive.size())
        break;
      p[passive[leaves]] = 0.0;
      passive.erase(passive.begin() + leaves);
    }
    left = y - c * p;
  }
  return left.norm();
}
}  // namespace

// What of the impulses j (N s), or forces (N), no pushes p >= 0 at touches would do: min |J'(j - p)| sqrt(m) in the metric M^-1, with m all movable mass.
// On a short lever large pulls and pushes do little together. What rests nearby may push, too, though its impulses add up to nothing: a bounce pushes up
// what the capture then stops.
double Replay::pull(const std::vector<const ContactRow*>& pulling, const std::vector<State>& states, double enough) const
{
  std::vector<const ContactRow*> touches = pulling;
  touches.insert(touches.end(), rests_.begin(), rests_.end());
  std::vector<int> place(run_.bodies, -1);
  double mass = 0.0;
  int count = 0;
  for (int body = 0; body < static_cast<int>(run_.bodies); ++body)
    if (scene_.movable(body))
    {
      mass += drive_->bodies[body].mass;
      place[body] = count++;
    }
  MatrixXd columns = MatrixXd::Zero(3 * count, touches.size());
  VectorXd pulls = VectorXd::Zero(3 * count), all = pulls;
  for (size_t k = 0; k < touches.size(); ++k)
  {
    const ContactRow& row = *touches[k];
    for (const int body : { row.a, row.b })
    {
      if (!scene_.movable(body))
        continue;
      const Vec2 force = (body == row.a ? 1.0 : -1.0) * row.normal;
      const double torque = cross(Vec2(row.point - states[body].position), force);
      columns.col(k).segment<2>(3 * place[body]) = force / std::sqrt(drive_->bodies[body].mass);
      columns(3 * place[body] + 2, k) = torque / std::sqrt(motion_.inertia(*drive_, body));
    }
    const double impulse = k < pulling.size() ? row.impulse : 0.0;
    pulls += std::min(0.0, impulse) * columns.col(k);
    all += impulse * columns.col(k);
    columns.col(k).normalize();
  }
  const double share = std::sqrt(mass), few = pulls.norm();
  return share * (share * few <= enough ? few : leastDistance(columns, all, enough / share));
}

}  // namespace checker
