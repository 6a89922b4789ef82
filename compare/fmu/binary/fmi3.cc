// FMI 3.0 for Co-Simulation, with event mode. An FMU must have all functions of the standard
// (chapters 2.2, 2.3 and 4.2); those for unsupported features return an error.

#include <limits>

#include "compare/fmu/binary/instance.h"

namespace {

using rotorub::fmi::call;
using rotorub::fmi::Instance;
using rotorub::fmi::kError;
using rotorub::fmi::kOK;
using rotorub::fmi::not_offered;
using rotorub::fmi::of;
using rotorub::fmi::Status;
using rotorub::fmi::ValueReference;

using LogMessage = void (*)(void* environment, Status status, const char* category,
                            const char* message);
using IntermediateUpdate = void (*)(void*, double, bool, bool, bool, bool, bool*, double*);

}  // namespace

#define FMI3(type, name, ...) extern "C" type fmi3##name(__VA_ARGS__)
// A function that only returns an error; the arguments after the instance.
#define NOT_OFFERED(name, ...)                                    \
  FMI3(Status, name, void* instance __VA_OPT__(, ) __VA_ARGS__) { \
    return not_offered(instance, "fmi3" #name);                   \
  }
// Access to values of a type that no variable has: only an empty list is accepted.
#define NO_VARIABLES(name, ...)                                                                   \
  FMI3(Status, name, void* instance, const ValueReference*,                                       \
       size_t count __VA_OPT__(, ) __VA_ARGS__) {                                                 \
    return count == 0 ? kOK : of(instance)->refuse("fmi3" #name ": no variable is of this type"); \
  }

// ------------------------------------------------------------------ instances
FMI3(const char*, GetVersion) { return "3.0"; }

FMI3(void*, InstantiateCoSimulation, const char*, const char* token, const char* resources, bool,
     bool, bool event_mode, bool early_return, const ValueReference*, size_t intermediate,
     void* environment, LogMessage log_message, IntermediateUpdate) {
  const auto log = [=](Status status, const std::string& message) {
    if (log_message) log_message(environment, status, "logStatusError", message.c_str());
  };
  try {
    if (intermediate > 0) throw std::runtime_error("no variable is given between the steps");
    if (resources == nullptr || token == nullptr)
      throw std::runtime_error("the folder of the resources, which hold the scene, is needed");
    auto instance = std::make_unique<Instance>(resources, token, log);
    instance->event_mode = event_mode;
    instance->early_return = early_return;
    return instance.release();
  } catch (const std::exception& error) {
    log(kError, error.what());
    return nullptr;
  }
}
FMI3(void, FreeInstance, void* instance) { delete of(instance); }
FMI3(Status, SetDebugLogging, void*, bool, size_t, const char* const*) { return kOK; }

FMI3(Status, EnterInitializationMode, void* instance, bool, double, double start, bool has_stop,
     double stop) {
  return call(instance, &Instance::enter_initialization, start, has_stop, stop);
}
FMI3(Status, ExitInitializationMode, void* instance) {
  return call(instance, &Instance::exit_initialization);
}
FMI3(Status, Terminate, void*) { return kOK; }
FMI3(Status, Reset, void* instance) { return call(instance, &Instance::reset); }

// ------------------------------------------------------------------ values
FMI3(Status, GetFloat64, void* instance, const ValueReference* references, size_t count,
     double* values, size_t) {
  return call(instance, &Instance::get<double>, references, count, values);
}
FMI3(Status, GetInt32, void* instance, const ValueReference* references, size_t count,
     std::int32_t* values, size_t) {
  return call(instance, &Instance::get<std::int32_t>, references, count, values);
}
FMI3(Status, SetFloat64, void* instance, const ValueReference* references, size_t count,
     const double* values, size_t) {
  return call(instance, &Instance::set, references, count, values);
}
NO_VARIABLES(GetFloat32, float*, size_t)
NO_VARIABLES(GetInt8, std::int8_t*, size_t)
NO_VARIABLES(GetUInt8, std::uint8_t*, size_t)
NO_VARIABLES(GetInt16, std::int16_t*, size_t)
NO_VARIABLES(GetUInt16, std::uint16_t*, size_t)
NO_VARIABLES(GetUInt32, std::uint32_t*, size_t)
NO_VARIABLES(GetInt64, std::int64_t*, size_t)
NO_VARIABLES(GetUInt64, std::uint64_t*, size_t)
NO_VARIABLES(GetBoolean, bool*, size_t)
NO_VARIABLES(GetString, const char**, size_t)
NO_VARIABLES(GetBinary, size_t*, const std::uint8_t**, size_t)
NO_VARIABLES(GetClock, bool*)
NO_VARIABLES(SetFloat32, const float*, size_t)
NO_VARIABLES(SetInt8, const std::int8_t*, size_t)
NO_VARIABLES(SetUInt8, const std::uint8_t*, size_t)
NO_VARIABLES(SetInt16, const std::int16_t*, size_t)
NO_VARIABLES(SetUInt16, const std::uint16_t*, size_t)
NO_VARIABLES(SetInt32, const std::int32_t*, size_t)
NO_VARIABLES(SetUInt32, const std::uint32_t*, size_t)
NO_VARIABLES(SetInt64, const std::int64_t*, size_t)
NO_VARIABLES(SetUInt64, const std::uint64_t*, size_t)
NO_VARIABLES(SetBoolean, const bool*, size_t)
NO_VARIABLES(SetString, const char* const*, size_t)
NO_VARIABLES(SetBinary, const size_t*, const std::uint8_t* const*, size_t)
NO_VARIABLES(SetClock, const bool*)

// ------------------------------------------------------------------ steps and events
FMI3(Status, EnterStepMode, void*) { return kOK; }
FMI3(Status, EnterEventMode, void* instance) {
  return of(instance)->event_mode ? kOK
                                  : of(instance)->refuse(
                                        "event mode: the importer said that it "
                                        "does without (eventModeUsed)");
}
FMI3(Status, UpdateDiscreteStates, void* instance, bool* need_update, bool* terminate,
     bool* nominals_changed, bool* values_changed, bool* has_next_event, double* next_event) {
  *need_update = *terminate = *nominals_changed = *values_changed = *has_next_event = false;
  *next_event = std::numeric_limits<double>::infinity();
  return call(instance, &Instance::pass_event);
}
FMI3(Status, EvaluateDiscreteStates, void*) { return kOK; }

FMI3(Status, DoStep, void* instance, double from, double length, bool, bool* event_handling,
     bool* terminate, bool* early_return, double* last_time) {
  Instance& plant = *of(instance);
  const Status status =
      call(instance, &Instance::do_step, from, length, plant.event_mode && plant.early_return);
  *terminate = false;
  *last_time = plant.time();
  *event_handling = plant.event_waits();
  *early_return = status == kOK && plant.time() < from + length;
  return status;
}

// ------------------------------------------------------------------ states
FMI3(Status, GetFMUState, void* instance, void** state) {
  return call(instance, &Instance::save, state);
}
FMI3(Status, SetFMUState, void* instance, void* state) {
  return call(instance, &Instance::restore, state);
}
FMI3(Status, FreeFMUState, void*, void** state) {
  Instance::forget(state);
  return kOK;
}

// ------------------------------------------------------------------ unsupported features
NOT_OFFERED(SerializedFMUStateSize, void*, size_t*)
NOT_OFFERED(SerializeFMUState, void*, std::uint8_t*, size_t)
NOT_OFFERED(DeserializeFMUState, const std::uint8_t*, size_t, void**)
NOT_OFFERED(GetNumberOfVariableDependencies, ValueReference, size_t*)
NOT_OFFERED(GetVariableDependencies, ValueReference, size_t*, ValueReference*, size_t*, int*,
            size_t)
NOT_OFFERED(GetDirectionalDerivative, const ValueReference*, size_t, const ValueReference*, size_t,
            const double*, size_t, double*, size_t)
NOT_OFFERED(GetAdjointDerivative, const ValueReference*, size_t, const ValueReference*, size_t,
            const double*, size_t, double*, size_t)
NOT_OFFERED(GetOutputDerivatives, const ValueReference*, size_t, const std::int32_t*, double*,
            size_t)
NOT_OFFERED(EnterConfigurationMode)
NOT_OFFERED(ExitConfigurationMode)
// Clocks
NOT_OFFERED(GetIntervalDecimal, const ValueReference*, size_t, double*, int*)
NOT_OFFERED(GetIntervalFraction, const ValueReference*, size_t, std::uint64_t*, std::uint64_t*,
            int*)
NOT_OFFERED(GetShiftDecimal, const ValueReference*, size_t, double*)
NOT_OFFERED(GetShiftFraction, const ValueReference*, size_t, std::uint64_t*, std::uint64_t*)
NOT_OFFERED(SetIntervalDecimal, const ValueReference*, size_t, const double*)
NOT_OFFERED(SetIntervalFraction, const ValueReference*, size_t, const std::uint64_t*,
            const std::uint64_t*)
NOT_OFFERED(SetShiftDecimal, const ValueReference*, size_t, const double*)
NOT_OFFERED(SetShiftFraction, const ValueReference*, size_t, const std::uint64_t*,
            const std::uint64_t*)
NOT_OFFERED(ActivateModelPartition, ValueReference, double)
// Model Exchange
FMI3(void*, InstantiateModelExchange, const char*, const char*, const char*, bool, bool,
     void* environment, LogMessage log_message) {
  if (log_message)
    log_message(environment, kError, "logStatusError", "this FMU is for Co-Simulation");
  return nullptr;
}
FMI3(void*, InstantiateScheduledExecution, const char*, const char*, const char*, bool, bool,
     void* environment, LogMessage log_message, void (*)(void*), void (*)(), void (*)()) {
  if (log_message)
    log_message(environment, kError, "logStatusError", "this FMU is for Co-Simulation");
  return nullptr;
}
NOT_OFFERED(EnterContinuousTimeMode)
NOT_OFFERED(CompletedIntegratorStep, bool, bool*, bool*)
NOT_OFFERED(SetTime, double)
NOT_OFFERED(SetContinuousStates, const double*, size_t)
NOT_OFFERED(GetContinuousStateDerivatives, double*, size_t)
NOT_OFFERED(GetEventIndicators, double*, size_t)
NOT_OFFERED(GetContinuousStates, double*, size_t)
NOT_OFFERED(GetNominalsOfContinuousStates, double*, size_t)
NOT_OFFERED(GetNumberOfEventIndicators, size_t*)
NOT_OFFERED(GetNumberOfContinuousStates, size_t*)
