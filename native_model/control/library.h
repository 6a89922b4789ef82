// A user's controller from a file: a shared library (rotorub/controller.h), or a file of Python.
#pragma once

#include <cstddef>

#include "native_model/control/controller.h"
#include "native_model/control/library_file.h"
#include "native_model/control/library_law.h"

namespace rotorub {

class LibraryController final : public Controller {
 public:
  // The controller of an auxiliary bearing. Throws scene::SceneError at controller.library or
  // controller.config if the library is not found, cannot be loaded, has another ABI, or rejects
  // its setup.
  LibraryController(const scene::Scene& scene, std::size_t bearing, const Plant& plant);

  std::size_t state_size() const override { return law_.state_size(); }
  void start(double* state) const override { law_.start(state); }
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double* state) const override;
  bool commands_currents() const override;

 private:
  LibraryLaw<RingLaw> law_;
};

// Stands in for a library that is not opened; its command is 0. An MJCF reserves this much space
// for the library's state. If the library needs more, the plugin reports how much.
class UnopenedLibrary final : public Controller {
 public:
  static constexpr std::size_t kRoomForState = 256;  // doubles
  std::size_t state_size() const override { return kRoomForState; }
  bool is_left_out() const override { return true; }
  Eigen::Vector2d command(const Measurement&, const SwitchOn&, double*) const override {
    return {0.0, 0.0};
  }
};

}  // namespace rotorub
