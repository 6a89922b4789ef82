// Shared libraries of the user's that a scene names: where they may come from, and how they are
// opened.
#pragma once

#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// Code that comes with a file is not run unasked: what a scene names is opened only if it stands in
// one of the folders of ROTORUB_CONTROLLER_PATH (with ':' between them), or the user has allowed
// it. Of the whole process.
enum class SceneLibraries {
  kAsked,    // the file must be allowed: allow_library()
  kAllowed,  // whatever a scene names
  kLeftOut,  // none is opened, in its place stands what commands nothing: of what shows a scene and
             // does not run it
};
void set_scene_libraries(SceneLibraries which);
void allow_library(const std::filesystem::path& file);
bool libraries_left_out();

// A program that was given the scene itself lets its MJCF look for libraries in that folder too.
void look_for_controllers_in(const std::filesystem::path& folder);

// A library, and the key that names it: "controller.library".
struct NamedLibrary {
  std::string key, file;
};
std::vector<NamedLibrary> libraries_of(const scene::Scene& scene);

// Where it is: beside the scene's file, or in a folder of ROTORUB_CONTROLLER_PATH; of a scene that
// comes in an MJCF in such a folder, or absolute where that variable is set. Throws
// scene::SceneError where there is none, or it is not allowed.
std::filesystem::path library_path(const scene::Scene& scene, const NamedLibrary& library);

// Open until the last owner goes. Throws scene::SceneError.
std::shared_ptr<void> opened_library(const scene::Scene& scene, const NamedLibrary& library,
                                     const std::filesystem::path& path);
// Null: it has no such symbol.
void* symbol_of(void* library, const char* name);

inline constexpr std::size_t kReasonRoom = 512;  // bytes
// What the library says, printable, ended by 0 or not.
std::string library_reason(const char* reason);
std::string printable_reason(const std::string& text);

// `action` of the library: what it throws is its failure. Empty: done.
template <typename Action>
std::string failure_of(Action action) {
  std::array<char, kReasonRoom> reason{};
  try {
    return action(reason.data()) == 0 ? "" : library_reason(reason.data());
  } catch (const std::exception& error) {
    return printable_reason(error.what());
  } catch (...) {
    return "it threw what is no std::exception";
  }
}

}  // namespace rotorub
