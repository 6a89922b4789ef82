// The files of users' laws that a scene names (shared libraries and Python): where they may come
// from, and which may be opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// Code that comes with a file must not run unasked. A library that a scene names is opened only if
// it lies in or below one of the folders of ROTORUB_CONTROLLER_PATH (separated by ':'), or if the
// user has allowed it. This setting applies to the whole process.
enum class SceneLibraries {
  kAsked,    // the file must be allowed: allow_library()
  kAllowed,  // every library that a scene names
  kLeftOut,  // none is opened, their commands are 0; for programs that only show scenes
};
void set_scene_libraries(SceneLibraries which);
void allow_library(const std::filesystem::path& file);
bool libraries_left_out();

// Adds a folder in which the libraries of MJCF scenes are searched. Programs that read the scene
// file itself add the folder of that file.
void look_for_controllers_in(const std::filesystem::path& folder);

// A library and the key that names it, for example "controller.library".
struct NamedLibrary {
  std::string key, file;
};
std::vector<NamedLibrary> libraries_of(const scene::Scene& scene);

// The path of a library. It is searched beside the scene file and in the folders of
// ROTORUB_CONTROLLER_PATH. A scene from an MJCF has no folder: its libraries are searched in the
// folders of look_for_controllers_in() and of that variable, and an absolute path is allowed if the
// variable is set. Throws scene::SceneError if the library is not found or not allowed.
std::filesystem::path library_path(const scene::Scene& scene, const NamedLibrary& library);
// Overrides "controller.library=/home/rig/law.so" with the absolute paths of a scene's libraries,
// for a copy of the scene in another folder, where a relative path would lead elsewhere.
std::vector<std::string> absolute_libraries(const scene::Scene& scene);

}  // namespace rotorub
