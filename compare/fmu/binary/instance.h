// An instance of the plant for FMI of both versions: values by their references, time, and saved
// states. fmi3.cc and fmi2.cc provide the two interfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "native_model/run/stepwise_run.h"
#include "native_model/scene/scene.h"

namespace rotorub::fmi {

// The same in both versions (FMI 3.0, 2.2.3; FMI 2.0.4, 2.1.3).
enum Status { kOK = 0, kWarning = 1, kDiscard = 2, kError = 3, kFatal = 4 };

using ValueReference = std::uint32_t;
using Log = std::function<void(Status, const std::string&)>;

class Instance {
 public:
  // resources: the folder of that name in the unpacked FMU. token: from its modelDescription.xml;
  // refused if it belongs to a different scene. Throws std::exception.
  Instance(const std::filesystem::path& resources, const std::string& token, Log log);

  // Runs `action`; an exception becomes an error that is logged.
  template <class Action>
  Status guarded(Action action) {
    try {
      return action();
    } catch (const std::exception& error) {
      return refuse(error.what());
    }
  }
  Status refuse(const std::string& why) const {
    log_(kError, why);
    return kError;
  }

  // Each reference must be a variable of that type: whole numbers, or others.
  template <class Number>
  Status get(const ValueReference* of, std::size_t count, Number* values);
  Status set(const ValueReference* of, std::size_t count, const double* values);

  Status enter_initialization(double start, bool has_stop, double stop);
  Status exit_initialization();
  Status reset();
  // From `from` over `length`, s. events: the step may return early at an event, which then waits.
  Status do_step(double from, double length, bool events);
  Status pass_event();
  double time() const { return run_.time(); }
  bool event_waits() const { return run_.event_waits(); }

  // *state: null, or a state to be replaced.
  Status save(void** state) const;
  Status restore(const void* state);
  static void forget(void** state);

  bool event_mode = false, early_return = false;  // supported by the importer

 private:
  bool begin_anew();

  Log log_;
  scene::Scene scene_;
  StepwiseRun run_;
  double stop_;                // s
  bool initializing_ = false;  // the inputs still have their start values
  bool changed_ = false;
};

}  // namespace rotorub::fmi
