#include "native_model/scene/reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "native_model/scene/overrides.h"
#include "native_model/scene/reading.h"
#include "native_model/scene/text.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {
namespace {

// The folder of a scene's file, where relative paths of the scene start.
std::string folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path().string() : ".";
}

// bytes; limits the reading of devices and of files given by mistake
constexpr std::size_t kLargestFile = 16u << 20u;

// Reads in blocks, because a pipe has no size. Throws std::runtime_error with the reason alone.
std::string text_in(const std::filesystem::path& path, const char* expected, std::size_t most) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    throw std::runtime_error(std::string("is a folder; expected ") + expected);
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 1u << 16u> block{};
  while (file && (file.read(block.data(), block.size()) || file.gcount() > 0)) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > most) throw std::runtime_error("is over 16 MiB, too large for a scene");
  }
  if (!file.is_open() || file.bad())
    throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

// ", did you mean ring.toml?" for the name of a missing file that misspells a scene or study beside
// it; else empty.
std::string near_file(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::exists(path, none)) return {};
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(folder_of(path), none)) {
    if (entry.path().extension() == ".toml") stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end());
  const std::vector<std::string_view> known(stems.begin(), stems.end());
  const std::string_view meant = nearest(path.stem().string(), known);
  return meant.empty() ? "" : ", did you mean " + printable(meant) + ".toml?";
}

// Refuses a study with one sentence, because none of its keys belongs to a scene.
void refuse_study(const TomlNode& root) {
  if (root.find("rotor") != nullptr) return;
  for (const char* key : {"scene", "sample", "vary", "optimise"}) {
    const TomlNode* found = root.find(key);
    if (found == nullptr) continue;
    const TomlNode* scene = root.find("scene");
    const bool named = scene != nullptr && scene->kind == TomlNode::Kind::kString;
    throw SceneError({{found->file, found->line, key,
                       std::string("this file is a study, not a scene; give it to `rotorub ") +
                           (root.find("optimise") != nullptr ? "optimise" : "sweep") +
                           "`, or give its scene" + (named ? ", \"" + scene->text + "\"" : "")}});
  }
}

// Makes the scene from the tree of `text`. `diagnostics`: faults found so far.
Scene scene_of(TomlNode root, const std::string& file_name, std::string text,
               std::vector<Diagnostic> diagnostics) {
  Scene scene;
  scene.name = std::filesystem::path(file_name).stem().string();
  scene.text = std::move(text);
  Reading reading(scene, diagnostics);
  reading.read(root);
  reading.check();
  if (!diagnostics.empty()) throw SceneError(std::move(diagnostics));
  complete(scene);
  return scene;
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
  try {
    return text_in(path, "a scene file (TOML)", kLargestFile);
  } catch (const std::runtime_error& error) {
    throw SceneError({{path.string(), 0, {}, error.what() + near_file(path)}});
  }
}

std::string regular_file_text(const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(file, none);
  if (std::filesystem::is_other(status))
    throw std::runtime_error("is a device or a pipe; expected a file");
  return text_in(file, "a file", std::string::npos);
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
  refuse_study(*root);
  apply_overrides(*root, overrides, diagnostics);
  std::string applied = overrides.empty() ? std::string(text) : write_toml(*root);
  return scene_of(std::move(*root), file_name, std::move(applied), std::move(diagnostics));
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
  Scene scene = scene_of(std::move(root), file_, std::move(text), std::move(diagnostics));
  scene.folder = folder_of(file_);
  return scene;
}

}  // namespace rotorub::scene
