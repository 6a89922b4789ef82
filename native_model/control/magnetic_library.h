// One law of the user's for the currents of magnetic bearings together, from a shared library
// (rotorub/controller.h: rotorub_magnetic_controller).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "native_model/control/library_law.h"

namespace rotorub {

class MagneticLibrary {
 public:
  // Of the scene's [magnetic_control]; bearings: those of its list that it commands. Where
  // libraries are left out it commands nothing. Throws scene::SceneError at
  // magnetic_control.library or magnetic_control.config, as LibraryController.
  MagneticLibrary(const scene::Scene& scene, std::span<const std::size_t> bearings);
  // In its place currents that others give, A, of each port: those at the sample are asked for.
  explicit MagneticLibrary(std::shared_ptr<const std::vector<double>> told)
      : ports_(told->size()), told_(std::move(told)) {}

  // Its state is coordinates of the model; an MJCF that is written without opening the library has
  // room for the most.
  static constexpr std::size_t kMostState = 64;
  std::size_t state_size() const { return law_ ? law_->state_size() : kMostState; }
  // state: 0 before.
  void start(double* state) const {
    if (law_) law_->start(state);
  }
  // current: A, one of each port, asked for. Throws ControllerError.
  void step(const rotorub_magnetic_measurement& now, double* state, double* current) const;

 private:
  std::size_t ports_;
  std::shared_ptr<const std::vector<double>> told_;
  std::optional<LibraryLaw<rotorub_magnetic_controller>> law_;
};

}  // namespace rotorub
