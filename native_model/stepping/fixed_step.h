// What a fixed step of one run did, and what every scheme of fixed steps offers to a run.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "native_model/contact/step_contact.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The impacts of one step, in order.
struct ImpactList {
  int count = 0;
  std::array<Impact, StepImpacts::kMost> impact;
  void add(const Impact& i) {
    if (count < StepImpacts::kMost) impact[static_cast<std::size_t>(count++)] = i;
  }
  std::span<const Impact> view() const { return {impact.data(), static_cast<std::size_t>(count)}; }
};

// A command that jumps within a step: the share of the step before, in (0, 1), and the means before
// and after. Share 0: none.
struct CommandJump {
  double share = 0.0;
  Eigen::Vector2d before{0.0, 0.0}, after{0.0, 0.0};
};

// At one contact.
struct ContactStep {
  Mode mode = Mode::kFree;            // of lasting contact
  bool reversed = false;              // the slip changed its sign without sticking
  double normal_impulse = 0.0;        // N s over the step, impacts and lasting contact alike
  double friction_impulse = 0.0;      // N s, on the rotor along e_t
  Eigen::Vector2d lasting{0.0, 0.0};  // N s, normal and friction, of lasting contact alone
  // N, normal and friction: of an impact that takes time and was under way at the step's begin.
  Eigen::Vector2d impact_force{0.0, 0.0};
};

struct FixedStep : ContactStep {  // its own is that of the first contact
  Status status = Status::kOk;
  std::span<const ContactStep> others;  // of the further contacts; until the next call
  std::span<const Impact> impacts;      // of all, in order; until the next call
  double impact_time = 0.0;  // s, how long an impact lasts that takes time and began in the step
  // J, where asked for: of contact on the coordinates, and of it that of impacts; of all forces but
  // springs and contact.
  double contact_work = 0.0, impact_work = 0.0, external_work = 0.0;

  const ContactStep& at(std::size_t contact) const {
    return contact == 0 ? *this : others[contact - 1];
  }
};

class FixedStepper {
 public:
  virtual ~FixedStepper() = default;

  // From t_k = t_0 + k step to t_{k+1}, under the commands u of the actuators, one for each
  // auxiliary bearing. k counts from 0, one by one. `works`: those of the result are wanted. No
  // allocation. With a status the state stays where it was.
  virtual FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) = 0;
  virtual const double* q() const = 0;  // of t_{k+1}, nq values
  virtual const double* v() const = 0;  // of t_{k+1}; of a leapfrog of t_{k+1/2}

  // A leapfrog: impacts of a step are those between t_k and t_{k+1}, all else is what acts about
  // t_k. The rest is for leapfrogs alone.
  virtual bool leaps() const { return false; }
  // The command of the step that comes jumps within it.
  virtual void jump(std::size_t, const CommandJump&) {}
  // Before step k: the velocities of t_k under the commands that hold and the contact forces of the
  // step before.
  virtual void velocity_now(std::int64_t, std::span<const Eigen::Vector2d>, double*) {}
  // After step k: the state of t_k, velocities before an impact of the step.
  virtual const double* last_q() const { return q(); }
  virtual void last_velocity(double*) const {}
};

// From the model's initial state. step: s, > 0. The model must outlive it.
std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step);

}  // namespace rotorub
