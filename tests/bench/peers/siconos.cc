// Siconos: its Moreau-Jean integrator (theta 1/2), its activation of contacts, its friction-contact
// problem in 2D and its impact law. The relation is ours: q = (x, y, phi | ring x, y),
//
//   y_N = delta_0 - |d|,  H_N = (-e_r, 0 | e_r),   H_T = (e_t, r | -e_t)   at the present positions
//
// The normal is that at the beginning of the step, so Siconos loses angular momentum in the
// billiard. Newton iterations would change nothing, because they reduce the residual of the bodies,
// which are linear. Debian's Siconos has assertions enabled; one without was not tried.
// A held spin is a degree of freedom with an inertia that nothing here turns (kHeld).
// This is the one file that sees Siconos' headers.

#include <SolverOptions.h>
#include <SiconosKernel.hpp>

#include <algorithm>
#include <string>

#include "tests/bench/peers/stepper.h"

namespace rotorub::peers {
namespace {

constexpr double kHeld = 1e9;  // kg m^2
// Tolerance of the solver of the 2x2 problem; the problems are so small that it costs nothing.
constexpr double kSolverTolerance = 1e-13;

SP::SiconosVector vector_of(std::initializer_list<double> values) {
  auto v = std::make_shared<SiconosVector>(static_cast<unsigned>(values.size()));
  unsigned i = 0;
  for (const double x : values) v->setValue(i++, x);
  return v;
}

SP::SimpleMatrix diagonal(std::initializer_list<double> values) {
  const auto n = static_cast<unsigned>(values.size());
  auto m = std::make_shared<SimpleMatrix>(n, n);
  m->zero();
  unsigned i = 0;
  for (const double x : values) {
    m->setValue(i, i, x);
    ++i;
  }
  return m;
}

// A linear body under a load of time.
class LoadedBody : public LagrangianLinearTIDS {
 public:
  LoadedBody(const PlanarSystem& system, SP::SiconosVector q, SP::SiconosVector v,
             SP::SiconosMatrix m)
      : LagrangianLinearTIDS(std::move(q), std::move(v), std::move(m)), system_(system) {
    allocateFExt();
  }
  void computeFExt(double t) override {
    const Pair load = system_.load(t);
    _fExt->setValue(0, load[0]);
    _fExt->setValue(1, load[1]);
    _fExt->setValue(2, system_.spin_is_free ? system_.drive_gain * system_.drive_speed : 0.0);
  }

 private:
  const PlanarSystem& system_;
};

class DiscInRing : public LagrangianScleronomousR {
 public:
  explicit DiscInRing(const PlanarSystem& system) : system_(system) {}
  void computeh(const BlockVector& q, BlockVector&, SiconosVector& y) override {
    y.setValue(0, gap(q).gap);
    y.setValue(1, 0.0);
  }
  void computeJachq(const BlockVector& q, BlockVector&) override {
    const Pair n = gap(q).normal;
    const auto put = [this](unsigned row, unsigned column, double value) {
      _jachq->setValue(row, column, value);
    };
    put(0, 0, -n[0]);
    put(0, 1, -n[1]);
    put(0, 2, 0.0);
    put(1, 0, -n[1]);
    put(1, 1, n[0]);
    put(1, 2, system_.radius);
    if (!system_.ring_moves) return;
    put(0, 3, n[0]);
    put(0, 4, n[1]);
    put(1, 3, n[1]);
    put(1, 4, -n[0]);
  }

 private:
  PlanarGap gap(const BlockVector& q) const {
    const Pair ring = system_.ring_moves ? Pair{q.getValue(3), q.getValue(4)} : Pair{0.0, 0.0};
    return planar_gap(system_, {q.getValue(0), q.getValue(1)}, {}, ring, {}, 0.0);
  }
  const PlanarSystem& system_;
};

class SiconosStepper final : public Stepper {
 public:
  SiconosStepper(const PlanarSystem& system, double step) : system_(system) {
    const PlanarSystem& s = system_;
    const double inertia = s.spin_is_free ? s.inertia : kHeld;
    const PlanarSupport& r = s.rotor;
    rotor_ =
        std::make_shared<LoadedBody>(system_, vector_of({s.position[0], s.position[1], s.angle}),
                                     vector_of({s.velocity[0], s.velocity[1], s.speed}),
                                     diagonal({r.mass[0], r.mass[1], inertia}));
    rotor_->setKPtr(diagonal({r.stiffness[0], r.stiffness[1], 0.0}));
    rotor_->setCPtr(diagonal({r.damping[0], r.damping[1], s.spin_is_free ? s.drive_gain : 0.0}));
    if (s.ring_moves) {
      ring_ = std::make_shared<LagrangianLinearTIDS>(
          vector_of({s.ring_position[0], s.ring_position[1]}),
          vector_of({s.ring_velocity[0], s.ring_velocity[1]}),
          diagonal({s.ring.mass[0], s.ring.mass[1]}));
      ring_->setKPtr(diagonal({s.ring.stiffness[0], s.ring.stiffness[1]}));
      ring_->setCPtr(diagonal({s.ring.damping[0], s.ring.damping[1]}));
    }
    contact_ = std::make_shared<Interaction>(
        std::make_shared<NewtonImpactFrictionNSL>(s.restitution, 0.0, s.friction, 2),
        std::make_shared<DiscInRing>(system_));
    constexpr double kEnd = 1e9;  // s: it is we who stop
    model_ = std::make_shared<NonSmoothDynamicalSystem>(0.0, kEnd);
    model_->insertDynamicalSystem(rotor_);
    if (ring_) model_->insertDynamicalSystem(ring_);
    if (ring_) {
      model_->link(contact_, rotor_, ring_);
    } else {
      model_->link(contact_, rotor_);
    }
    auto problem = std::make_shared<FrictionContact>(2, SICONOS_FRICTION_2D_NSGS);
    problem->numericsSolverOptions()->dparam[SICONOS_DPARAM_TOL] = kSolverTolerance;
    run_ = std::make_shared<TimeStepping>(model_, std::make_shared<TimeDiscretisation>(0.0, step),
                                          std::make_shared<MoreauJeanOSI>(0.5), problem);
    // One solution a step, with the normal of its begin. Newton iterations (SICONOS_TS_NONLINEAR)
    // change nothing: they look at the residual of the bodies, which are linear, and a residual of
    // the relation is not implemented for this kind.
    run_->setNewtonOptions(SICONOS_TS_LINEAR);
    run_->setWarnOnNonConvergence(false);
  }

  bool advance(std::int64_t count, StepRecord* records) override {
    try {
      for (std::int64_t i = 0; i < count; ++i) {
        run_->computeOneStep();
        read(records[i]);
        run_->nextStep();
      }
      return true;
    } catch (const std::exception& error) {
      message_ = error.what();
    } catch (...) {
      message_ = "Siconos threw something without a message";
    }
    return false;
  }
  const char* message() const override { return message_.c_str(); }

 private:
  void read(StepRecord& r) const {
    r = StepRecord{};
    const auto pair = [](const SP::SiconosVector& v) {
      return Pair{v->getValue(0), v->getValue(1)};
    };
    r.position = pair(rotor_->q());
    r.velocity = pair(rotor_->velocity());
    r.angle = rotor_->q()->getValue(2);
    r.speed = rotor_->velocity()->getValue(2);
    if (ring_) {
      r.ring_position = pair(ring_->q());
      r.ring_velocity = pair(ring_->velocity());
    }
    const SP::SiconosVector impulse = contact_->lambda(1);
    r.normal = std::max(0.0, impulse->getValue(0));
    r.friction = r.normal > 0.0 ? impulse->getValue(1) : 0.0;
  }

  const PlanarSystem system_;
  std::shared_ptr<LoadedBody> rotor_;
  SP::LagrangianLinearTIDS ring_;
  SP::Interaction contact_;
  SP::NonSmoothDynamicalSystem model_;
  SP::TimeStepping run_;
  std::string message_;
};

Stepper* make(const PlanarSystem& system, double step) { return new SiconosStepper(system, step); }

}  // namespace
}  // namespace rotorub::peers

extern "C" const rotorub::peers::ModuleInterface rotorub_peer{"Siconos 4.4", rotorub::peers::make};
