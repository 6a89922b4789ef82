// Reading a scene from TOML (mjcf/docs/keys.md lists every table and key).
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

// The scene in a file, with the overrides applied ("table.key=value", see overrides.h). Throws
// SceneError with everything that is wrong: unreadable file, syntax, unknown keys and tables,
// types, units, missing keys, impossible values and combinations. A scene that is returned is
// finite and complete: lists that go together have one length, and what has a default holds it.
Scene read_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

// The same from text. `file_name` stands in diagnostics and gives the scene its name.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  std::span<const std::string> overrides = {});

// The steps of these. The text of a file that can be a scene; throws SceneError.
std::string file_text(const std::filesystem::path& path);
// The scene of a tree that `text` stands for. `diagnostics`: what is known to be wrong already.
Scene scene_of(const TomlNode& root, const std::string& file_name, std::string text,
               std::vector<Diagnostic> diagnostics);

// 16 hexadecimal digits that depend on Scene::text alone: 64-bit FNV-1a.
std::string scene_hash(const Scene& scene);
std::string text_hash(std::string_view text);  // the same of any text

// Many scenes from one text: it is read once, and each scene differs in a few values.
class Variants {
 public:
  // `overrides` hold for all of them. Throws SceneError for what cannot be read as TOML or applied;
  // whether it is a scene is asked of each variant, which may give what the text leaves out.
  explicit Variants(const std::filesystem::path& file, std::span<const std::string> overrides = {});

  // The scene with `changes` (overrides.h) on top, as read_scene gives it. Throws SceneError.
  // with_text: Scene::text is that of the variant (MuJoCo's plugin reads it); else it is empty.
  Scene scene(std::span<const std::string> changes, bool with_text) const;

  const std::string& text() const { return text_; }  // with the overrides of all

 private:
  std::string file_, text_;
  TomlNode root_;
};

// A file that is read whole. Throws std::runtime_error, with the reason alone ("cannot be read:
// ...", "is a folder ..."), for what is no regular file: a device, to which a link may lead, has no
// end.
std::string regular_file_text(const std::filesystem::path& file);

}  // namespace rotorub::scene
