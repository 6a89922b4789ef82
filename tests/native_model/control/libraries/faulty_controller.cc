// A controller with the fault that [controller.config] fault = "..." selects. Otherwise it commands
// (state, k): its count, and the number of the sample.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include <rotorub/controller.h>

namespace {

struct Law {
  std::string fault;
  double at = 0.0;  // s, when it goes wrong
};

int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  auto* law = new Law;
  for (size_t i = 0; i < setup->entries; ++i) {
    const rotorub_entry& e = setup->config[i];
    if (std::strcmp(e.key, "fault") == 0 && e.text != nullptr) law->fault = e.text;
    if (std::strcmp(e.key, "at") == 0) law->at = e.number;
  }
  if (law->fault == "create") {
    std::snprintf(reason, room, "it does not like the number %g", law->at);
    delete law;
    return 1;
  }
  if (law->fault == "throw in create") {
    delete law;
    throw std::runtime_error("thrown in create");
  }
  *self = law;
  return 0;
}

void destroy(void* self) { delete static_cast<Law*>(self); }

size_t state_size(const void* self) {
  return static_cast<const Law*>(self)->fault == "huge" ? size_t{1} << 40 : 3;
}

void start(const void*, double* state) { state[0] = 100.0; }

int step(const void* self, const rotorub_measurement* now, double* state, double command[2],
         char* reason, size_t room) {
  const Law& law = *static_cast<const Law*>(self);
  state[0] += 1.0;
  command[0] = state[0];
  command[1] = static_cast<double>(now->sample);
  if (now->t < law.at) return 0;
  if (law.fault == "step") {
    std::snprintf(reason, room, "the encoder is lost");
    return 1;
  }
  if (law.fault == "nan") command[1] = std::nan("");
  if (law.fault == "nan state") state[2] = INFINITY;
  if (law.fault == "exit") std::exit(0);
  if (law.fault == "segmentation") *static_cast<volatile double*>(nullptr) = 0.0;
  if (law.fault == "throw") throw std::runtime_error("thrown in step");
  if (law.fault == "throw a number") throw 7;
  return 0;
}

}  // namespace

extern "C" const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {
      ROTORUB_TEST_ABI, ROTORUB_TEST_COMMAND, "faulty", create, destroy, state_size, start, step};
  return &controller;
}
