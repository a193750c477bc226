#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "block_world/scene.h"

namespace block_world
{
/// A scene file that cannot be used; what() reads "file:line: key: reason".
class SceneFileError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What a command line or a node puts in place of the file's values.
struct SceneOverrides
{
  std::optional<int> count;         ///< build only the first blocks
  std::optional<double> tolerance;  ///< m
};

/// The text of a scene file. Throws SceneFileError where it cannot be read.
std::string readSceneFile(const std::string& path);
/// Reads a scene file and completes it (completeScene). Throws SceneFileError with file, line, key and reason.
/// Only the tolerance stays as given: World raises it where it must, and says so in its notes.
Scene loadSceneFile(const std::string& path, const SceneOverrides& overrides = SceneOverrides());
/// The same from text; name stands for the file in error messages.
Scene loadSceneText(const std::string& text, const std::string& name = "scene",
                    const SceneOverrides& overrides = SceneOverrides());
/// One entry of a scene file's blocks, to be added to a scene (SpawnCommand), with the same errors; the key of an error is
/// the block's own. A block without a name gets the one that it would have as the scene's next.
Block loadBlockText(const std::string& text, const Scene& scene, const std::string& name = "block");
/// A YAML text that loads back to the same scene, numbers with 17 significant digits.
std::string writeScene(const Scene& scene);

}  // namespace block_world
