#pragma once

#include <Eigen/Core>

#include <string>

#include "block_world/scene.h"

namespace block_world
{
/// Throws a SceneError.
[[noreturn]] void refuse(const std::string& key, const std::string& reason);

/// A number, or a vector, as error messages show it.
std::string shown(double number);
std::string shown(const Eigen::Vector2d& vector);

/// "key[index]".
std::string indexed(const std::string& key, std::size_t index);

// Each refuses a value that is not finite or not in its range.
void requireFinite(double value, const std::string& key);
void requireFinite(const Eigen::Vector2d& value, const std::string& key);
void requireNotNegative(double value, const std::string& key);
void requireShare(double value, const std::string& key);  ///< 0..1

/// The springs and the timed inputs of a scene whose blocks are complete.
void checkSprings(const Scene& scene);
void checkInputs(const Scene& scene);

}  // namespace block_world
