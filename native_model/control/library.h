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
  // Throws scene::SceneError at controller.library or controller.config: the library is not found or
  // not to be loaded, has another ABI, or refuses what it is told.
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

// Where a scene's library is: relative to the scene's file; of a scene that comes in an MJCF,
// absolute or below one of the folders of ROTORUB_CONTROLLER_PATH (with ':' between them), and
// only where that variable is set: a model that is opened must not load code by itself. Throws
// scene::SceneError.
std::filesystem::path controller_library(const scene::Scene& scene);

// A program that was given the scene itself lets its MJCF load libraries of that folder.
void trust_controllers_of(const std::filesystem::path& folder);

}  // namespace rotorub
