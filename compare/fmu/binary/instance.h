// An instance of the plant for FMI of both versions: values by their references, time, and saved
// states. fmi3.cc and fmi2.cc provide the two interfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "native_model/run/stepwise_run.h"
#include "native_model/scene/adjustable.h"
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

  Status refuse(const std::string& why) const {
    log_(kError, why);
    return kError;
  }

  // Each reference must be a variable of that type: whole numbers, or others. Inputs can be set at
  // any time, parameters until the end of the initialization.
  template <class Number>
  Status get(const ValueReference* of, std::size_t count, Number* values);
  Status set(const ValueReference* of, std::size_t count, const double* values);

  Status enter_initialization(double start, bool has_stop, double stop);
  Status exit_initialization();
  Status reset();
  // From `from` over `length`, s. events: the step may return early at an event, which then waits.
  Status do_step(double from, double length, bool events);
  Status pass_event();
  double time() const { return run().time(); }
  bool event_waits() const { return run().event_waits(); }

  // *state: null, or a state to be replaced.
  Status save(void** state) const;
  Status restore(const void* state);
  static void forget(void** state);

  bool event_mode = false, early_return = false;  // supported by the importer

 private:
  // The run of the scene with one set of values of its parameters. A saved state keeps the plant to
  // which it belongs.
  struct Plant {
    Plant(const scene::Scene& scene, std::vector<double> values)
        : run(scene), parameters(std::move(values)) {}
    StepwiseRun run;
    std::vector<double> parameters;
  };
  struct Kept;

  StepwiseRun& run() { return plant_->run; }
  const StepwiseRun& run() const { return plant_->run; }
  // Throws std::runtime_error if the scene refuses the values.
  std::shared_ptr<Plant> plant_with(const std::vector<double>& values) const;
  Status set_parameter(std::size_t parameter, double value);
  bool begin_anew();

  Log log_;
  std::filesystem::path file_;  // of the scene
  std::vector<scene::Adjustable> parameters_;
  std::shared_ptr<Plant> plant_;
  std::vector<double> values_;  // of the parameters, as set
  double end_of_scene_ = 0.0;   // s
  double stop_ = 0.0;           // s
  bool initializing_ = false;   // inputs and parameters still have their start values
  bool initialized_ = false;    // parameters are fixed
  bool changed_ = false;        // one of them has been set since the run began
};

inline Instance* of(void* instance) { return static_cast<Instance*>(instance); }

// Calls a function of the instance; an exception becomes an error that is logged.
template <class Function, class... Arguments>
Status call(void* instance, Function function, Arguments... arguments) {
  try {
    return std::invoke(function, of(instance), arguments...);
  } catch (const std::exception& error) {
    return of(instance)->refuse(error.what());
  }
}

inline Status not_offered(void* instance, const char* function) {
  return of(instance)->refuse(std::string(function) + " is for what this FMU does not offer");
}

}  // namespace rotorub::fmi
