#pragma once

#include <array>
#include <optional>
#include <string>

namespace block_world
{
/// Red, green, blue in 0..1 of a CSS colour name out of a short list.
std::optional<std::array<double, 3>> findColor(const std::string& name);

/// All names that findColor knows, for messages.
std::string colorNames();

}  // namespace block_world
