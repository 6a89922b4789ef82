// Reading a scene from TOML (mjcf/README.md lists every table and key).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub::scene {

// The scene in a file, with the overrides applied ("table.key=value", see overrides.h). Throws
// SceneError with everything that is wrong: unreadable file, syntax, unknown keys and tables,
// types, units, missing keys, impossible values and combinations. A scene that is returned is
// finite and complete: lists that go together have one length, and what has a default holds it.
Scene read_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

// The same from text. `file_name` stands in diagnostics and gives the scene its name.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  std::span<const std::string> overrides = {});

// 16 hexadecimal digits that depend on Scene::text alone: 64-bit FNV-1a.
std::string scene_hash(const Scene& scene);

}  // namespace rotorub::scene
