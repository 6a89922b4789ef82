/* A user's controller for rotorub: a shared library with the function rotorub_controller_get, which
 * commands a ring, or rotorub_magnetic_controller_get, which commands the currents of magnetic
 * bearings (at the end), or both. The same library runs in the native model, in MuJoCo and in
 * sweeps. It can be written in C, C++ or any language that can export a C function. A law in Python
 * is a file with the same functions (mjcf/docs/own_controller.md).
 *
 * The library is sampled: at t = k sample_time it receives the measurements of the sensors, updates
 * its state and returns a command that is held until the next sample. The state is a plain array
 * that the caller owns: it is stored in mjData, copied, restored, and used on several threads. A
 * step must therefore depend only on its arguments: it must not use static variables, a clock, or
 * random numbers that do not come from the state.
 *
 * Vectors are x and y in the fixed frame, in the plane of the contact; all units are SI. */
#ifndef ROTORUB_CONTROLLER_H
#define ROTORUB_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the structures below. It changes with their layout or their meaning. */
#define ROTORUB_CONTROLLER_ABI 1

/* The kind of command that step() returns. */
enum {
  /* N: the force on the ring along x and y. The actuator applies it within its limits; magnets get
   * the currents that produce it at the ring's position. */
  ROTORUB_FORCE = 0,
  /* A: the currents of the two axes of the magnets, (1, 1)/sqrt 2 and (-1, 1)/sqrt 2. */
  ROTORUB_CURRENT = 1
};

/* The sensor values; values that are not measured are 0 (rotorub_setup.measured). */
typedef struct rotorub_measurement {
  double t;                  /* s, of the sample */
  int64_t sample;            /* k, number of the sample: floor(t / sample_time) */
  double rotor[2];           /* m, centre of the rotor at the contact */
  double rotor_velocity[2];  /* m/s */
  double stator[2];          /* m, centre of the ring */
  double stator_velocity[2]; /* m/s */
  double spin_angle;         /* rad */
  double spin_speed;         /* rad/s */
  double current[2];         /* A, of the two axes; 0 without magnets */
} rotorub_measurement;

/* Bits of rotorub_setup.measured. */
enum {
  ROTORUB_MEASURES_ROTOR = 1,
  ROTORUB_MEASURES_STATOR = 2,
  ROTORUB_MEASURES_VELOCITY = 4, /* of the rotor and the ring, if they are measured */
  ROTORUB_MEASURES_SPIN = 8,
  ROTORUB_MEASURES_CURRENT = 16
};

/* One entry of the scene's [controller.config]: a number (text is null) or a text. */
typedef struct rotorub_entry {
  const char* key;
  const char* text;
  double number;
} rotorub_entry;

/* Argument of create(); valid only until create() returns. */
typedef struct rotorub_setup {
  uint32_t abi;               /* ROTORUB_CONTROLLER_ABI of the caller */
  uint32_t measured;          /* bits ROTORUB_MEASURES_* */
  double sample_time;         /* s, > 0 */
  double clearance;           /* m, radial; 0: the scene has no contact */
  double stator_mass[2];      /* kg, along x and y */
  double stator_damping[2];   /* N s/m */
  double stator_stiffness[2]; /* N/m */
  double force_limit;         /* N, on each axis of an ideal actuator; infinity: none */
  double current_limit;       /* A, on each axis of magnets; 0: no magnets */
  size_t entries;
  const rotorub_entry* config;
} rotorub_setup;

/* The library's kind of command and its functions. */
typedef struct rotorub_controller {
  uint32_t abi;     /* ROTORUB_CONTROLLER_ABI */
  uint32_t command; /* ROTORUB_FORCE or ROTORUB_CURRENT */
  const char* name;
  /* Stores the data that is constant during a run in *self. A result other than 0 rejects the
   * setup; `reason` (`room` bytes, ended by 0) then says why. */
  int (*create)(const rotorub_setup* setup, void** self, char* reason, size_t room);
  void (*destroy)(void* self); /* may be null */
  /* Number of doubles in the state; null: 0. */
  size_t (*state_size)(const void* self);
  /* Sets the state before the first sample; null: all 0. */
  void (*start)(const void* self, double* state);
  /* A result other than 0 is a failure and ends the run with `reason`. A command or state that is
   * not finite ends the run too. */
  int (*step)(const void* self, const rotorub_measurement* now, double* state, double command[2],
              char* reason, size_t room);
} rotorub_controller;

/* The symbol of the library. The returned pointer must stay valid while the library is loaded. */
const rotorub_controller* rotorub_controller_get(void);
typedef const rotorub_controller* (*rotorub_controller_get_function)(void);
#define ROTORUB_CONTROLLER_SYMBOL "rotorub_controller_get"

/* ------------------------------------------------------------------------------------------------
 * Magnetic bearings: one law for all bearings whose control is of kind "shared" ([magnetic_control]
 * kind = "library"). The ports are x and y of the first of these bearings in the scene, x and y of
 * the second, ...
 *
 * The state has at most 64 numbers. Fixed-step integrators and MuJoCo store it as velocities, with
 * round-off: round a counter before you use it. In MuJoCo a number must stay below 1e10. step() is
 * not called while no bearing works; start() is called before the first sample and before the first
 * sample after such a pause. */

/* Version of the structures below. */
#define ROTORUB_MAGNETIC_CONTROLLER_ABI 1

/* One bearing that the law commands. */
typedef struct rotorub_magnetic_bearing {
  double force_per_current;  /* N/A, k_i; for two magnets linearised at the centre */
  double negative_stiffness; /* N/m, k_s, likewise */
  double current_limit;      /* A, absolute value on each axis; infinity: no limit */
  /* Of two magnets with k_m [((i_0 + i)/(s_0 - r))^2 - ((i_0 - i)/(s_0 + r))^2]; 0 if linear. */
  double force_constant; /* N m^2/A^2, k_m */
  double bias_current;   /* A, i_0 */
  double air_gap;        /* m, s_0 */
  double bandwidth;      /* rad/s, of the amplifier; infinity: no amplifier */
} rotorub_magnetic_bearing;

/* Argument of create(); valid only until create() returns. */
typedef struct rotorub_magnetic_setup {
  uint32_t abi;       /* ROTORUB_MAGNETIC_CONTROLLER_ABI of the caller */
  double sample_time; /* s, > 0 */
  double delay;       /* s, from the sample to its currents; the caller applies it */
  size_t ports;
  const rotorub_magnetic_bearing* bearings; /* ports / 2 of them */
  size_t entries;
  const rotorub_entry* config; /* [magnetic_control.config] */
} rotorub_magnetic_setup;

/* Argument of step(); valid only until step() returns. */
typedef struct rotorub_magnetic_measurement {
  double t;                 /* s, of the sample */
  int64_t sample;           /* k, its number: floor(t / sample_time) */
  const double* deflection; /* m, of each port, at its sensor */
  /* A, of each port: the coil current, or without an amplifier the current of the previous sample.
   * In MuJoCo and in `verlet`, current and spin_speed are values of half a time step before the
   * sample. */
  const double* current;
  double spin_angle; /* rad */
  double spin_speed; /* rad/s */
} rotorub_magnetic_measurement;

/* The library's functions; those without a comment are as in rotorub_controller. */
typedef struct rotorub_magnetic_controller {
  uint32_t abi; /* ROTORUB_MAGNETIC_CONTROLLER_ABI */
  const char* name;
  int (*create)(const rotorub_magnetic_setup* setup, void** self, char* reason, size_t room);
  void (*destroy)(void* self);
  size_t (*state_size)(const void* self);
  void (*start)(const void* self, double* state);
  /* current: A, requested for each port; the caller applies the limit. */
  int (*step)(const void* self, const rotorub_magnetic_measurement* now, double* state,
              double* current, char* reason, size_t room);
} rotorub_magnetic_controller;

/* The symbol of the library; as rotorub_controller_get. */
const rotorub_magnetic_controller* rotorub_magnetic_controller_get(void);
typedef const rotorub_magnetic_controller* (*rotorub_magnetic_controller_get_function)(void);
#define ROTORUB_MAGNETIC_CONTROLLER_SYMBOL "rotorub_magnetic_controller_get"

#ifdef __cplusplus
}
#endif

#endif
