// A controller of the user's, from a shared library (rotorub/controller.h).
#pragma once

#include <filesystem>

#include "native_model/control/controller.h"
#include "native_model/control/library_file.h"
#include "native_model/control/library_law.h"

namespace rotorub {

class LibraryController final : public Controller {
 public:
  // Throws scene::SceneError at controller.library or controller.config: the library is not found
  // or not to be loaded, has another ABI, or refuses what it is given.
  LibraryController(const scene::Scene& scene, const Plant& plant);

  std::size_t state_size() const override { return law_.state_size(); }
  void start(double* state) const override { law_.start(state); }
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double* state) const override;
  bool commands_currents() const override;

 private:
  LibraryLaw<rotorub_controller> law_;
};

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

}  // namespace rotorub
