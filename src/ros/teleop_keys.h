#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace block_world
{
/// Keys as a terminal sends them: a byte each, or an escape sequence for the arrows.
namespace keys
{
constexpr int UP = 256, DOWN = 257, LEFT = 258, RIGHT = 259;
}

/// Turns the bytes that a terminal sends into keys.
class KeyReader
{
public:
  /// A key for a byte, or nothing where the byte is part of a longer sequence.
  std::optional<int> read(unsigned char byte);

private:
  std::string sequence_;
};

/// What a key does: block 0 or 1 and the thrusters (0..5) that it fires. They push the block the way the key points, in
/// the block's own frame.
struct Drive
{
  int block;
  std::array<int, 2> thrusters;  ///< the second is -1 where the key fires one alone
};

/// Nothing for keys that drive no block. Capitals are those with Shift: they spin.
std::optional<Drive> driveOf(int key);

/// The levels (0 or 1) of a block's six thrusters while these keys are held.
std::vector<double> levelsOf(const std::vector<int>& keys, int block);

/// Which keys are held. A terminal tells of no release: a key counts as held until it has not come again for a while.
/// The first wait is longer, because keys begin to repeat only after a delay.
class HeldKeys
{
public:
  /// Both in ns.
  HeldKeys(std::int64_t first_hold, std::int64_t repeat_hold);

  void press(int key, std::int64_t now);
  void releaseAll();

  /// The levels (0 or 1) of a block's six thrusters.
  std::vector<double> levels(int block, std::int64_t now) const;

private:
  struct Held
  {
    int key;
    std::int64_t until;
  };
  std::int64_t first_hold_, repeat_hold_;
  std::vector<Held> held_;
};

}  // namespace block_world
