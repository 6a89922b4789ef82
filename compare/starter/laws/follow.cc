// A simple controller to start from: the ring follows the rotor through a spring and a damper
// between their centres. Build it in this folder with
//
//   c++ -std=c++20 -shared -fPIC -Wall -I . follow.cc -o follow.so
//
// and run
//
//   rotorub run ../SCENE.toml --controller ./follow.so --set controller.sample_time=50us
#include <rotorub/controller.h>

namespace {

// The parameters of the law: made by create() and passed to step().
struct Follow {
  double stiffness = 4e5;  // N/m
  double damping = 400.0;  // N s/m
};

int create(const rotorub_setup*, void** self, char*, size_t) {
  *self = new Follow;
  return 0;
}
void destroy(void* self) { delete static_cast<Follow*>(self); }

// command: N, the force on the ring along x and y. An exception ends the run; its text is reported.
int step(const void* self, const rotorub_measurement* now, double*, double command[2], char*,
         size_t) {
  const Follow& law = *static_cast<const Follow*>(self);
  for (int axis = 0; axis < 2; ++axis) {
    command[axis] = law.stiffness * (now->rotor[axis] - now->stator[axis]) +
                    law.damping * (now->rotor_velocity[axis] - now->stator_velocity[axis]);
  }
  return 0;
}

}  // namespace

extern "C" const rotorub_controller* rotorub_controller_get() {
  static const rotorub_controller controller{.abi = ROTORUB_CONTROLLER_ABI,
                                             .command = ROTORUB_FORCE,
                                             .name = "follow",
                                             .create = create,
                                             .destroy = destroy,
                                             .step = step};
  return &controller;
}
