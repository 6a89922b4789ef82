#include "native_model/control/library_file.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPath = "ROTORUB_CONTROLLER_PATH";

std::mutex mutex;
std::vector<fs::path> scene_folders, allowed_files;
SceneLibraries scene_libraries = SceneLibraries::kAsked;

std::vector<fs::path> folders_of(const std::string& list) {
  std::vector<fs::path> folders;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(':', at), list.size());
    if (end > at) folders.emplace_back(list.substr(at, end - at));
    at = end + 1;
  }
  return folders;
}

// An absolute path without links and "..", for comparison.
fs::path plain(const fs::path& path) {
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failed);
  return failed ? fs::absolute(path) : whole;
}

bool is_allowed(const fs::path& file, const std::vector<fs::path>& open_folders) {
  if (scene_libraries == SceneLibraries::kAllowed) return true;
  const fs::path path = plain(file);
  const auto same = [&path](const fs::path& other) { return plain(other) == path; };
  if (std::any_of(allowed_files.begin(), allowed_files.end(), same)) return true;
  return std::any_of(open_folders.begin(), open_folders.end(), [&path](const fs::path& folder) {
    const fs::path top = plain(folder / "");
    return std::mismatch(top.begin(), top.end(), path.begin(), path.end()).first == top.end() ||
           plain(folder) == path.parent_path();
  });
}

// The first file that exists and is allowed. Throws SceneError otherwise.
fs::path found_in(const scene::Scene& scene, const std::string& key,
                  const std::vector<fs::path>& folders, const fs::path& name,
                  const std::vector<fs::path>& open_folders) {
  std::string looked;
  fs::path refused;
  for (const fs::path& folder : folders) {
    const fs::path path = fs::absolute(folder / name);
    std::error_code status;
    if (!fs::is_regular_file(path, status)) {
      looked += (looked.empty() ? "" : ", ") + path.string();
    } else if (is_allowed(path, open_folders)) {
      return path;
    } else if (refused.empty()) {
      refused = path;
    }
  }
  if (refused.empty()) scene::refuse_at(scene, key, "not found: looked for " + looked);
  scene::refuse_at(
      scene, key,
      refused.string() +
          " is not opened: a scene must not run code by itself; if you trust this one, add "
          "--allow-library (Python: allow_library=True), or set " +
          kPath + " to its folder");
}

}  // namespace

void set_scene_libraries(SceneLibraries which) {
  const std::lock_guard<std::mutex> lock(mutex);
  scene_libraries = which;
}

void allow_library(const fs::path& file) {
  const std::lock_guard<std::mutex> lock(mutex);
  allowed_files.push_back(file);
}

bool libraries_left_out() {
  const std::lock_guard<std::mutex> lock(mutex);
  return scene_libraries == SceneLibraries::kLeftOut;
}

void look_for_controllers_in(const fs::path& folder) {
  const std::lock_guard<std::mutex> lock(mutex);
  const fs::path path = fs::absolute(folder);
  if (std::find(scene_folders.begin(), scene_folders.end(), path) == scene_folders.end()) {
    scene_folders.push_back(path);
  }
}

fs::path library_path(const scene::Scene& scene, const NamedLibrary& library) {
  const std::lock_guard<std::mutex> lock(mutex);
  const fs::path name = library.file;
  const char* path = std::getenv(kPath);
  const std::vector<fs::path> open_folders = folders_of(path == nullptr ? "" : path);
  std::vector<fs::path> folders =
      scene.folder ? std::vector<fs::path>{*scene.folder} : scene_folders;
  folders.insert(folders.end(), open_folders.begin(), open_folders.end());
  if (folders.empty()) {
    scene::refuse_at(scene, library.key,
                     std::string("is not loaded: a model must not load code by itself; set ") +
                         kPath + " to the folder of the libraries that you trust");
  }
  if (!name.is_absolute()) return found_in(scene, library.key, folders, name, open_folders);
  // An MJCF has only absolute paths; they are allowed if the variable is set.
  const bool model = !scene.folder && path != nullptr;
  return found_in(scene, library.key, {""}, name,
                  model ? std::vector<fs::path>{name.parent_path()} : open_folders);
}

std::vector<NamedLibrary> libraries_of(const scene::Scene& scene) {
  std::vector<NamedLibrary> all;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& controller = scene.auxiliary[k].controller;
    if (!controller || controller->kind != scene::ControllerKind::kLibrary) continue;
    all.push_back({scene::place_of(scene, "controller.library", k), controller->library});
  }
  if (scene.magnetic_control && scene.magnetic_control->by_library()) {
    all.push_back({"magnetic_control.library", scene.magnetic_control->library});
  }
  return all;
}

std::vector<std::string> absolute_libraries(const scene::Scene& scene) {
  std::vector<std::string> all;
  for (const NamedLibrary& library : libraries_of(scene))
    all.push_back(library.key + "=" + library_path(scene, library).lexically_normal().string());
  return all;
}

}  // namespace rotorub
