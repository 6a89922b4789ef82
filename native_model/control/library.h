// A controller of the user's, from a shared library (rotorub/controller.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "native_model/control/controller.h"

struct rotorub_controller;

namespace rotorub {

class LibraryController final : public Controller {
 public:
  // Throws scene::SceneError at controller.library or controller.config: the library is not found
  // or not to be loaded, has another ABI, or refuses what it is given.
  LibraryController(const scene::Scene& scene, const Plant& plant);
  ~LibraryController() override;
  LibraryController(const LibraryController&) = delete;
  LibraryController& operator=(const LibraryController&) = delete;

  std::size_t state_size() const override { return state_size_; }
  void start(double* state) const override;
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double* state) const override;
  bool commands_currents() const override;

 private:
  // Loaded and of this ABI, with nothing created yet.
  LibraryController(const scene::Scene& scene, const std::filesystem::path& path);
  void create(const scene::Scene& scene, const Plant& plant);
  [[noreturn]] void fail(double t, const std::string& reason) const;

  std::shared_ptr<void> library_;  // keeps what `functions_` points to
  const rotorub_controller* functions_ = nullptr;
  void* self_ = nullptr;
  bool created_ = false;
  std::size_t state_size_ = 0;
  std::string name_;
};

// Code that comes with a file is not run unasked: what a scene names is opened only if it stands in
// one of the folders of ROTORUB_CONTROLLER_PATH (with ':' between them), or the user has allowed
// it. Of the whole process.
enum class SceneLibraries {
  kAsked,    // the file must be allowed: allow_library()
  kAllowed,  // whatever a scene names
  kLeftOut,  // none is opened, in its place stands UnopenedLibrary: of what shows a scene and does
             // not run it
};
void set_scene_libraries(SceneLibraries which);
void allow_library(const std::filesystem::path& file);
bool libraries_left_out();

// Commands nothing. An MJCF leaves this much room for the library's state; where that needs more,
// the plugin says how much.
class UnopenedLibrary final : public Controller {
 public:
  static constexpr std::size_t kRoomForState = 256;  // numbers
  std::size_t state_size() const override { return kRoomForState; }
  Eigen::Vector2d command(const Measurement&, const SwitchOn&, double*) const override {
    return {0.0, 0.0};
  }
};

// Where a scene's library is: beside the scene's file, or in a folder of ROTORUB_CONTROLLER_PATH;
// of a scene that comes in an MJCF in such a folder, or absolute where that variable is set. Throws
// scene::SceneError where there is none, or it is not allowed.
std::filesystem::path controller_library(const scene::Scene& scene);

// A program that was given the scene itself lets its MJCF look for libraries in that folder too.
void look_for_controllers_in(const std::filesystem::path& folder);

}  // namespace rotorub
