// A user's law, whichever language it is written in: the functions of rotorub/controller.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "native_model/control/abi/rotorub/controller.h"

namespace rotorub {

// A law that commands the ring of an auxiliary bearing.
struct RingLaw {
  using Functions = rotorub_controller;
  using Setup = rotorub_setup;
  using Measurement = rotorub_measurement;
  static constexpr const char* kSymbol = ROTORUB_CONTROLLER_SYMBOL;
  static constexpr std::uint32_t kAbi = ROTORUB_CONTROLLER_ABI;
};

// A law that commands the currents of magnetic bearings.
struct MagneticLaw {
  using Functions = rotorub_magnetic_controller;
  using Setup = rotorub_magnetic_setup;
  using Measurement = rotorub_magnetic_measurement;
  static constexpr const char* kSymbol = ROTORUB_MAGNETIC_CONTROLLER_SYMBOL;
  static constexpr std::uint32_t kAbi = ROTORUB_MAGNETIC_CONTROLLER_ABI;
};

// Kind is RingLaw or MagneticLaw.
template <class Kind>
class Law {
 public:
  virtual ~Law() = default;
  // The name that messages use.
  virtual std::string name() const = 0;
  // ROTORUB_FORCE or ROTORUB_CURRENT; always ROTORUB_CURRENT for magnetic bearings.
  virtual std::uint32_t command() const = 0;

  // create() and step() return why the law failed; an empty string if it succeeded. create() is
  // called once, before the functions below.
  virtual std::string create(const typename Kind::Setup& setup) = 0;
  virtual std::size_t state_size() const = 0;
  // state: 0 on entry.
  virtual void start(double* state) const = 0;
  // output: receives the command. May be called on several threads.
  virtual std::string step(const typename Kind::Measurement& now, double* state,
                           double* output) const = 0;
};

// Opens the law of a file: of a Python file if its name ends in .py, otherwise of a shared library.
// Throws std::runtime_error with the reason if there is none.
template <class Kind>
std::unique_ptr<Law<Kind>> open_law(const std::filesystem::path& file);

}  // namespace rotorub
