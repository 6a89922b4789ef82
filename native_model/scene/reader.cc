#include "native_model/scene/reader.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "native_model/scene/overrides.h"
#include "native_model/scene/rules.h"
#include "native_model/scene/table_reader.h"
#include "native_model/scene/toml_source.h"
#include "native_model/scene/validate.h"

namespace rotorub::scene {
namespace {

constexpr std::size_t kLargestFile = 16u << 20u;  // bytes; a device or a mistaken file ends here

[[noreturn]] void refuse_file(const std::string& file, const std::string& reason) {
  throw SceneError({{file, 0, {}, reason}});
}

}  // namespace

// Read by blocks rather than by size: a pipe has none.
std::string file_text(const std::filesystem::path& path) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    refuse_file(path.string(), "is a folder; expected a scene file (TOML)");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    refuse_file(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  }
  std::string text;
  std::array<char, 1u << 16u> block{};
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kLargestFile)
      refuse_file(path.string(), "is over 16 MiB, too large for a scene");
  }
  if (file.bad())
    refuse_file(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

std::string folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path().string() : ".";
}

Scene read_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  Scene scene = parse_scene(file_text(path), path.string(), overrides);
  scene.folder = folder_of(path);
  return scene;
}

Scene parse_scene(std::string_view text, const std::string& file_name,
                  std::span<const std::string> overrides) {
  std::vector<Diagnostic> diagnostics;
  std::optional<TomlNode> root = parse_toml(text, file_name, diagnostics);
  if (!root) throw SceneError(std::move(diagnostics));
  apply_overrides(*root, overrides, diagnostics);
  return scene_of(*root, file_name, overrides.empty() ? std::string(text) : write_toml(*root),
                  std::move(diagnostics));
}

Scene scene_of(const TomlNode& root, const std::string& file_name, std::string text,
               std::vector<Diagnostic> diagnostics) {
  Scene scene;
  scene.name = std::filesystem::path(file_name).stem().string();
  scene.text = std::move(text);
  TableReader reader(scene, diagnostics);
  reader.read(root);
  validate(scene, reader.record(), diagnostics);
  check_rules(reader.rules(), reader.record(), diagnostics);
  if (!diagnostics.empty()) throw SceneError(std::move(diagnostics));
  complete(scene, reader.record());
  scene.record = std::make_shared<const Record>(reader.take_record());
  return scene;
}

std::string scene_hash(const Scene& scene) { return text_hash(scene.text); }

std::string text_hash(std::string_view text) {
  constexpr std::uint64_t kOffset = 14695981039346656037u, kPrime = 1099511628211u;
  std::uint64_t hash = kOffset;
  for (char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

}  // namespace rotorub::scene
