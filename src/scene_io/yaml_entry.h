#pragma once

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace block_world
{
/// One value of a YAML file, which knows its place: every complaint names file, line and key. Types are taken strictly.
class YamlEntry
{
public:
  /// The root of a document; file must outlive all entries.
  YamlEntry(const YAML::Node& root, const std::string& file);

  const YAML::Node& node() const
  {
    return node_;
  }
  const std::string& key() const
  {
    return key_;
  }

  /// Throws SceneFileError.
  [[noreturn]] void fail(const std::string& reason) const;

  double number() const;
  int wholeNumber() const;
  bool flag() const;
  std::string text() const;
  std::vector<YamlEntry> list() const;
  std::vector<double> numbers() const;
  std::vector<double> numbers(std::size_t count) const;
  Eigen::Vector2d vector() const;

private:
  friend class YamlMapping;
  YamlEntry(const YAML::Node& node, const std::string& key, int line, const std::string& file);
  bool isPlainScalar() const;

  YAML::Node node_;
  std::string key_;
  int line_;  ///< counted from 1
  const std::string* file_;
};

/// The keys of a mapping. Unknown and repeated ones are refused at once.
class YamlMapping
{
public:
  YamlMapping(const YamlEntry& entry, std::initializer_list<const char*> known);

  std::optional<YamlEntry> find(const std::string& key) const;
  YamlEntry require(const std::string& key) const;
  /// The number at a key; otherwise what is left out.
  double number(const std::string& key, double otherwise) const;
  [[noreturn]] void fail(const std::string& reason) const;

private:
  YamlEntry entry_;
  std::vector<std::pair<std::string, YamlEntry>> values_;
};

/// Line, counted from 1, of a key path such as "blocks[2].mass", or of the nearest parent that the document has.
int lineOf(const YAML::Node& root, const std::string& path);

/// "file:line: key: reason"; a line below 1 and an empty key are left out.
std::string complaint(const std::string& file, int line, const std::string& key, const std::string& reason);

}  // namespace block_world
