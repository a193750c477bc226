#pragma once

#include <vector>

#include "motion.h"
#include "report.h"
#include "run_files.h"
#include "timeline.h"

namespace checker
{
/// How far the files determine a cluster's motion over a sample interval.
enum class Regime : char
{
  Flight,  ///< no resting contact: free motion and listed impulses, exactly
  Smooth,  ///< resting contacts at both ends and no event in between: forces can be interpolated
  Broken   ///< resting contacts that change somewhere inside: forces in between are in no file
};

/// What should have changed the energy during a sample interval.
struct Account
{
  bool known = true;
  double thrust = 0.0, spring = 0.0, command = 0.0, damping = 0.0, impact = 0.0;
  double thrust_error = 0.0, damping_error = 0.0;  ///< how far integrals of powers at the samples may be off
};

/// Starts every sample interval at its first sample, moves the bodies freely, applies the listed impulses at the listed
/// times and compares with the next sample (flight.*, replay.*, rest.bounded); looks at every impact and contact on the
/// way (impact.*, contact.*).
class Replay
{
public:
  Replay(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion, Report& report);

  void checkAll();

  Regime regime(size_t sample, int cluster) const
  {
    return regimes_[sample * motion_.clusters().size() + cluster];
  }
  /// Of the interval that ends at a sample.
  Account& account(size_t sample)
  {
    return accounts_[sample];
  }
  /// First row later than a sample.
  size_t rowsEnd(size_t sample) const
  {
    return rows_end_[sample];
  }

private:
  using RowRange = std::pair<size_t, size_t>;

  struct Checks
  {
    explicit Checks(Report& report);
    Check &start, &flight_position, &flight_velocity, &replay_position, &linear, &angular;
    Check &sign, &unit, &normal, &point, &overlap;
    Check &approach, &restitution, &impulse, &energy;
    Check &rest_speed, &rest_set, &bounded;
  };

  // replay.cpp: one interval
  void checkStart();
  void checkInterval(size_t sample);
  void classify(size_t sample);
  void holdForces(size_t sample);
  void markEvents(RowRange rows);
  void walk(RowRange rows);
  void applyChange(const Change& change);
  void account(const Change& change);
  void land(size_t sample);
  void compare(int body, const State& wanted, const State& found);
  void bring(int cluster, double time);
  int islandOf(int cluster);
  bool known(int body);

  // unknown_forces.cpp: where contact forces change between the samples
  void bringIsland(int cluster, double time);
  double demand(int island);
  double forcedAcceleration(const ContactRow& row) const;
  void bound(int body, size_t sample);

  // impacts.cpp: what happens at one time
  void strike(RowRange rows);
  void checkSigns(const std::vector<const ContactRow*>& events);
  double pull(const std::vector<const ContactRow*>& pulling, const std::vector<State>& states, double enough) const;
  void strikeGroup(const std::vector<const ContactRow*>& group);
  void push(const ContactRow& row);
  void loseIsland(int body);
  void checkSingle(const ContactRow& row, const std::vector<State>& before);
  void checkRow(const ContactRow& row, const std::vector<State>& states, double slack);
  void checkRest(size_t sample);
  void checkRestSigns(const std::vector<const ContactRow*>& rests, const std::vector<State>& states);
  void checkRestSet(size_t sample);
  double normalVelocity(const ContactRow& row, const std::vector<State>& states) const;
  double overlap(int a, int b, const std::vector<State>& states) const;
  double captureSpeed(const ContactRow& row, const std::vector<State>& states) const;
  double captureImpulse() const;
  double appliedAcceleration(int body, const std::vector<State>& states) const;
  double slack(const ContactRow& row, double since);
  double fastestRate(int island);
  double speedOf(int body) const;

  const Scene& scene_;
  const Run& run_;
  const Timeline& timeline_;
  const Motion& motion_;
  Checks checks_;
  std::vector<size_t> rows_end_;
  std::vector<Regime> regimes_;
  std::vector<Account> accounts_;
  bool start_rows_pending_ = false;  ///< the first sample shows the state before the events of time 0

  // The interval at hand.
  const Drive* drive_ = nullptr;
  Account* account_ = nullptr;
  double begin_ = 0.0, end_ = 0.0;
  std::vector<State> states_;
  std::vector<Load> held_, none_;                ///< contact forces at the interval's first sample; no forces
  std::vector<const ContactRow*> rests_;         ///< where bodies rest at either sample, or begin or end to
  std::vector<std::pair<int, int>> rest_pairs_;  ///< that rest at either sample or begin to in between; sorted
  std::vector<int> island_parent_;               ///< clusters joined by resting contacts
  std::vector<char> resting_, lost_;             ///< per cluster; lost: the forces on it are unknown after an event
  std::vector<char> eventful_;                   ///< per island root
  std::vector<double> demand_;                   ///< per island root: what contact forces may change, sqrt(kg) m/s
  std::vector<double> clock_;                    ///< per cluster
  std::vector<Vec2> pushed_;                     ///< per body: sums of |impulse| and of |impulse| x arm
  std::vector<Vec2> leaning_;                    ///< per body: sums of the contact forces at both samples and of their moments
  std::vector<char> moved_;  ///< per body: a rest began or ended near it, which may shift it by the tolerance
};

}  // namespace checker
