#include "colors.h"

#include <utility>

namespace block_world
{
namespace
{
using NamedColor = std::pair<const char*, unsigned>;

// CSS values, 0xRRGGBB.
constexpr std::array<NamedColor, 32> colors{ {
    { "black", 0x000000 },     { "blue", 0x0000ff },       { "brown", 0xa52a2a },      { "coral", 0xff7f50 },
    { "crimson", 0xdc143c },   { "cyan", 0x00ffff },       { "darkblue", 0x00008b },   { "darkgray", 0xa9a9a9 },
    { "darkgreen", 0x006400 }, { "darkred", 0x8b0000 },    { "dodgerblue", 0x1e90ff }, { "gold", 0xffd700 },
    { "gray", 0x808080 },      { "green", 0x008000 },      { "hotpink", 0xff69b4 },    { "lightblue", 0xadd8e6 },
    { "lightgray", 0xd3d3d3 }, { "lightgreen", 0x90ee90 }, { "lime", 0x00ff00 },       { "magenta", 0xff00ff },
    { "navy", 0x000080 },      { "olive", 0x808000 },      { "orange", 0xffa500 },     { "pink", 0xffc0cb },
    { "purple", 0x800080 },    { "red", 0xff0000 },        { "salmon", 0xfa8072 },     { "tan", 0xd2b48c },
    { "teal", 0x008080 },      { "violet", 0xee82ee },     { "white", 0xffffff },      { "yellow", 0xffff00 },
} };

}  // namespace

std::optional<std::array<double, 3>> findColor(const std::string& name)
{
  for (const auto& [known, rgb] : colors)
    if (name == known)
      return std::array<double, 3>{ { (rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0 } };
  return std::nullopt;
}

std::string colorNames()
{
  std::string names;
  for (const NamedColor& color : colors)
    names += (names.empty() ? "" : ", ") + std::string(color.first);
  return names;
}

}  // namespace block_world
