// Many scenes from one text: it is read once, and each scene differs in a few values.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

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

}  // namespace rotorub::scene
