/* A controller of one's own: it brings the ring to the rotor and holds it there, by measured
 * positions alone.
 *
 * Along the line of centres, gap g and wanted gap g_d (from the gap at the start smoothly to 0):
 *   e = g - g_d,   u = -(stiffness e + damping de/dt + integral of e + preload) e_r
 * After closing, rotor and ring whirl together with the spin, and friction tends to separate them.
 * In the frame that turns with the shaft a synchronous whirl is at rest, so a damper in that frame
 * acts only on other motion: u = -ring_damping R(phi) d/dt (R(-phi) q_f), where q_f is the ring's
 * centre. Velocities are not measured, so rates come from filters:
 * dx/dt ~ bandwidth (x - x_filtered).
 *
 *   cc -shared -fPIC -I $ROTORUB/native_model/control/abi own_controller.c -o own_controller.so -lm
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rotorub/controller.h>

typedef struct {
  double stiffness;    /* N/m */
  double damping;      /* N s/m */
  double integral;     /* N/(m s) */
  double ring_damping; /* N s/m */
  double bandwidth;    /* 1/s, of the filters */
  double gap_time;     /* s, in which the wanted gap falls to 0 */
  double preload;      /* N, once it has */
  double sample_time, clearance;
} law;

/* The state: all 0 before the first sample. */
enum { BEGUN, START, GAP, FILTERED, SUM, RING_X, RING_Y, SIZE };

/* bandwidth (x - x_filtered), and x_filtered one sample on. */
static double rate_of(const law* l, double x, double* filtered) {
  const double rate = l->bandwidth * (x - *filtered);
  *filtered += (1.0 - exp(-l->bandwidth * l->sample_time)) * (x - *filtered);
  return rate;
}

static int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  law* l = calloc(1, sizeof *l);
  if (l == NULL) return 1;
  const struct {
    const char* key;
    double* value;
  } keys[] = {{"stiffness", &l->stiffness},      {"damping", &l->damping},
              {"integral", &l->integral},        {"bandwidth", &l->bandwidth},
              {"gap_time", &l->gap_time},        {"preload", &l->preload},
              {"ring_damping", &l->ring_damping}};
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
               "%s: unknown key; give the numbers stiffness, damping, integral, bandwidth, "
               "gap_time, preload and ring_damping",
               setup->config[i].key);
      free(l);
      return 1;
    }
    *keys[k].value = setup->config[i].number;
  }
  const unsigned positions =
      ROTORUB_MEASURES_ROTOR | ROTORUB_MEASURES_STATOR | ROTORUB_MEASURES_SPIN;
  if ((setup->measured & positions) != positions || l->clearance <= 0.0) {
    snprintf(reason, room,
             "it needs a contact, the positions of rotor and ring, and the spin's angle");
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
  const double cosine = cos(now->spin_angle), sine = sin(now->spin_angle);
  const double turned[2] = {cosine * now->stator[0] + sine * now->stator[1],
                            cosine * now->stator[1] - sine * now->stator[0]};
  (void)reason;
  (void)room;
  if (state[BEGUN] == 0.0) {
    state[BEGUN] = 1.0;
    state[START] = now->t;
    state[GAP] = gap;
    state[RING_X] = turned[0];
    state[RING_Y] = turned[1];
  }
  const double s = fmin((now->t - state[START]) / l->gap_time, 1.0), r = 1.0 - s;
  const double wanted = state[GAP] * r * r * r * (1.0 + 3.0 * s + 6.0 * s * s);
  const double error = gap - wanted;
  const double rate = rate_of(l, error, &state[FILTERED]);
  const double a = l->ring_damping * rate_of(l, turned[0], &state[RING_X]);
  const double b = l->ring_damping * rate_of(l, turned[1], &state[RING_Y]);
  state[SUM] += l->sample_time * error;
  const double push = l->stiffness * error + l->damping * rate + l->integral * state[SUM] +
                      l->preload * (1.0 - r * r * r);
  command[0] = (delta > 0.0 ? -push * x / delta : 0.0) - (cosine * a - sine * b);
  command[1] = (delta > 0.0 ? -push * y / delta : 0.0) - (sine * a + cosine * b);
  return 0;
}

const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {ROTORUB_CONTROLLER_ABI,
                                                ROTORUB_FORCE,
                                                "own_controller",
                                                create,
                                                free,
                                                state_size,
                                                NULL,
                                                step};
  return &controller;
}
