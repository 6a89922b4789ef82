/* A controller to begin with: the ring follows the rotor, by a spring and a damper between their
 * centres. In this folder:
 *
 *   cc -shared -fPIC -Wall -I . follow.c -o follow.so
 *
 * and then
 *
 *   rotorub run ../SCENE.toml --controller ./follow.so --set controller.sample_time=50us */
#include <rotorub/controller.h>

static int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  (void)setup, (void)self, (void)reason, (void)room;
  return 0;
}

/* command: N, the force on the ring along x and y. */
static int step(const void* self, const rotorub_measurement* now, double* state, double command[2],
                char* reason, size_t room) {
  const double stiffness = 4e5; /* N/m */
  const double damping = 400.0; /* N s/m */
  for (int axis = 0; axis < 2; ++axis) {
    command[axis] = stiffness * (now->rotor[axis] - now->stator[axis]) +
                    damping * (now->rotor_velocity[axis] - now->stator_velocity[axis]);
  }
  (void)self, (void)state, (void)reason, (void)room;
  return 0;
}

const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {.abi = ROTORUB_CONTROLLER_ABI,
                                                .command = ROTORUB_FORCE,
                                                .name = "follow",
                                                .create = create,
                                                .step = step};
  return &controller;
}
