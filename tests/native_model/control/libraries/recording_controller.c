/* A law with an integrator and a filter that also keeps, in its state, what it was shown last and
 * what it told. */
#include <math.h>
#include <stddef.h>

#include <rotorub/controller.h>

enum { COUNT, SUM_X, SUM_Y, FILTER_X, FILTER_Y, SHOWN, TOLD = SHOWN + 13, SIZE = TOLD + 2 };

static int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  (void)setup, (void)reason, (void)room;
  *self = NULL;
  return 0;
}

static size_t state_size(const void* self) {
  (void)self;
  return SIZE;
}

static int step(const void* self, const rotorub_measurement* now, double* state, double command[2],
                char* reason, size_t room) {
  (void)self, (void)reason, (void)room;
  const double shown[13] = {now->t,
                            now->rotor[0],
                            now->rotor[1],
                            now->rotor_velocity[0],
                            now->rotor_velocity[1],
                            now->stator[0],
                            now->stator[1],
                            now->stator_velocity[0],
                            now->stator_velocity[1],
                            now->spin_angle,
                            now->spin_speed,
                            now->current[0],
                            now->current[1]};
  for (int k = 0; k < 13; ++k) state[SHOWN + k] = shown[k];
  state[COUNT] += 1.0;
  for (int k = 0; k < 2; ++k) {
    const double error = now->rotor[k] - now->stator[k];
    state[SUM_X + k] += 1e-4 * error;
    state[FILTER_X + k] += 0.3 * (error - state[FILTER_X + k]);
    command[k] = 4e4 * state[FILTER_X + k] + 1e5 * state[SUM_X + k] -
                 60.0 * now->stator_velocity[k] + 2.0 * sin(now->spin_angle + (double)k);
    state[TOLD + k] = command[k];
  }
  return 0;
}

const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {
      ROTORUB_CONTROLLER_ABI, ROTORUB_FORCE, "recording", create, NULL, state_size, NULL, step};
  return &controller;
}
