#include "drive_keys.h"

#include <cctype>

#include "teleop_keys.h"

namespace block_world
{
namespace
{
// X11 repeats a held key as a release and a press, 0.2 ms apart. Qt marks most of these as repetitions but not all: not
// when another key has been let go, and not when it sees the release before the press has come. A real release takes
// longer to be followed by a press.
constexpr int REVOCABLE_MS = 4;

/// The key as the table of driving keys has it.
std::optional<int> driveKey(const QKeyEvent& event)
{
  if (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier))
    return std::nullopt;
  // Arrows spin as the letters do that they stand for.
  static const std::map<int, std::pair<int, int>> ARROWS = { { Qt::Key_Up, { keys::UP, keys::UP } },
                                                             { Qt::Key_Down, { keys::DOWN, keys::DOWN } },
                                                             { Qt::Key_Left, { keys::LEFT, 'J' } },
                                                             { Qt::Key_Right, { keys::RIGHT, 'L' } } };
  const bool shift = event.modifiers() & Qt::ShiftModifier;
  const auto arrow = ARROWS.find(event.key());
  if (arrow != ARROWS.end())
    return shift ? arrow->second.second : arrow->second.first;
  if (event.key() < Qt::Key_A || event.key() > Qt::Key_Z)
    return std::nullopt;
  const int letter = std::tolower(event.key());
  if (!driveOf(letter))
    return std::nullopt;
  return shift && driveOf(event.key()) ? event.key() : letter;
}

}  // namespace

DriveKeys::DriveKeys(const std::function<void()>& on_change) : on_change_(on_change)
{
  revocable_.setSingleShot(true);
  revocable_.setTimerType(Qt::PreciseTimer);
  ending_.setSingleShot(true);
  // Where Qt has been busy for longer, the press may lie behind the timer's event: it gets one more round.
  QObject::connect(&revocable_, &QTimer::timeout, [this] { ending_.start(0); });
  QObject::connect(&ending_, &QTimer::timeout, [this] { endReleases(); });
}

bool DriveKeys::handle(const QKeyEvent& event)
{
  const bool known = held_.count(event.key()) > 0;
  const std::optional<int> drive = driveKey(event);
  if (!known && !drive)
    return false;
  if (event.isAutoRepeat())
    return true;
  if (event.type() == QEvent::KeyPress && drive)
    press(event.key(), *drive);
  else if (event.type() == QEvent::KeyRelease && known)
    release(event.key());
  return true;
}

void DriveKeys::press(int key, int drive)
{
  const auto held = held_.find(key);
  if (held != held_.end())
  {
    held->second.ends = false;
    return;
  }
  held_[key].drive = drive;
  on_change_();
}

void DriveKeys::release(int key)
{
  held_[key].ends = true;
  revocable_.start(REVOCABLE_MS);
}

void DriveKeys::endReleases()
{
  bool changed = false;
  for (auto held = held_.begin(); held != held_.end();)
  {
    changed = changed || held->second.ends;
    held = held->second.ends ? held_.erase(held) : std::next(held);
  }
  if (changed)
    on_change_();
}

void DriveKeys::releaseAll()
{
  if (held_.empty())
    return;
  held_.clear();
  on_change_();
}

bool DriveKeys::isIdle() const
{
  return held_.empty();
}

std::vector<double> DriveKeys::levels(int block) const
{
  std::vector<int> drives;
  for (const auto& [key, held] : held_)
    drives.push_back(held.drive);
  return levelsOf(drives, block);
}

}  // namespace block_world
