#pragma once

#include <vector>

#include "replay.h"

namespace checker
{
/// Where bodies rest on each other without an event, their contact forces are listed at every sample. This interpolates
/// the accelerations that follow and compares their integrals with the motion (rest.*), and counts what stays unjudged
/// (coverage.*).
class RestMotion
{
public:
  RestMotion(const Scene& scene, const Run& run, const Timeline& timeline, const Motion& motion, Replay& replay,
             Report& report);

  void checkAll();

private:
  /// Accelerations of a cluster's bodies at one sample, the power of its loads and how fast it changes.
  struct Instant
  {
    std::vector<Vec2> a;
    std::vector<double> alpha;
    Power power, rates;
  };

  void checkCluster(int cluster);
  void checkStretch(int cluster, size_t first, size_t last);
  void checkInterval(int cluster, size_t sample, const std::vector<Instant>& instants, size_t first);
  void addWork(double h, size_t interval, const std::vector<Instant>& instants, Account& account) const;
  Instant instant(int cluster, size_t sample) const;
  void addContacts(int cluster, size_t sample, std::vector<Load>& loads) const;
  bool evenlySpaced(size_t sample) const;

  const Scene& scene_;
  const Run& run_;
  const Timeline& timeline_;
  const Motion& motion_;
  Replay& replay_;
  Check &position_, &velocity_, &coverage_;
  double skipped_ = 0.0, judged_ = 0.0;
};

}  // namespace checker
