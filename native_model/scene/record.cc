#include "native_model/scene/record.h"

#include <utility>

#include "native_model/scene/text.h"

namespace rotorub::scene {

void Record::note(const std::string& path, const TomlNode& node, bool sound,
                  const std::string& written) {
  marks_[path] = {node.file, node.line,         sound,
                  true,      node.items.size(), written == path ? std::string() : written};
}

void Record::move(std::string_view path, const FileName& from, const FileName& to) {
  const auto found = marks_.find(path);
  if (found != marks_.end() && found->second.file == from) found->second.file = to;
}

bool Record::given(std::string_view path) const {
  const auto found = marks_.find(path);
  return found != marks_.end() && found->second.given;
}

std::string Record::place(std::string_view key, std::size_t bearing) const {
  const std::string_view root = key.substr(0, key.find('.'));
  const bool is_contact = root == "contact";
  if (!is_contact && root != "stator" && root != "actuator" && root != "controller")
    return std::string(key);
  const std::string element = list_element("contact", bearing);
  if (!given(element)) return std::string(key);
  return is_contact ? element + std::string(key.substr(root.size()))
                    : element + "." + std::string(key);
}

bool Record::sound(std::string_view path) const {
  const auto found = marks_.find(path);
  return found == marks_.end() || found->second.sound;
}

Diagnostic Record::diagnostic(const std::string& path, std::string reason) const {
  for (std::string above = path;;) {
    const auto found = marks_.find(above);
    if (found != marks_.end() && found->second.given) {
      const std::string& written = found->second.written;
      const bool here = above == path && !written.empty();
      return {found->second.file, found->second.line, here ? written : path, std::move(reason)};
    }
    if (above.empty()) return {{}, 0, path, std::move(reason)};
    const std::size_t cut = above.find_last_of(".[");
    above = cut == std::string::npos ? std::string() : above.substr(0, cut);
  }
}

std::string magnetic_bearing_path(const Scene& scene, std::size_t bearing) {
  const std::string element = list_element("magnetic_bearing", bearing);
  const bool listed = scene.record ? scene.record->given(element) : bearing > 0;
  return listed ? element : "magnetic_bearing";
}

std::string magnetic_bearing_name(const Scene& scene, std::size_t bearing) {
  const std::string path = magnetic_bearing_path(scene, bearing);
  if (!path.ends_with(']')) return "the magnetic bearing";
  return "magnetic bearing " + std::to_string(bearing + 1) + " (" + path + ")";
}

std::vector<Diagnostic> placed(const Scene& scene, std::vector<Diagnostic> diagnostics) {
  for (Diagnostic& d : diagnostics) {
    if (!d.file.empty()) continue;
    if (scene.record) {
      d = scene.record->diagnostic(scene.record->place(d.key, scene.first_index),
                                   std::move(d.reason));
    } else if (!scene.name.empty()) {
      d.file = scene.name + ".toml";
    }
  }
  return diagnostics;
}

std::string place_of(const Scene& scene, const std::string& key, std::size_t bearing) {
  return scene.record ? scene.record->place(key, scene.first_index + bearing) : key;
}

void refuse_at(const Scene& scene, std::string key, std::string reason) {
  throw SceneError(placed(scene, {{"", 0, std::move(key), std::move(reason)}}));
}

void refuse_at(const Scene& scene, std::size_t bearing, const std::string& key,
               std::string reason) {
  refuse_at(scene, place_of(scene, key, bearing), std::move(reason));
}

}  // namespace rotorub::scene
