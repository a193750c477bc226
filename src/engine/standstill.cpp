// Bringing touches to rest: the part of ContactGroup that takes their normal velocities away without ever adding energy.

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "contact_group.h"

namespace block_world
{
/// What impulses at the rows do to the members, M^-1 J'j.
void ContactGroup::sumChanges(const std::vector<int>& rows, const std::vector<double>& impulses, std::vector<Twist>& changes) const
{
  changes.assign(members.size(), Twist());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const Touch& t = touches[rows[k]];
    const Member &a = members[t.member_a], &b = members[t.member_b];
    Twist &of_a = changes[t.member_a], &of_b = changes[t.member_b];
    of_a.velocity += impulses[k] * a.inverse_mass * t.normal;
    of_a.omega += impulses[k] * a.inverse_inertia * cross(t.arm, t.normal);
    of_b.velocity -= impulses[k] * b.inverse_mass * t.normal;
    of_b.omega -= impulses[k] * b.inverse_inertia * cross(t.reach, t.normal);
  }
}

const std::vector<ContactGroup::Twist>& ContactGroup::velocities()
{
  velocities_.resize(members.size());
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    velocities_[i].velocity = members[i].velocity;
    velocities_[i].omega = members[i].omega;
  }
  return velocities_;
}

bool ContactGroup::atRest(const std::vector<int>& rows) const
{
  return std::all_of(rows.begin(), rows.end(), [&](int i) { return std::abs(velocityOf(i)) <= noise_; });
}

/// Cholesky factor of the rows, but for those that depend on the former ones by rounding.
void ContactGroup::independent(const std::vector<int>& rows, double share)
{
  factor_.clear();
  independent_.clear();
  for (int i : rows)
  {
    row_.clear();
    for (int j : independent_)
      row_.push_back(gram_(i, j));
    row_.push_back(gram_(i, i));
    if (factor_.append(row_.data(), share))
      independent_.push_back(i);
  }
}

/// Kinetic energy lost since then, -1/2 (v - v0).M (v + v0).
double ContactGroup::lossSince(const std::vector<Twist>& start)
{
  velocities();
  double loss = 0.0;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i].inverse_mass > 0.0)
      loss -= 0.5 * ((velocities_[i].velocity - start[i].velocity).dot(velocities_[i].velocity + start[i].velocity) / members[i].inverse_mass +
                     (velocities_[i].omega - start[i].omega) * (velocities_[i].omega + start[i].omega) / members[i].inverse_inertia);
  return loss;
}

/// Takes the normal velocities of the rows away by the least change in the mass metric, v - M^-1 J'(J M^-1 J')^-1 J v.
void ContactGroup::bringToRest(const std::vector<int>& rows)
{
  independent(rows, kDependent);
  // The second pass takes what rounding left of the first.
  for (int pass = 0; pass < 2; ++pass)
  {
    solution_.resize(independent_.size());
    for (std::size_t k = 0; k < independent_.size(); ++k)
      solution_[k] = -velocityOf(independent_[k]);
    factor_.solve(solution_.data());
    for (std::size_t k = 0; k < independent_.size(); ++k)
    {
      push(independent_[k], solution_[k]);
      touches[independent_[k]].capture += solution_[k];
    }
  }
  if (!atRest(rows))
    projectOut(rows);
}

/// The same by an orthonormal basis Q of the columns M^-1/2 J', each of length 1, v - M^-1/2 Q Q' M^1/2 v: for touches that depend on each other nearly,
/// as in a jam, where A = J M^-1 J' has squared the condition. This takes energy whatever rounding does to Q.
void ContactGroup::projectOut(const std::vector<int>& rows)
{
  const int count = static_cast<int>(rows.size()), size = 3 * static_cast<int>(members.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(size, count);
  Eigen::VectorXd weight(size), norm(count), velocity = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Member& m = members[i];
    const double mass = std::sqrt(m.inverse_mass), inertia = std::sqrt(m.inverse_inertia);
    weight.segment<3>(3 * i) << mass, mass, inertia;
    if (m.inverse_mass > 0.0)
      velocity.segment<3>(3 * i) << m.velocity / mass, m.omega / inertia;
  }
  for (int k = 0; k < count; ++k)
  {
    const Touch& t = touches[rows[k]];
    columns.block<3, 1>(3 * t.member_a, k) += Eigen::Vector3d(t.normal.x(), t.normal.y(), cross(t.arm, t.normal));
    columns.block<3, 1>(3 * t.member_b, k) -= Eigen::Vector3d(t.normal.x(), t.normal.y(), cross(t.reach, t.normal));
    columns.col(k).array() *= weight.array();
    norm[k] = columns.col(k).norm();
    columns.col(k) /= norm[k];
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(std::sqrt(kRounding));
  const int rank = static_cast<int>(qr.rank());
  Eigen::VectorXd along = qr.householderQ().transpose() * velocity;
  along.tail(size - rank).setZero();
  const Eigen::VectorXd change = -weight.cwiseProduct(qr.householderQ() * along);
  const Eigen::VectorXd impulses = qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(-along.head(rank));
  for (int k = 0; k < rank; ++k)
  {
    const int row = qr.colsPermutation().indices()[k];
    touches[rows[row]].capture += impulses[k] / norm[row];
  }
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    members[i].velocity += change.segment<2>(3 * i);
    members[i].omega += change[3 * i + 2];
    sizes_[i].x += std::abs(change[3 * i]);
    sizes_[i].y += std::abs(change[3 * i + 1]);
    sizes_[i].omega += std::abs(change[3 * i + 2]);
  }
}

/// Brings the rows to rest, and with them whatever closed touch would approach then, but for some.
void ContactGroup::bringToRestWithNeighbours(std::vector<int>& rows, const std::vector<int>& but)
{
  const auto in = [](const std::vector<int>& list, int i) { return std::find(list.begin(), list.end(), i) != list.end(); };
  bringToRest(rows);
  for (;;)
  {
    const std::size_t count = rows.size();
    for (int i = 0; i < static_cast<int>(touches.size()); ++i)
      if (touches[i].gap <= closed_ && velocityOf(i) < -noise_ && !in(rows, i) && !in(but, i))
        rows.push_back(i);
    if (rows.size() == count)
      return;
    bringToRest(rows);
  }
}

}  // namespace block_world
