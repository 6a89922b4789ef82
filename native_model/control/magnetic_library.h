// One user's law for the currents of several magnetic bearings, from a shared library
// (rotorub/controller.h: rotorub_magnetic_controller) or a file of Python.
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
  // Loads the law of the scene's [magnetic_control]. bearings: indices of the magnetic bearings
  // that it commands. If libraries are left out, all currents are 0. Throws scene::SceneError at
  // magnetic_control.library or magnetic_control.config, as LibraryController does.
  MagneticLibrary(const scene::Scene& scene, std::span<const std::size_t> bearings);
  // Replaces the library by currents from elsewhere, A, one per port; step() returns the values
  // that `currents` has at the sample.
  explicit MagneticLibrary(std::shared_ptr<const std::vector<double>> currents)
      : ports_(currents->size()), currents_(std::move(currents)) {}

  // The state is part of the model's coordinates. An MJCF written without opening the library
  // reserves space for the maximum.
  static constexpr std::size_t kMostState = 64;
  // True if the library is left out.
  bool is_left_out() const { return !law_ && !currents_; }
  std::size_t state_size() const { return law_ ? law_->state_size() : kMostState; }
  // state: 0 on entry.
  void start(double* state) const {
    if (law_) law_->start(state);
  }
  // current: A, receives the requested current of each port. Throws ControllerError.
  void step(const rotorub_magnetic_measurement& now, double* state, double* current) const;

 private:
  std::size_t ports_;
  std::shared_ptr<const std::vector<double>> currents_;
  std::optional<LibraryLaw<MagneticLaw>> law_;
};

}  // namespace rotorub
