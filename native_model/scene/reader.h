// Reads a scene from TOML (mjcf/docs/keys.md lists every table and key).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

// Reads the scene in a file, with the overrides applied ("table.key=value", see overrides.h).
// Throws SceneError with everything that is wrong: unreadable file, syntax, unknown keys and
// tables, types, units, missing keys, impossible values and combinations. The returned scene is
// finite and complete: lists that belong together have the same length, and defaults are filled in.
Scene read_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

// The same from text. `file_name` appears in diagnostics and names the scene.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  std::span<const std::string> overrides = {});

// The text of a scene file. Throws SceneError.
std::string file_text(const std::filesystem::path& path);

// 64-bit FNV-1a hash of Scene::text alone, as 16 hexadecimal digits.
std::string scene_hash(const Scene& scene);
std::string text_hash(std::string_view text);  // the same for any text

// Many scenes from one text: it is parsed once, and each scene changes a few values.
class Variants {
 public:
  // The `overrides` apply to all variants. Throws SceneError if the text is not TOML or an override
  // cannot be applied. Each variant is checked as a scene later, because it may supply what the
  // text leaves out.
  explicit Variants(const std::filesystem::path& file, std::span<const std::string> overrides = {});

  // The scene with `changes` (overrides.h) applied, as from read_scene. Throws SceneError. With
  // `with_text`, Scene::text is the text of the variant, which MuJoCo's plugin reads, else empty.
  Scene scene(std::span<const std::string> changes, bool with_text) const;

  const std::string& text() const { return text_; }  // with the common overrides

 private:
  std::string file_, text_;
  TomlNode root_;
};

// Reads a whole file. Throws std::runtime_error with the reason alone ("cannot be read: ...", "is a
// folder ...") if it is not a regular file. Devices and pipes, also behind a link, are refused
// because they may have no end.
std::string regular_file_text(const std::filesystem::path& file);

}  // namespace rotorub::scene
