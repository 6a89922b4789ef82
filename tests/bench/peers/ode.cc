// ODE: dWorldStep, its own mass matrix, its LCP with friction. Two bodies that move in the plane
// z = 0; one contact joint made anew at every step where the disc is in the ring, at the present
// positions:
//
//   normal      -e_r, on the rotor; depth |d| - delta_0
//   friction    along e_t alone (mu2 = 0 across), limited by mu times the normal force
//               (dContactApprox1)
//   restitution dContactBounce, above a closing speed that is none (kBounceSpeed)
//
// A held spin is a surface speed of the contact (dContactMotion1), a fixed ring a joint to the
// world. Springs, dampers, loads and the drive are forces at the begin of the step, as ODE has
// them.

#include <ode/ode.h>

#include "tests/bench/peers/stepper.h"

namespace rotorub::peers {
namespace {

// m/s: slower closings do not bounce. Without this limit the acceleration of one step would cause
// bounces for ever.
constexpr double kBounceSpeed = 1e-3;
// kg m^2, inertia of bodies that must not turn: the ring about any axis, the rotor about x and y.
constexpr double kHeld = 1e6;
// Share of the depth that a step takes out (ODE's own default is 0.2).
constexpr double kErp = 0.2;

void add_body_force(dBodyID body, const PlanarSupport& s, const Pair& load) {
  const dReal *x = dBodyGetPosition(body), *v = dBodyGetLinearVel(body);
  dBodyAddForce(body, load[0] - s.stiffness[0] * x[0] - s.damping[0] * v[0],
                load[1] - s.stiffness[1] * x[1] - s.damping[1] * v[1], 0.0);
}

class OdeStepper final : public Stepper {
 public:
  OdeStepper(const PlanarSystem& system, double step) : system_(system), step_(step) {
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0.0, 0.0, 0.0);
    dWorldSetERP(world_, kErp);
    dWorldSetCFM(world_, 0.0);
    dWorldSetAutoDisableFlag(world_, 0);
    joints_ = dJointGroupCreate(0);
    rotor_ = body(system.rotor.mass[0], system.spin_is_free ? system.inertia : kHeld,
                  system.position, system.velocity);
    // A held spin does not turn the body; the contact's surface moves instead.
    if (system.spin_is_free) dBodySetAngularVel(rotor_, 0.0, 0.0, system.speed);
    if (system.ring_moves) {
      ring_ = body(system.ring.mass[0], kHeld, system.ring_position, system.ring_velocity);
    }
    angle_ = system.angle;
  }
  OdeStepper(const OdeStepper&) = delete;
  OdeStepper& operator=(const OdeStepper&) = delete;
  ~OdeStepper() override {
    dJointGroupDestroy(joints_);
    dWorldDestroy(world_);
  }

  bool advance(std::int64_t count, StepRecord* records) override {
    for (std::int64_t i = 0; i < count; ++i, ++taken_) step(records[i]);
    return true;
  }
  const char* message() const override { return ""; }

 private:
  dBodyID body(double mass, double inertia, const Pair& x, const Pair& v) {
    const dBodyID b = dBodyCreate(world_);
    dMass m;
    dMassSetParameters(&m, mass, 0, 0, 0, kHeld, kHeld, inertia, 0, 0, 0);
    dBodySetMass(b, &m);
    dBodySetPosition(b, x[0], x[1], 0.0);
    dBodySetLinearVel(b, v[0], v[1], 0.0);
    dBodySetGyroscopicMode(b, 0);
    // The disc is round, so its attitude is not followed, which keeps it in the plane.
    dBodySetFiniteRotationMode(b, 0);
    return b;
  }

  void step(StepRecord& r) {
    const double t = static_cast<double>(taken_) * step_;
    add_body_force(rotor_, system_.rotor, system_.load(t));
    if (ring_) add_body_force(ring_, system_.ring, {0.0, 0.0});
    if (system_.spin_is_free) {
      const double speed = dBodyGetAngularVel(rotor_)[2];
      dBodyAddTorque(rotor_, 0.0, 0.0, system_.drive_gain * (system_.drive_speed - speed));
    }
    const PlanarGap gap = touch();
    dWorldStep(world_, step_);
    read(r, gap);
    dJointGroupEmpty(joints_);
    touching_ = false;
  }

  PlanarGap touch() {
    const dReal *x = dBodyGetPosition(rotor_), *v = dBodyGetLinearVel(rotor_);
    const dReal still[3] = {0.0, 0.0, 0.0};
    const dReal *s = ring_ ? dBodyGetPosition(ring_) : still,
                *w = ring_ ? dBodyGetLinearVel(ring_) : still;
    const PlanarGap g =
        planar_gap(system_, {x[0], x[1]}, {v[0], v[1]}, {s[0], s[1]}, {w[0], w[1]}, system_.speed);
    if (g.gap > 0.0) return g;
    const Pair& n = g.normal;
    dContact c{};
    c.surface.mode = dContactMu2 | dContactFDir1 | dContactBounce | dContactApprox1;
    c.surface.mu = system_.friction;
    c.surface.mu2 = 0.0;
    c.surface.bounce = system_.restitution;
    c.surface.bounce_vel = kBounceSpeed;
    c.fdir1[0] = -n[1];
    c.fdir1[1] = n[0];
    if (!system_.spin_is_free) {
      c.surface.mode |= dContactMotion1;
      // Target of the joint for e_t . (v_rotor - v_ring): the disc's surface moves on at r Omega.
      c.surface.motion1 = -system_.radius * system_.speed;
    }
    c.geom.normal[0] = -n[0];
    c.geom.normal[1] = -n[1];
    c.geom.depth = -g.gap;
    c.geom.pos[0] = x[0] + system_.radius * n[0];
    c.geom.pos[1] = x[1] + system_.radius * n[1];
    const dJointID joint = dJointCreateContact(world_, joints_, &c);
    dJointSetFeedback(joint, &feedback_);
    dJointAttach(joint, rotor_, ring_);
    touching_ = true;
    return g;
  }

  void read(StepRecord& r, const PlanarGap& gap) {
    const dReal *x = dBodyGetPosition(rotor_), *v = dBodyGetLinearVel(rotor_);
    r = StepRecord{};
    r.position = {x[0], x[1]};
    r.velocity = {v[0], v[1]};
    if (ring_) {
      const dReal *s = dBodyGetPosition(ring_), *w = dBodyGetLinearVel(ring_);
      r.ring_position = {s[0], s[1]};
      r.ring_velocity = {w[0], w[1]};
    }
    r.speed = system_.spin_is_free ? dBodyGetAngularVel(rotor_)[2] : system_.speed;
    // ODE stores attitudes, not numbers of turns.
    angle_ += step_ * r.speed;
    r.angle = angle_;
    if (!touching_) return;
    const dReal* f = feedback_.f1;
    const Pair& n = gap.normal;
    r.normal = -step_ * (f[0] * n[0] + f[1] * n[1]);
    r.friction = step_ * (-f[0] * n[1] + f[1] * n[0]);
    if (r.normal <= 0.0) r.normal = r.friction = 0.0;
  }

  PlanarSystem system_;
  double step_, angle_ = 0.0;
  dWorldID world_;
  dJointGroupID joints_;
  dBodyID rotor_ = nullptr, ring_ = nullptr;
  dJointFeedback feedback_{};
  bool touching_ = false;
  std::int64_t taken_ = 0;
};

// By default ODE's errors end the program, and its messages go to standard error. Both are
// disabled.
void silent(int, const char*, va_list) {}

Stepper* make(const PlanarSystem& system, double step) {
  // Its bodies have one mass for both directions.
  const auto one_mass = [](const PlanarSupport& s) { return s.mass[0] == s.mass[1]; };
  if (!one_mass(system.rotor) || (system.ring_moves && !one_mass(system.ring))) return nullptr;
  static const bool ready = [] {
    dInitODE2(0);
    dSetMessageHandler(silent);
    return true;
  }();
  (void)ready;
  return new OdeStepper(system, step);
}

}  // namespace
}  // namespace rotorub::peers

extern "C" const rotorub::peers::ModuleInterface rotorub_peer{"ODE " dODE_VERSION,
                                                              rotorub::peers::make};
