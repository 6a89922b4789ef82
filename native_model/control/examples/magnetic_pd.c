/* A sampled PD law for magnetic bearings: on each axis the current is
 *   i_k = -(proportional s_k + derivative (s_k - s_{k-1}) / T),
 * where s_k is the deflection at the sensor (m) and T the sample time (s). The caller limits the
 * current.
 *
 *   cc -shared -fPIC -I $ROTORUB/native_model/control/abi magnetic_pd.c -o magnetic_pd.so
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rotorub/controller.h>

typedef struct {
  double proportional; /* A/m */
  double derivative;   /* A s/m */
  double sample_time;  /* s */
  size_t ports;        /* x and y of each bearing */
} law;

static int create(const rotorub_magnetic_setup* setup, void** self, char* reason, size_t room) {
  law* l = calloc(1, sizeof *l);
  if (l == NULL) return 1;
  l->sample_time = setup->sample_time;
  l->ports = setup->ports;
  for (size_t i = 0; i < setup->entries; ++i) {
    const rotorub_entry* entry = &setup->config[i];
    if (entry->text == NULL && strcmp(entry->key, "proportional") == 0) {
      l->proportional = entry->number;
    } else if (entry->text == NULL && strcmp(entry->key, "derivative") == 0) {
      l->derivative = entry->number;
    } else {
      snprintf(reason, room, "%s: unknown key; give the numbers proportional and derivative",
               entry->key);
      free(l);
      return 1;
    }
  }
  *self = l;
  return 0;
}

/* The state: whether there is an earlier sample, and its deflection at each port. */
static size_t state_size(const void* self) { return 1 + ((const law*)self)->ports; }

static int step(const void* self, const rotorub_magnetic_measurement* now, double* state,
                double* current, char* reason, size_t room) {
  const law* l = self;
  const int has_earlier = state[0] > 0.5;
  (void)reason;
  (void)room;
  for (size_t k = 0; k < l->ports; ++k) {
    const double s = now->deflection[k], before = has_earlier ? state[1 + k] : s;
    current[k] = -(l->proportional * s + l->derivative * (s - before) / l->sample_time);
    state[1 + k] = s;
  }
  state[0] = 1.0;
  return 0;
}

const rotorub_magnetic_controller* rotorub_magnetic_controller_get(void) {
  static const rotorub_magnetic_controller controller = {
      ROTORUB_MAGNETIC_CONTROLLER_ABI, "magnetic_pd", create, free, state_size, NULL, step};
  return &controller;
}
