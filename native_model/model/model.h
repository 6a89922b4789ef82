// The constant part of a system: everything that a scene states, assembled once. A Model is
// immutable and may be shared between threads; what changes is a State.
//
// Coordinates q (nq):   x_1..x_n, y_1..y_n | phi (with a drive) | theta_1..theta_k |
//                       x, y of each ring that moves, and of its housing | angle of each ring that
//                       turns | bristles of dry friction (their rates are its state) |
//                       two of each state that a magnetic bearing's feedback has (their rates are
//                       the states) | charges of two coils of each ring with a coil lag (their
//                       rates are the currents)
// Equations (9), (20):  M(phi) q'' = f(t, q, q', u) + W_N lambda_N + W_T lambda_T
// M is diagonal, but for the coupling of spin and bending by unbalance with a drive.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/bearing/drive.h"
#include "native_model/bearing/magnetic_feedback.h"
#include "native_model/bearing/ring_support.h"
#include "native_model/contact/contact_parameters.h"
#include "native_model/control/command_record.h"
#include "native_model/control/control_loop.h"
#include "native_model/control/controller.h"
#include "native_model/control/linear_controller.h"
#include "native_model/model/base_motion.h"
#include "native_model/model/mode_matrix.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/loads.h"
#include "native_model/scene/magnetic_bearing.h"

namespace rotorub {

class MagneticLibrary;  // control/magnetic_library.h

// Bound on nq, so that a step needs no heap; make_model refuses more (scene::SceneError).
inline constexpr int kMaxCoordinates = 512;
// Bound on eccentric discs, for the same reason.
inline constexpr std::size_t kMaxUnbalances = 32;

// Where each part of q begins; a part that is absent has length 0.
struct Layout {
  int modes = 0;      // n, bending modes in each plane
  int spin = 0;       // 1 with a drive, else 0
  int torsion = 0;    // elastic torsion modes
  int stator = 0;     // 2 for each ring that moves, and 2 for its housing
  int ring_spin = 0;  // 1 for each ring that turns
  int bristles = 0;   // 2 for each ring with dry friction, 1 for each whose spin is dragged dry
  int integrals = 0;  // 2 for each state of a magnetic bearing's feedback
  int coils = 0;      // 2 for each ring whose currents lag
  int x() const { return 0; }
  int y() const { return modes; }
  int phi() const { return 2 * modes; }
  int theta() const { return 2 * modes + spin; }
  int ring() const { return theta() + torsion; }
  int ring_angle() const { return ring() + stator; }
  int bristle() const { return ring_angle() + ring_spin; }
  int integral() const { return bristle() + bristles; }
  int coil() const { return integral() + integrals; }
  int mechanical() const { return bristle(); }  // the coordinates that have an energy
  int nq() const { return coil() + coils; }
  // Coordinate i is an angle.
  bool turns(int i) const {
    return (i >= phi() && i < ring()) || (i >= ring_angle() && i < mechanical());
  }
};

// A load of [[force]] through the mode values of its station; Scene::Force has the formulas. Times:
// on <= t < off. Not of kind unbalance; with the spin held not synchronous, as that is one that
// rotates.
struct AppliedForce {
  scene::ForceKind kind;
  double amplitude, frequency, phase;  // N, rad/s, rad
  Eigen::Vector2d vector;              // N
  double on, off, ramp;                // s
  ModeShape shape;
  double frequency_end = 0.0;  // rad/s, chirp
  // Envelope in [0, 1]: switching and ramp.
  double envelope(double t) const {
    if (t < on || t >= off) return 0.0;
    return (ramp > 0.0 && t < on + ramp) ? (t - on) / ramp : 1.0;
  }
  // Where the force of a kind that turns points to at t, from the x axis, rad; spin: phi.
  double angle(double t, double spin) const;
  // Force at time t, N.
  Eigen::Vector2d at(double t, double spin) const;
};

// A spring of rank one in each plane: force -stiffness (shape . q) at its station.
struct StationSpring {
  ModeShape shape;
  Eigen::Vector2d stiffness;  // N/m, negative for a magnetic bearing
};

inline constexpr int kAbsent = -1;

// Where the two coordinates of each state of a feedback begin in q, x before y; kAbsent: it has no
// such state.
struct FeedbackStates {
  int stored = kAbsent;    // rates A: of the integrator
  int filtered = kAbsent;  // rates m/s: the derivative's
  int current = kAbsent;   // rates A: of the coils behind the amplifier
  int command = kAbsent;   // rates A: what a sampled control asked for last

  bool operator==(const FeedbackStates&) const = default;
  FeedbackStates moved(int by) const {
    FeedbackStates all = *this;
    for (int* at : {&all.stored, &all.filtered, &all.current, &all.command})
      *at += *at == kAbsent ? 0 : by;
    return all;
  }
};

// A magnetic bearing with a feedback of its own, the same in both planes.
struct StationFeedback {
  ModeShape shape;
  MagneticFeedback law;
  WorkingTimes works;
  FeedbackStates states{};
  std::optional<ModeShape> sensor{};  // where the law sees the deflection; absent: at `shape`
  std::size_t number = 0;             // among the scene's magnetic bearings
  bool controlled = true;             // false: its magnets have their bias current alone
  const ModeShape& seen() const { return sensor ? *sensor : shape; }
};

// A control of magnetic bearings that is asked once a sample; two ports of each, x before y. What
// it remembers is states, too: rates of coordinates (model/sampled_feedback.h).
struct SampledFeedback {
  LinearController law;               // with a library its sizes alone count
  double sample_time = 0.0;           // s, > 0
  int delay = 0;                      // samples from the measurement to the command
  std::vector<std::size_t> bearings;  // among the model's feedbacks
  int command = kAbsent;  // the commands that hold, A, then those of `delay` samples to come
  int state = kAbsent;    // the states of its law
  std::shared_ptr<const MagneticLibrary> library{};  // in the law's place; null: none
};
inline constexpr std::size_t kMaxPorts = 2 * scene::kMaxMagneticBearings;

// Magnets on the two axes of the actuator; they act with or without a controller.
struct MagneticActuator {
  std::shared_ptr<const ForceLaw> law;  // of each axis
  double current_limit = 0.0;           // A, > 0
  double coil_lag = 0.0;                // s, >= 0
  double current_rate_limit = 0.0;      // A/s, > 0, infinity: none
  // V, > 0, infinity: none, then neither of the others counts; H, > 0; Ohm, >= 0.
  double voltage_limit = std::numeric_limits<double>::infinity(), inductance = 1.0,
         resistance = 0.0;
};

// What carries a ring beyond the diagonals of stiffness and damping. With a housing those have the
// spring and the damper between the two on both, and `stiffness`, `damping` couple them.
struct StationSupport {
  std::size_t number = 0;                            // of the auxiliary bearing
  int ring = kAbsent, housing = kAbsent;             // where their coordinates begin in q
  Eigen::Vector2d stiffness{0.0, 0.0};               // N/m, of the spring under the ring
  Eigen::Vector2d damping{0.0, 0.0};                 // N s/m
  RingSupport law;                                   // beside them
  int bristle = kAbsent;                             // two, of its dry friction
  int ring_angle = kAbsent, spin_bristle = kAbsent;  // where the spin is dragged dry
};

// One auxiliary bearing: the contact at a station, the ring there, and what moves the ring.
struct AuxiliaryBearing {
  std::string name;                          // in messages
  ModeShape shape;                           // n each; 1 or 0 of the first contact
  Eigen::VectorXd torsion_shape;             // torsion, mode values at the station
  std::optional<ContactParameters> contact;  // absent: rotor and ring do not meet
  Eigen::Vector2d ring_offset{0.0, 0.0};     // m, of the ring's middle at rest
  double ring_ratio = 1.0;  // the contact's surface_ratio(); used where the ring turns
  // Where its parts begin in q; kAbsent of a ring that is fixed, does not turn, has no coils that
  // lag.
  int ring = kAbsent, ring_angle = kAbsent, coil = kAbsent;
  int housing = kAbsent;  // behind the ring's

  std::shared_ptr<const Controller> controller;  // null: passive
  std::shared_ptr<const ControlLoop> loop;       // of a sampled controller
  double control_on = 0.0;                       // s
  double sample_time = 0.0;                      // s, 0: continuous
  // Commands of another run in the controller's place: then there is none (see replayed).
  std::shared_ptr<const CommandRecord> recorded;
  bool gives() const { return contact && contact->gives(); }
  bool commanded() const { return controller || recorded; }
  double force_limit = 0.0;                 // N, on each axis of an ideal actuator
  std::optional<MagneticActuator> magnets;  // absent: ideal actuator

  // Contact-space admittance J M^-1 J^T of (relative x, relative y, spin), 1/kg, 1/kg, 1/(kg m^2),
  // spin that of contact_spin (model/dynamics.h); constant unless coupled_mass().
  Eigen::Matrix3d admittance = Eigen::Matrix3d::Zero();

  bool moves() const { return ring != kAbsent; }
  bool turns() const { return ring_angle != kAbsent; }
};

struct Model {
  Layout layout;
  Eigen::VectorXd mass;       // nq, diagonal of M, kg or kg m^2
  Eigen::VectorXd stiffness;  // nq, diagonal
  Eigen::VectorXd damping;    // nq, diagonal, inertial frame

  // Rotor terms beyond the diagonal; absent where the scene has none.
  ModeMatrix gyroscopic;                             // kg
  ModeMatrix internal_xx, internal_xy, internal_yy;  // N s/m, rotating damping
  std::vector<StationDamper> dampers;                // bearings
  std::vector<StationSpring> springs;                // magnetic bearings
  std::vector<StationFeedback> feedbacks;            // of them: what they do beyond their springs
  std::vector<StationSupport> supports;              // of rings on more than a spring and a damper
  std::vector<SampledFeedback> samplers;             // what asks for the currents of some of them
  std::vector<StationFilm> films;  // bearings that cross the planes or follow the speed
  std::vector<AppliedForce> forces;
  std::vector<DiscUnbalance> unbalances;   // eccentric discs, blades that are lost
  Eigen::VectorXd gravity_mass;            // nq, kg, load per unit acceleration
  Eigen::VectorXd pull;                    // nq or empty, N, of bearings off the line
  Eigen::VectorXd weight;                  // nq or empty, N, gravity and pull
  std::shared_ptr<const BaseMotion> base;  // null: it rests

  // Spin. Without a drive phi = spin_angle + speed t.
  double speed = 0.0;       // rad/s at t = 0
  double spin_angle = 0.0;  // rad at t = 0
  std::optional<Drive> drive;
  Eigen::VectorXd drive_shape;  // torsion, mode values at the motor
  double drive_angle = 0.0;     // rad, of the motor at t = 0

  // In the order of the scene; one at least, whose contact may be absent.
  std::vector<AuxiliaryBearing> auxiliary = std::vector<AuxiliaryBearing>(1);
  AuxiliaryBearing& first() { return auxiliary.front(); }
  const AuxiliaryBearing& first() const { return auxiliary.front(); }

  Eigen::VectorXd q0, v0;          // initial state
  std::optional<ModeLines> lines;  // deflection lines for pictures

  // A contact at least is compliant.
  bool gives() const {
    return std::any_of(auxiliary.begin(), auxiliary.end(),
                       [](const AuxiliaryBearing& at) { return at.gives(); });
  }
  // Unbalance couples spin and bending where the spin is free.
  bool coupled_mass() const { return layout.spin == 1 && !unbalances.empty(); }
  // With a drive only: N m, at an angle (rad, turned since t = 0) and a speed of the motor.
  double drive_torque(double t, double angle, double motor_speed) const {
    return drive->torque(t, angle, motor_speed);
  }
  bool drive_follows() const { return drive && drive->follows(); }  // angle and t matter
  int nq() const { return layout.nq(); }
  // What the samplers remember stands from here to the coils in q.
  int sampled_states() const { return samplers.empty() ? layout.coil() : samplers.front().command; }
};

// What changes: time, coordinates and velocities.
struct State {
  double t = 0.0;
  Eigen::VectorXd q, v;  // nq
};

// Throws scene::SceneError for what only the modes can show: more than kMaxCoordinates, lists of
// [initial] of another length than the modes kept, a start outside the ring; and as modal_rotor.
// start: changes q0 and v0 from what the lists of [initial] state, before what follows from them is
// filled in. Without one the scene asks for no orbit and no rub: programs call `prepare`
// (prepare/prepare.h), which makes those starts.
Model make_model(const scene::Scene& scene, const std::function<void(Model&)>& start = {});
State initial_state(const Model& model);
// The weight under an acceleration (x, y), m/s^2.
void set_gravity(Model& model, const Eigen::Vector2d& acceleration);

// The same without the coils' coordinates, for callers that integrate the currents themselves.
Model without_coils(Model model);
// The same with an ideal, unlimited actuator, for callers that know the force on the ring.
Model with_ideal_actuator(Model model);
// The same with the linear laws of magnetic bearings: without limits, of magnets that pull against
// each other about the middle.
Model with_linear_feedback(Model model);
// The same with every bearing on the line.
Model without_offsets(Model model);
// The same without a controller.
Model without_controller(Model model);
// The same driven by the commands of another run instead of its controller; as it is for null.
Model replayed(Model model, std::shared_ptr<const CommandRecord> commands);

}  // namespace rotorub
