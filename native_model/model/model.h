// The constant part of a system: everything that a scene states, assembled once. A Model does not
// change during a run and may be shared between threads; the changing part is a State.
//
// Coordinates q (nq):   x_1..x_n, y_1..y_n | phi (with a drive) | theta_1..theta_k |
//                       x, y of each ring that moves, and of its housing | angle of each ring that
//                       turns | bristles of dry friction (their rates are the states) |
//                       two per state of a magnetic bearing's feedback (their rates are the
//                       states) | charges of two coils of each ring with a coil lag (their rates
//                       are the currents) | with_control_states() appends the commands and memories
//                       of the rings' sampled controllers (their rates are the states)
// Equations (9), (20):  M(phi) q'' = f(t, q, q', u) + W_N lambda_N + W_T lambda_T
//
// M is diagonal except for the coupling of spin and bending by unbalance with a drive.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/bearing/coil.h"
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

// Bound on nq, so that a step needs no heap; make_model rejects larger models (scene::SceneError).
inline constexpr int kMaxCoordinates = 512;
// Bound on the number of eccentric discs, for the same reason.
inline constexpr std::size_t kMaxUnbalances = 32;

// Where each part of q begins; an absent part has length 0.
struct Layout {
  int modes = 0;            // n, bending modes in each plane
  int spin = 0;             // 1 with a drive, else 0
  int torsion = 0;          // elastic torsion modes
  int stator = 0;           // 2 per moving ring, and 2 per housing
  int ring_spin = 0;        // 1 per ring that turns
  int bristles = 0;         // 2 per ring with dry friction, 1 per ring with dry drag on its spin
  int feedback_states = 0;  // 2 per state of a magnetic bearing's feedback
  int coils = 0;            // 2 per ring with a coil lag
  int control_states = 0;   // with_control_states(): of the rings' sampled controllers
  int x() const { return 0; }
  int y() const { return modes; }
  int phi() const { return 2 * modes; }
  int theta() const { return 2 * modes + spin; }
  int ring() const { return theta() + torsion; }
  int ring_angle() const { return ring() + stator; }
  int bristle() const { return ring_angle() + ring_spin; }
  int feedback_state() const { return bristle() + bristles; }
  int coil() const { return feedback_state() + feedback_states; }
  int mechanical() const { return bristle(); }  // number of leading coordinates that store energy
  int control_state() const { return coil() + coils; }
  int nq() const { return control_state() + control_states; }
  // True if coordinate i is an angle.
  bool turns(int i) const {
    return (i >= phi() && i < ring()) || (i >= ring_angle() && i < mechanical());
  }
};

// A load of [[force]], with the mode values of its station; scene::Force has the formulas. It acts
// for on <= t < off. Loads of kind unbalance are not in this list, and a synchronous load at a held
// spin speed becomes a rotating one.
struct AppliedForce {
  scene::ForceKind kind;
  double amplitude, frequency, phase;  // N, rad/s, rad
  Eigen::Vector2d vector;              // N
  double on, off, ramp;                // s
  ModeShape shape;
  double frequency_end = 0.0;  // rad/s, chirp
  // Envelope in [0, 1] from switching and ramp.
  double envelope(double t) const {
    if (t < on || t >= off) return 0.0;
    return (ramp > 0.0 && t < on + ramp) ? (t - on) / ramp : 1.0;
  }
  // rad, direction of a rotating force at t, from the x axis. spin: phi.
  double angle(double t, double spin) const;
  // N, force at time t.
  Eigen::Vector2d at(double t, double spin) const;
};

// A spring of rank one in each plane: force -stiffness (shape . q) at its station.
struct StationSpring {
  ModeShape shape;
  Eigen::Vector2d stiffness;  // N/m, negative if it destabilises
};

inline constexpr int kAbsent = -1;

// Where the two coordinates of each state of a feedback begin in q, x before y; kAbsent if there is
// no such state.
struct FeedbackStates {
  int stored = kAbsent;    // rates in A: integrator
  int filtered = kAbsent;  // rates in m/s: filtered derivative
  int current = kAbsent;   // rates in A: currents of the coils behind the amplifier
  int command = kAbsent;   // rates in A: last command of a sampled control

  bool operator==(const FeedbackStates&) const = default;
  FeedbackStates moved(int by) const {
    FeedbackStates all = *this;
    for (int* at : {&all.stored, &all.filtered, &all.current, &all.command})
      *at += *at == kAbsent ? 0 : by;
    return all;
  }
};

// A magnetic bearing with a feedback or with magnets, equal in both planes.
struct StationFeedback {
  ModeShape shape;
  MagneticFeedback law;
  WorkingTimes works;
  FeedbackStates states{};
  std::optional<ModeShape> sensor{};  // where the deflection is measured; absent: at `shape`
  std::size_t number = 0;             // index in the scene's magnetic bearings
  bool controlled = true;             // false: the magnets have only their bias current
  const ModeShape& sensor_shape() const { return sensor ? *sensor : shape; }
};

// A sampled control of magnetic bearings; each bearing has two ports, x before y. Its memory is
// also stored as states, the rates of coordinates (model/sampled_feedback.h).
struct SampledFeedback {
  LinearController law;               // with a library only its sizes are used
  double sample_time = 0.0;           // s, > 0
  int delay = 0;                      // samples from the measurement to the command
  std::vector<std::size_t> bearings;  // indices in the model's feedbacks
  int command = kAbsent;              // active commands, A, then those of the next `delay` samples
  int state = kAbsent;                // states of the law
  std::shared_ptr<const MagneticLibrary> library{};  // replaces the law; null: no library
};
inline constexpr std::size_t kMaxPorts = 2 * scene::kMaxMagneticBearings;

// Magnets on the two axes of the actuator; they act even without a controller.
struct MagneticActuator {
  std::shared_ptr<const ForceLaw> law;  // of one axis; both are equal
  double current_limit = 0.0;           // A, > 0
  Coil coil;                            // of one axis
};

// The support of a ring beyond the diagonals of stiffness and damping. With a housing, the
// diagonals of both contain the spring and the damper between them, and `stiffness` and `damping`
// here are the coupling terms.
struct StationSupport {
  std::size_t number = 0;                            // of the auxiliary bearing
  int ring = kAbsent, housing = kAbsent;             // where their coordinates begin in q
  Eigen::Vector2d stiffness{0.0, 0.0};               // N/m, of the spring under the ring
  Eigen::Vector2d damping{0.0, 0.0};                 // N s/m
  RingSupport law;                                   // other forces of the support
  int bristle = kAbsent;                             // two, for dry friction
  int ring_angle = kAbsent, spin_bristle = kAbsent;  // for dry drag on its spin
};

// One auxiliary bearing: the contact at a station, its ring, and the ring's actuator and
// controller.
struct AuxiliaryBearing {
  std::string name;                          // for messages
  ModeShape shape;                           // n each; 1 or 0 for the first contact
  Eigen::VectorXd torsion_shape;             // mode values at the station, one per torsion mode
  std::optional<ContactParameters> contact;  // absent: rotor and ring do not interact
  Eigen::Vector2d ring_offset{0.0, 0.0};     // m, centre of the ring at rest
  double ring_ratio = 1.0;  // surface_ratio() of the contact, for a ring that turns
  // Where its parts begin in q; kAbsent if the ring is fixed, does not turn, or has no coil lag.
  int ring = kAbsent, ring_angle = kAbsent, coil = kAbsent;
  int housing = kAbsent;  // stored after the ring

  std::shared_ptr<const Controller> controller;  // null: passive
  std::shared_ptr<const ControlLoop> loop;       // for a sampled controller
  double control_on = 0.0;                       // s
  double sample_time = 0.0;                      // s, 0: continuous
  int control_state = kAbsent;  // where its command (2) and the memory of `loop` begin among the
                                // states; kAbsent: the integrator keeps them
  // Commands of another run, which replace the controller (see replayed()).
  std::shared_ptr<const CommandRecord> recorded;
  bool is_compliant() const { return contact && contact->is_compliant(); }
  bool commanded() const { return controller || recorded; }
  double force_limit = 0.0;                 // N, on each axis of an ideal actuator
  std::optional<MagneticActuator> magnets;  // absent: ideal actuator

  // Contact-space admittance J M^-1 J^T of (relative x, relative y, contact_spin), 1/kg, 1/kg,
  // 1/(kg m^2) on the diagonal; constant unless coupled_mass(). See model/dynamics.h.
  Eigen::Matrix3d admittance = Eigen::Matrix3d::Zero();

  // True if the currents of magnets lag behind their commands. In MuJoCo they are activations.
  bool lags() const { return magnets && magnets->coil.lag > 0.0; }
  bool moves() const { return ring != kAbsent; }
  bool turns() const { return ring_angle != kAbsent; }
};

struct Model {
  Layout layout;
  Eigen::VectorXd mass;       // nq, diagonal of M, kg or kg m^2
  Eigen::VectorXd stiffness;  // nq, diagonal
  Eigen::VectorXd damping;    // nq, diagonal, inertial frame

  // Rotor terms beyond the diagonal; absent if the scene has none.
  ModeMatrix gyroscopic;                             // kg
  ModeMatrix internal_xx, internal_xy, internal_yy;  // N s/m, rotating damping
  std::vector<StationDamper> dampers;                // bearings
  std::vector<StationSpring> springs;                // magnetic bearings
  std::vector<StationFeedback> feedbacks;            // magnetic bearings beyond their springs
  std::vector<StationSupport> supports;              // rings on more than a spring and a damper
  std::vector<SampledFeedback> samplers;             // sampled controls of feedbacks
  std::vector<StationFilm> films;  // bearings with cross-coupling or dependence on the speed
  std::vector<AppliedForce> forces;
  std::vector<DiscUnbalance> unbalances;   // eccentric discs, lost blades
  Eigen::VectorXd gravity_mass;            // nq, kg, load per unit acceleration
  Eigen::VectorXd pull;                    // nq or empty, N, from misaligned bearings
  Eigen::VectorXd weight;                  // nq or empty, N, gravity and pull
  std::shared_ptr<const BaseMotion> base;  // null: the base is at rest

  // Spin. Without a drive phi = spin_angle + speed t.
  double speed = 0.0;       // rad/s at t = 0
  double spin_angle = 0.0;  // rad at t = 0
  std::optional<Drive> drive;
  Eigen::VectorXd drive_shape;  // torsion, mode values at the motor
  double drive_angle = 0.0;     // rad, of the motor at t = 0

  // In the order of the scene. There is at least one. If it is the only one, its contact may be
  // absent; with several auxiliary bearings each has a contact.
  std::vector<AuxiliaryBearing> auxiliary = std::vector<AuxiliaryBearing>(1);
  AuxiliaryBearing& first() { return auxiliary.front(); }
  const AuxiliaryBearing& first() const { return auxiliary.front(); }

  // m, a deflection that no rotor of this size can have: ten lengths of the shaft;
  // for a rotor given by its modes a hundred times the radius at the contact or the air gap of a
  // magnetic bearing, and 1 km if the scene gives neither.
  double reach = 1e3;

  Eigen::VectorXd q0, v0;          // initial state
  std::optional<ModeLines> lines;  // deflection lines for drawing

  // With several auxiliary bearings each has a contact.
  bool has_contact() const { return auxiliary.front().contact.has_value(); }
  // True if at least one contact is compliant.
  bool is_compliant() const {
    return std::any_of(auxiliary.begin(), auxiliary.end(),
                       [](const AuxiliaryBearing& at) { return at.is_compliant(); });
  }
  // True if unbalance couples spin and bending, which needs a free spin.
  bool coupled_mass() const { return layout.spin == 1 && !unbalances.empty(); }
  // rad/s, spin speed if a motor holds it, which then exchanges work at the contacts too; otherwise
  // 0.
  double prescribed_spin() const { return layout.spin ? 0.0 : speed; }
  bool drive_follows() const { return drive && drive->follows(); }  // depends on angle and t
  int nq() const { return layout.nq(); }
  // The memory of the samplers occupies the coordinates from this one up to the coils.
  int sampled_states() const { return samplers.empty() ? layout.coil() : samplers.front().command; }
};

// The changing part of a system: time, coordinates and velocities.
struct State {
  double t = 0.0;
  Eigen::VectorXd q, v;  // nq
};

// Assembles the model of a scene. Throws scene::SceneError for errors that only the modes can show:
// more than kMaxCoordinates coordinates, lists of [initial] whose length is not the number of
// modes, a start outside the ring; and as modal_rotor(). start: changes q0 and v0 from the values
// in [initial], before the model fills in what depends on them. Without it the scene must not ask
// for a start on an orbit or a rub: programs call `prepare` (prepare/prepare.h), which makes such
// starts.
Model make_model(const scene::Scene& scene, const std::function<void(Model&)>& start = {});
State initial_state(const Model& model);
// Sets the weight for an acceleration (x, y), m/s^2.
void set_gravity(Model& model, const Eigen::Vector2d& acceleration);

// The model without the coordinates of the coils, for callers that integrate the currents
// themselves.
Model without_coils(Model model);
// The model with an ideal actuator without limits, for callers that know the force on the ring.
Model with_ideal_actuator(Model model);
// The model with the linear laws of the magnetic bearings: without limits, and linearised at the
// centre if two magnets oppose each other.
Model with_linear_feedback(Model model);
// The model with all shaft bearings aligned.
Model without_offsets(Model model);
// The model whose sampled controllers of rings keep their commands and memories among the states,
// so that a state determines its motion (control_states.h). Their sensors are exact then, without
// noise, which a state does not know, and without a resolution, because rounded numbers have no
// derivative. A memory that does not fit into kMaxCoordinates is not moved.
Model with_control_states(Model model);
// The model without controllers.
Model without_controller(Model model);
// The model whose first ring is driven by recorded commands instead of its controllers; unchanged
// if `commands` is null.
Model replayed(Model model, std::shared_ptr<const CommandRecord> commands);

}  // namespace rotorub
