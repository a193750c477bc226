#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "block_world/world.h"

namespace block_world
{
/// A CSV file that is being written, 17 significant digits per number.
class Table
{
public:
  /// Opens a file, or standard output for an empty path. Throws std::runtime_error with path and reason.
  explicit Table(const std::string& path);

  void addHeader(const std::string& header);
  void add(double number);
  void add(const std::string& text);
  void endRow();
  /// Makes sure that all is written. Throws std::runtime_error where it is not.
  void close();

private:
  void separate();
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool row_begun_ = false;
};

/// The states, energies and contacts of a run at one instant, as read from the world.
struct Sample
{
  Time time;
  std::vector<MotionState> states;  ///< of all bodies, fixed ones too
  EnergyAccount energy;
  std::vector<ContactEvent> contacts, resting;
};

/// The files that a run writes.
class Output
{
public:
  /// Throws std::runtime_error where a file cannot be opened; empty paths: states to standard output, the others not at
  /// all.
  Output(const std::string& states, const std::string& energy, const std::string& contacts);

  bool wantsEnergy() const
  {
    return energy_ != nullptr;
  }
  bool wantsContacts() const
  {
    return contacts_ != nullptr;
  }
  void write(const World& world, const Sample& sample);
  void close();

private:
  void writeContact(const World& world, const ContactEvent& contact);

  Table states_;
  std::unique_ptr<Table> energy_, contacts_;
};

}  // namespace block_world
