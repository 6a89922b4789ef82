#include "native_model/scene/variants.h"

#include <optional>
#include <utility>
#include <vector>

#include "native_model/scene/overrides.h"
#include "native_model/scene/reader.h"

namespace rotorub::scene {

Variants::Variants(const std::filesystem::path& file, std::span<const std::string> overrides)
    : file_(file.string()), text_(file_text(file)) {
  std::vector<Diagnostic> diagnostics;
  std::optional<TomlNode> root = parse_toml(text_, file_, diagnostics);
  if (!root || !diagnostics.empty()) throw SceneError(std::move(diagnostics));
  apply_overrides(*root, overrides, diagnostics);
  if (!diagnostics.empty()) throw SceneError(std::move(diagnostics));
  root_ = std::move(*root);
  if (!overrides.empty()) text_ = write_toml(root_);
}

Scene Variants::scene(std::span<const std::string> changes, bool with_text) const {
  std::vector<Diagnostic> diagnostics;
  TomlNode root = root_;
  apply_overrides(root, changes, diagnostics);
  std::string text = with_text ? write_toml(root) : std::string();
  Scene scene = scene_of(root, file_, std::move(text), std::move(diagnostics));
  scene.folder = folder_of(file_);
  return scene;
}

}  // namespace rotorub::scene
