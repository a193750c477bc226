#pragma once

#include <QKeyEvent>
#include <QTimer>

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace block_world
{
/// Which driving keys are down, from the key events of a window.
class DriveKeys
{
public:
  explicit DriveKeys(const std::function<void()>& on_change);

  /// True where the event is of a driving key.
  bool handle(const QKeyEvent& event);
  void releaseAll();

  bool isIdle() const;
  /// Of the six thrusters of block 0 or 1.
  std::vector<double> levels(int block) const;

private:
  void press(int key, int drive);
  void release(int key);
  void endReleases();

  struct Held
  {
    int drive = 0;      ///< as in the table of keys; Shift is as it was when the key went down
    bool ends = false;  ///< a release that the same key's press may yet revoke
  };
  std::function<void()> on_change_;
  std::map<int, Held> held_;  ///< by Qt's key
  QTimer revocable_, ending_;
};

}  // namespace block_world
