/* A controller of one's own for rotorub: a shared library with one function,
 * rotorub_controller_get, which commands a ring, or rotorub_magnetic_controller_get, which commands
 * the currents of magnetic bearings (at the end), or both. The same library runs in the native
 * model, in MuJoCo and in sweeps; C and C++, and whatever can make a C function (examples:
 * mjcf/docs/own_controller.md).
 *
 * One sampled step: at t = k sample_time the library is shown what the sensors measure, changes its
 * state, and tells a command that is held until the next sample. The state is a plain array that
 * the caller owns: it lives in mjData, is copied, put back and stepped on several threads. A step
 * must depend on its arguments alone: no static variable, no clock, no random number but from the
 * state.
 *
 * Vectors are x and y in the fixed frame, in the plane of the contact; SI units throughout. */
#ifndef ROTORUB_CONTROLLER_H
#define ROTORUB_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the structures below. It changes when their layout or their meaning does. */
#define ROTORUB_CONTROLLER_ABI 1

/* What step() tells. */
enum {
  /* N: the force on the ring along x and y. The actuator gives it within its limits; magnets get
   * the currents that make it at the ring's place. */
  ROTORUB_FORCE = 0,
  /* A: the currents of the two axes of the magnets, (1, 1)/sqrt 2 and (-1, 1)/sqrt 2. */
  ROTORUB_CURRENT = 1
};

/* What the sensors show; what they do not measure is 0 (rotorub_setup.measured). */
typedef struct rotorub_measurement {
  double t;                  /* s, of the sample */
  int64_t sample;            /* k, its number: floor(t / sample_time) */
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
  ROTORUB_MEASURES_VELOCITY = 4, /* of those two that are measured */
  ROTORUB_MEASURES_SPIN = 8,
  ROTORUB_MEASURES_CURRENT = 16
};

/* An entry of the scene's [controller.config]: a number (text is null) or a text. */
typedef struct rotorub_entry {
  const char* key;
  const char* text;
  double number;
} rotorub_entry;

/* What create() is given; it is gone when create() returns. */
typedef struct rotorub_setup {
  uint32_t abi;               /* ROTORUB_CONTROLLER_ABI of the caller */
  uint32_t measured;          /* bits */
  double sample_time;         /* s, > 0 */
  double clearance;           /* m, radial; 0: the scene has no contact */
  double stator_mass[2];      /* kg, along x and y */
  double stator_damping[2];   /* N s/m */
  double stator_stiffness[2]; /* N/m */
  double force_limit;         /* N, on each axis of an ideal actuator; infinity: none */
  double current_limit;       /* A, on each axis of magnets; 0: there are none */
  size_t entries;
  const rotorub_entry* config;
} rotorub_setup;

/* What the library gives: what it tells, and its functions. */
typedef struct rotorub_controller {
  uint32_t abi;     /* ROTORUB_CONTROLLER_ABI */
  uint32_t command; /* ROTORUB_FORCE or ROTORUB_CURRENT */
  const char* name;
  /* What is constant over a run, in *self. Not 0: refused, `reason` tells why (`room` bytes, ended
   * by 0). */
  int (*create)(const rotorub_setup* setup, void** self, char* reason, size_t room);
  void (*destroy)(void* self); /* may be null */
  /* Numbers of the state; null: none. */
  size_t (*state_size)(const void* self);
  /* The state before the first sample; null: all 0. */
  void (*start)(const void* self, double* state);
  /* Not 0: it failed, and the run ends with `reason`. A command that is not finite ends it too. */
  int (*step)(const void* self, const rotorub_measurement* now, double* state, double command[2],
              char* reason, size_t room);
} rotorub_controller;

/* The symbol of the library. What it returns lives as long as the library. */
const rotorub_controller* rotorub_controller_get(void);
typedef const rotorub_controller* (*rotorub_controller_get_function)(void);
#define ROTORUB_CONTROLLER_SYMBOL "rotorub_controller_get"

/* ------------------------------------------------------------------------------------------------
 * Magnetic bearings: one law for all whose control is of kind "shared" ([magnetic_control] kind =
 * "library"). Ports: x and y of the first bearing of the scene's list, x and y of the second, ...
 *
 * The state is at most 64 numbers. A fixed step and MuJoCo carry it as speeds, to round-off: a
 * number that counts is to be rounded before it is used; in MuJoCo it must stay below 1e10. While
 * no bearing works the law is not asked; start() comes before its first sample and before the first
 * after that. */

/* Of the structures below. */
#define ROTORUB_MAGNETIC_CONTROLLER_ABI 1

/* A bearing that the law commands. */
typedef struct rotorub_magnetic_bearing {
  double force_per_current;  /* N/A, k_i, of two magnets about the middle */
  double negative_stiffness; /* N/m, k_s, likewise */
  double current_limit;      /* A, of the size of each axis; infinity: none */
  /* Of two magnets, k_m [((i_0 + i)/(s_0 - r))^2 - ((i_0 - i)/(s_0 + r))^2]; 0 of a linear one. */
  double force_constant; /* N m^2/A^2, k_m */
  double bias_current;   /* A, i_0 */
  double air_gap;        /* m, s_0 */
  double bandwidth;      /* rad/s, of the amplifier; infinity: none */
} rotorub_magnetic_bearing;

/* What create() is given; it is gone when create() returns. */
typedef struct rotorub_magnetic_setup {
  uint32_t abi;       /* ROTORUB_MAGNETIC_CONTROLLER_ABI of the caller */
  double sample_time; /* s, > 0 */
  double delay;       /* s, from the sample to its currents, beyond the library */
  size_t ports;
  const rotorub_magnetic_bearing* bearings; /* ports / 2 of them */
  size_t entries;
  const rotorub_entry* config; /* [magnetic_control.config] */
} rotorub_magnetic_setup;

/* It is gone when step() returns. */
typedef struct rotorub_magnetic_measurement {
  double t;                 /* s, of the sample */
  int64_t sample;           /* k, its number: floor(t / sample_time) */
  const double* deflection; /* m, of each port, at its sensor */
  /* A, of each port: the coil's, or without an amplifier that of the sample before. Like spin_speed
   * it is of half a step before the sample in MuJoCo and in `verlet`. */
  const double* current;
  double spin_angle; /* rad */
  double spin_speed; /* rad/s */
} rotorub_magnetic_measurement;

/* What the library gives; functions without a comment are as those of rotorub_controller. */
typedef struct rotorub_magnetic_controller {
  uint32_t abi; /* ROTORUB_MAGNETIC_CONTROLLER_ABI */
  const char* name;
  int (*create)(const rotorub_magnetic_setup* setup, void** self, char* reason, size_t room);
  void (*destroy)(void* self);
  size_t (*state_size)(const void* self);
  void (*start)(const void* self, double* state);
  /* current: A, of each port, asked for; its limit is kept by the caller. */
  int (*step)(const void* self, const rotorub_magnetic_measurement* now, double* state,
              double* current, char* reason, size_t room);
} rotorub_magnetic_controller;

/* The symbol of the library, as rotorub_controller_get. */
const rotorub_magnetic_controller* rotorub_magnetic_controller_get(void);
typedef const rotorub_magnetic_controller* (*rotorub_magnetic_controller_get_function)(void);
#define ROTORUB_MAGNETIC_CONTROLLER_SYMBOL "rotorub_magnetic_controller_get"

#ifdef __cplusplus
}
#endif

#endif
