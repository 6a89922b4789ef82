/* A controller of one's own: it brings the ring to the rotor by the measured positions alone.
 *
 * Along the line of centres, gap g and wanted gap g_d (from the gap at the start smoothly to 0):
 *   e = g - g_d,   u = -(stiffness e + damping de/dt + integral of e + preload) e_r
 * de/dt comes from a filter, as no velocity is measured:  de/dt ~ bandwidth (e - e_filtered).
 *
 *   cc -shared -fPIC -I <prefix>/include/rotorub own_controller.c -o own_controller.so -lm
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rotorub/controller.h>

typedef struct {
  double stiffness; /* N/m */
  double damping;   /* N s/m */
  double integral;  /* N/(m s) */
  double bandwidth; /* 1/s, of the filter */
  double gap_time;  /* s, in which the wanted gap falls to 0 */
  double preload;   /* N, once it has */
  double sample_time, clearance;
} law;

/* The state: all 0 before the first sample. */
enum { BEGUN, START, GAP, FILTERED, SUM, SIZE };

static int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  law* l = calloc(1, sizeof *l);
  if (l == NULL) return 1;
  const struct {
    const char* key;
    double* value;
  } keys[] = {{"stiffness", &l->stiffness}, {"damping", &l->damping},   {"integral", &l->integral},
              {"bandwidth", &l->bandwidth}, {"gap_time", &l->gap_time}, {"preload", &l->preload}};
  const size_t count = sizeof keys / sizeof *keys;
  l->gap_time = 0.008;
  l->bandwidth = 4000.0;
  l->sample_time = setup->sample_time;
  l->clearance = setup->clearance;
  for (size_t i = 0; i < setup->entries; ++i) {
    size_t k = 0;
    while (k < count && strcmp(setup->config[i].key, keys[k].key) != 0) ++k;
    if (k == count || setup->config[i].text != NULL) {
      snprintf(reason, room,
               "%s: accepted are the numbers stiffness, damping, integral, bandwidth, gap_time, preload",
               setup->config[i].key);
      free(l);
      return 1;
    }
    *keys[k].value = setup->config[i].number;
  }
  const unsigned positions = ROTORUB_MEASURES_ROTOR | ROTORUB_MEASURES_STATOR;
  if ((setup->measured & positions) != positions || l->clearance <= 0.0) {
    snprintf(reason, room, "it needs a contact, and the positions of rotor and ring");
    free(l);
    return 1;
  }
  *self = l;
  return 0;
}

static size_t state_size(const void* self) {
  (void)self;
  return SIZE;
}

static int step(const void* self, const rotorub_measurement* now, double* state, double command[2],
                char* reason, size_t room) {
  const law* l = self;
  const double x = now->rotor[0] - now->stator[0], y = now->rotor[1] - now->stator[1];
  const double delta = hypot(x, y), gap = l->clearance - delta;
  (void)reason;
  (void)room;
  if (state[BEGUN] == 0.0) {
    state[BEGUN] = 1.0;
    state[START] = now->t;
    state[GAP] = gap;
  }
  const double s = fmin((now->t - state[START]) / l->gap_time, 1.0), r = 1.0 - s;
  const double wanted = state[GAP] * r * r * r * (1.0 + 3.0 * s + 6.0 * s * s);
  const double error = gap - wanted;
  const double rate = l->bandwidth * (error - state[FILTERED]);
  state[FILTERED] += (1.0 - exp(-l->bandwidth * l->sample_time)) * (error - state[FILTERED]);
  state[SUM] += l->sample_time * error;
  const double push =
      l->stiffness * error + l->damping * rate + l->integral * state[SUM] + l->preload * (1.0 - r * r * r);
  command[0] = delta > 0.0 ? -push * x / delta : 0.0;
  command[1] = delta > 0.0 ? -push * y / delta : 0.0;
  return 0;
}

const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {
      ROTORUB_CONTROLLER_ABI, ROTORUB_FORCE, "own_controller", create, free, state_size, NULL, step};
  return &controller;
}
