#include "teleop_keys.h"

#include <algorithm>

namespace block_world
{
namespace
{
constexpr unsigned char ESCAPE = 27;
constexpr std::size_t THRUSTERS = 6;

/// The four ways a pair of hands steers one block: towards, back, left and right.
std::optional<std::array<int, 2>> thrustersOf(int key, int up, int down, int left, int right)
{
  if (key == up)
    return std::array<int, 2>{ { 2, -1 } };
  if (key == down)
    return std::array<int, 2>{ { 3, -1 } };
  if (key == left)
    return std::array<int, 2>{ { 0, 4 } };
  if (key == right)
    return std::array<int, 2>{ { 1, 5 } };
  return std::nullopt;
}

/// Counter-clockwise and clockwise.
std::optional<std::array<int, 2>> spinOf(int key, int left, int right)
{
  if (key == left)
    return std::array<int, 2>{ { 0, 5 } };
  if (key == right)
    return std::array<int, 2>{ { 1, 4 } };
  return std::nullopt;
}

}  // namespace

std::optional<int> KeyReader::read(unsigned char byte)
{
  // ESC [ A or ESC O A, with numbers in between where Shift or Ctrl is down.
  if (byte == ESCAPE)
  {
    sequence_ = "\033";
    return std::nullopt;
  }
  if (sequence_.empty())
    return byte;
  sequence_ += static_cast<char>(byte);
  if (sequence_.size() == 2 && (byte == '[' || byte == 'O'))
    return std::nullopt;
  if (sequence_.size() > 2 && (byte == ';' || (byte >= '0' && byte <= '9')))
    return std::nullopt;
  const bool arrow = sequence_.size() > 2 && byte >= 'A' && byte <= 'D';
  sequence_.clear();
  if (!arrow)
    return std::nullopt;
  return std::array<int, 4>{ { keys::UP, keys::DOWN, keys::RIGHT, keys::LEFT } }[byte - 'A'];
}

std::optional<Drive> driveOf(int key)
{
  auto thrusters = thrustersOf(key, 'e', 'd', 's', 'f');
  if (!thrusters)
    thrusters = spinOf(key, 'S', 'F');
  if (thrusters)
    return Drive{ 0, *thrusters };

  thrusters = thrustersOf(key, 'i', 'k', 'j', 'l');
  if (!thrusters)
    thrusters = thrustersOf(key, keys::UP, keys::DOWN, keys::LEFT, keys::RIGHT);
  if (!thrusters)
    thrusters = spinOf(key, 'J', 'L');
  if (thrusters)
    return Drive{ 1, *thrusters };
  return std::nullopt;
}

std::vector<double> levelsOf(const std::vector<int>& keys, int block)
{
  std::vector<double> levels(THRUSTERS, 0.0);
  for (const int key : keys)
  {
    const std::optional<Drive> drive = driveOf(key);
    if (!drive || drive->block != block)
      continue;
    for (const int thruster : drive->thrusters)
      if (thruster >= 0)
        levels[thruster] = 1.0;
  }
  return levels;
}

HeldKeys::HeldKeys(std::int64_t first_hold, std::int64_t repeat_hold)
  : first_hold_(first_hold), repeat_hold_(repeat_hold)
{
}

void HeldKeys::press(int key, std::int64_t now)
{
  held_.erase(std::remove_if(held_.begin(), held_.end(), [now](const Held& held) { return held.until <= now; }),
              held_.end());
  for (Held& held : held_)
  {
    if (held.key != key)
      continue;
    held.until = now + repeat_hold_;
    return;
  }
  held_.push_back({ key, now + first_hold_ });
}

void HeldKeys::releaseAll()
{
  held_.clear();
}

std::vector<double> HeldKeys::levels(int block, std::int64_t now) const
{
  std::vector<int> keys;
  for (const Held& held : held_)
    if (held.until > now)
      keys.push_back(held.key);
  return levelsOf(keys, block);
}

}  // namespace block_world
