#pragma once

#include <string>
#include <vector>

namespace block_world
{
/// The terminal in raw mode on its second screen, put back however the program ends: by leaving, Ctrl-C, a signal, even
/// a crash. Ctrl-Z works too. There can be one at a time.
class Terminal
{
public:
  /// Throws std::runtime_error where standard input or output is no terminal.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// A signal has asked the program to end.
  static bool endAsked();

  /// Waits for bytes up to so many ms; returns what there is. End of input counts as asked to end.
  std::vector<unsigned char> read(int patience_ms);

  /// Replaces what is on the screen.
  void show(const std::vector<std::string>& lines);

  int columns() const;
};

}  // namespace block_world
