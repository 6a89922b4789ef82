// FMI 2.0 for Co-Simulation: the functions of the standard (chapters 2.1 and 4.2). Events are
// handled within a step.

#include <cctype>

#include "compare/fmu/binary/instance.h"

namespace {

using rotorub::fmi::call;
using rotorub::fmi::Instance;
using rotorub::fmi::kDiscard;
using rotorub::fmi::kError;
using rotorub::fmi::kOK;
using rotorub::fmi::not_offered;
using rotorub::fmi::of;
using rotorub::fmi::Status;
using rotorub::fmi::ValueReference;

struct Callbacks {
  void (*log)(void* environment, const char* instance, Status status, const char* category,
              const char* message, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*step_finished)(void*, Status);
  void* environment;
};

// The folder of a location: file:///folder or file:/folder, with %20 for a blank.
std::string folder_of(std::string location) {
  for (const char* begins : {"file://localhost", "file://", "file:"}) {
    if (!location.starts_with(begins)) continue;
    location.erase(0, std::string(begins).size());
    break;
  }
  std::string folder;
  for (std::size_t i = 0; i < location.size(); ++i) {
    const bool coded = location[i] == '%' && i + 2 < location.size() &&
                       std::isxdigit(static_cast<unsigned char>(location[i + 1])) &&
                       std::isxdigit(static_cast<unsigned char>(location[i + 2]));
    folder +=
        coded ? static_cast<char>(std::stoi(location.substr(i + 1, 2), nullptr, 16)) : location[i];
    if (coded) i += 2;
  }
  return folder;
}

constexpr int kCoSimulation = 1;

}  // namespace

#define FMI2(type, name, ...) extern "C" type fmi2##name(__VA_ARGS__)
#define NOT_OFFERED(name, ...)                                    \
  FMI2(Status, name, void* instance __VA_OPT__(, ) __VA_ARGS__) { \
    return not_offered(instance, "fmi2" #name);                   \
  }

FMI2(const char*, GetTypesPlatform) { return "default"; }
FMI2(const char*, GetVersion) { return "2.0"; }
FMI2(Status, SetDebugLogging, void*, int, size_t, const char* const*) { return kOK; }

FMI2(void*, Instantiate, const char* name, int type, const char* guid, const char* resources,
     const Callbacks* callbacks, int, int) {
  const auto log = [call = *callbacks, name = std::string(name)](Status status,
                                                                 const std::string& message) {
    if (call.log)
      call.log(call.environment, name.c_str(), status, "logStatusError", "%s", message.c_str());
  };
  try {
    if (type != kCoSimulation) throw std::runtime_error("this FMU is for Co-Simulation");
    if (resources == nullptr || guid == nullptr)
      throw std::runtime_error("the folder of the resources, which hold the scene, is needed");
    return new Instance(folder_of(resources), guid, log);
  } catch (const std::exception& error) {
    log(kError, error.what());
    return nullptr;
  }
}
FMI2(void, FreeInstance, void* instance) { delete of(instance); }

FMI2(Status, SetupExperiment, void* instance, int, double, double start, int has_stop,
     double stop) {
  return call(instance, &Instance::enter_initialization, start, has_stop != 0, stop);
}
FMI2(Status, EnterInitializationMode, void*) { return kOK; }
FMI2(Status, ExitInitializationMode, void* instance) {
  return call(instance, &Instance::exit_initialization);
}
FMI2(Status, Terminate, void*) { return kOK; }
FMI2(Status, Reset, void* instance) { return call(instance, &Instance::reset); }

FMI2(Status, GetReal, void* instance, const ValueReference* references, size_t count,
     double* values) {
  return call(instance, &Instance::get<double>, references, count, values);
}
FMI2(Status, GetInteger, void* instance, const ValueReference* references, size_t count,
     std::int32_t* values) {
  return call(instance, &Instance::get<std::int32_t>, references, count, values);
}
FMI2(Status, SetReal, void* instance, const ValueReference* references, size_t count,
     const double* values) {
  return call(instance, &Instance::set, references, count, values);
}
FMI2(Status, DoStep, void* instance, double from, double length, int) {
  return call(instance, &Instance::do_step, from, length, false);
}

FMI2(Status, GetFMUstate, void* instance, void** state) {
  return call(instance, &Instance::save, state);
}
FMI2(Status, SetFMUstate, void* instance, void* state) {
  return call(instance, &Instance::restore, state);
}
FMI2(Status, FreeFMUstate, void*, void** state) {
  Instance::forget(state);
  return kOK;
}

// The importer asks for these when a step was discarded or is asynchronous, which never happens.
FMI2(Status, GetStatus, void*, int, Status*) { return kDiscard; }
FMI2(Status, GetRealStatus, void* instance, int kind, double* value) {
  constexpr int kLastSuccessfulTime = 2;
  if (kind != kLastSuccessfulTime) return kDiscard;
  *value = of(instance)->time();
  return kOK;
}
FMI2(Status, GetIntegerStatus, void*, int, int*) { return kDiscard; }
FMI2(Status, GetBooleanStatus, void*, int, int*) { return kDiscard; }
FMI2(Status, GetStringStatus, void*, int, const char**) { return kDiscard; }

NOT_OFFERED(GetBoolean, const ValueReference*, size_t, int*)
NOT_OFFERED(GetString, const ValueReference*, size_t, const char**)
NOT_OFFERED(SetInteger, const ValueReference*, size_t, const int*)
NOT_OFFERED(SetBoolean, const ValueReference*, size_t, const int*)
NOT_OFFERED(SetString, const ValueReference*, size_t, const char* const*)
NOT_OFFERED(SerializedFMUstateSize, void*, size_t*)
NOT_OFFERED(SerializeFMUstate, void*, char*, size_t)
NOT_OFFERED(DeSerializeFMUstate, const char*, size_t, void**)
NOT_OFFERED(GetDirectionalDerivative, const ValueReference*, size_t, const ValueReference*, size_t,
            const double*, double*)
NOT_OFFERED(SetRealInputDerivatives, const ValueReference*, size_t, const int*, const double*)
NOT_OFFERED(GetRealOutputDerivatives, const ValueReference*, size_t, const int*, double*)
NOT_OFFERED(CancelStep)
