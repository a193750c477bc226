#include "yaml_entry.h"

#include <algorithm>
#include <cctype>

#include "block_world/scene_yaml.h"

namespace block_world
{
namespace
{
int lineNumber(const YAML::Node& node)
{
  return std::max(node.Mark().line + 1, 1);
}

std::string childKey(const std::string& parent, const std::string& name)
{
  return parent.empty() ? name : parent + "." + name;
}

bool isQuoted(const YAML::Node& node)
{
  return node.Tag() == "!" || node.Tag() == "tag:yaml.org,2002:str";
}

/// What a value is, for "must be ..., is ...".
std::string described(const YAML::Node& node)
{
  switch (node.Type())
  {
    case YAML::NodeType::Scalar:
      return (isQuoted(node) ? "the text '" : "'") + node.Scalar() + "'";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a mapping";
    default:
      return "empty";
  }
}

std::string joined(std::initializer_list<const char*> words)
{
  std::string text;
  for (const char* word : words)
    text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

/// The part of a key path up to the next '.' or '['; takes it from the path.
std::string takeStep(std::string& path)
{
  const std::size_t end = path.find_first_of(".[", 1);
  const std::string step = path.substr(0, end);
  path.erase(0, step.size());
  if (!path.empty() && path.front() == '.')
    path.erase(0, 1);
  return step;
}

}  // namespace

YamlEntry::YamlEntry(const YAML::Node& root, const std::string& file) : YamlEntry(root, "", lineNumber(root), file)
{
}

YamlEntry::YamlEntry(const YAML::Node& node, const std::string& key, int line, const std::string& file)
  : node_(node), key_(key), line_(line), file_(&file)
{
}

void YamlEntry::fail(const std::string& reason) const
{
  throw SceneFileError(complaint(*file_, line_, key_, reason));
}

bool YamlEntry::isPlainScalar() const
{
  // "1" in quotes is a text, not a number.
  return node_.IsScalar() && !isQuoted(node_);
}

double YamlEntry::number() const
{
  double value = 0.0;
  if (!isPlainScalar() || !YAML::convert<double>::decode(node_, value))
    fail("must be a number, is " + described(node_));
  return value;
}

int YamlEntry::wholeNumber() const
{
  int value = 0;
  if (!isPlainScalar() || !YAML::convert<int>::decode(node_, value))
    fail("must be a whole number, is " + described(node_));
  return value;
}

bool YamlEntry::flag() const
{
  bool value = false;
  if (!isPlainScalar() || !YAML::convert<bool>::decode(node_, value))
    fail("must be true or false, is " + described(node_));
  return value;
}

std::string YamlEntry::text() const
{
  if (!node_.IsScalar())
    fail("must be a text, is " + described(node_));
  return node_.Scalar();
}

std::vector<YamlEntry> YamlEntry::list() const
{
  if (!node_.IsSequence())
    fail("must be a list, is " + described(node_));
  std::vector<YamlEntry> entries;
  for (const YAML::Node& node : node_)
    entries.push_back(YamlEntry(node, key_ + "[" + std::to_string(entries.size()) + "]", lineNumber(node), *file_));
  return entries;
}

std::vector<double> YamlEntry::numbers() const
{
  std::vector<double> values;
  for (const YamlEntry& entry : list())
    values.push_back(entry.number());
  return values;
}

std::vector<double> YamlEntry::numbers(std::size_t count) const
{
  if (!node_.IsSequence() || node_.size() != count)
    fail("must be a list of " + std::to_string(count) + " numbers, is " +
         (node_.IsSequence() ? "one of " + std::to_string(node_.size()) : described(node_)));
  return numbers();
}

Eigen::Vector2d YamlEntry::vector() const
{
  const std::vector<double> values = numbers(2);
  return Eigen::Vector2d(values[0], values[1]);
}

YamlMapping::YamlMapping(const YamlEntry& entry, std::initializer_list<const char*> known) : entry_(entry)
{
  if (!entry.node_.IsMap())
    entry.fail("must be a mapping with keys out of " + joined(known) + "; is " + described(entry.node_));
  for (const auto& pair : entry.node_)
  {
    const int line = lineNumber(pair.first);
    if (!pair.first.IsScalar())
      YamlEntry(pair.first, entry.key_, line, *entry.file_).fail("a key must be a word, is " + described(pair.first));
    const std::string name = pair.first.Scalar();
    const YamlEntry value(pair.second, childKey(entry.key_, name), line, *entry.file_);
    if (std::none_of(known.begin(), known.end(), [&](const char* word) { return name == word; }))
      value.fail("unknown key; known here are " + joined(known));
    if (find(name))
      value.fail("repeated key; first on line " + std::to_string(find(name)->line_));
    values_.emplace_back(name, value);
  }
}

std::optional<YamlEntry> YamlMapping::find(const std::string& key) const
{
  for (const auto& [name, value] : values_)
    if (name == key)
      return value;
  return std::nullopt;
}

YamlEntry YamlMapping::require(const std::string& key) const
{
  const std::optional<YamlEntry> value = find(key);
  if (!value)
    YamlEntry(entry_.node_, childKey(entry_.key_, key), entry_.line_, *entry_.file_).fail("is missing");
  return *value;
}

double YamlMapping::number(const std::string& key, double otherwise) const
{
  const std::optional<YamlEntry> value = find(key);
  return value ? value->number() : otherwise;
}

void YamlMapping::fail(const std::string& reason) const
{
  entry_.fail(reason);
}

int lineOf(const YAML::Node& root, const std::string& path)
{
  int line = lineNumber(root);
  YAML::Node node = root;
  for (std::string rest = path; !rest.empty();)
  {
    const std::string step = takeStep(rest);
    YAML::Node next(YAML::NodeType::Undefined);
    if (step.front() == '[' && node.IsSequence())
    {
      std::size_t left = std::stoul(step.substr(1));
      for (auto it = node.begin(); it != node.end() && !next.IsDefined(); ++it)
        if (left-- == 0)
          line = lineNumber(*it), next.reset(*it);
    }
    else if (step.front() != '[' && node.IsMap())
      for (auto it = node.begin(); it != node.end() && !next.IsDefined(); ++it)
        if (it->first.IsScalar() && it->first.Scalar() == step)
          line = lineNumber(it->first), next.reset(it->second);
    if (!next.IsDefined())
      break;
    node.reset(next);
  }
  return line;
}

std::string complaint(const std::string& file, int line, const std::string& key, const std::string& reason)
{
  return file + (line < 1 ? "" : ":" + std::to_string(line)) + ": " + (key.empty() ? "" : key + ": ") + reason;
}

}  // namespace block_world
