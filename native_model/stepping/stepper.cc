#include "native_model/stepping/stepper.h"

#include <algorithm>
#include <cassert>

#include "native_model/stepping/euler.h"
#include "native_model/stepping/verlet.h"

namespace rotorub {

VerletStepper::VerletStepper(const Model& model, double step)
    : VerletStepper(model, step, initial_state(model)) {}

VerletStepper::VerletStepper(const Model& model, double step, const State& start)
    : step_(std::make_unique<VerletStep>(model, step)) {
  assert(step > 0.0);
  begin(start.t, start.q.data(), start.v.data());
}

VerletStepper::~VerletStepper() = default;

FixedStep VerletStepper::step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) {
  command(u);
  if (!u[0].isZero(0.0)) step_->loads.drive_first_ring();
  step_->step(k);
  FixedStep out;
  step_->contacts.write_results(step_->impact_force(k), out);
  out.status = step_->state.status;
  out.impact_time = step_->impact_time();
  if (works && out.status == Status::kOk) {
    out.impact_work = impact_work(step_->state.model, out.impacts);
    out.contact_work = out.impact_work + step_->lasting_work();
    out.external_work = step_->external_work();
  }
  return out;
}

const double* VerletStepper::q() const { return step_->state.q.data(); }
const double* VerletStepper::v() const { return step_->state.v.data(); }
const double* VerletStepper::last_q() const { return step_->state.q_k.data(); }
const double* VerletStepper::last_velocity() const { return step_->last_velocity(); }
double VerletStepper::last_kick() const { return step_->state.kick_length; }

void VerletStepper::announce_command_jump(std::size_t contact, const CommandJump& command) {
  step_->announce_command_jump(contact, command);
}

void VerletStepper::velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) {
  command(held);
  step_->velocity_now(k, v);
}

void VerletStepper::begin(double t, const double* q, const double* v) {
  visit_saved([](double& value) { value = 0.0; });
  step_->state.adopt(q, v);
  step_->state.origin = t;
  step_->state.status = Status::kOk;
  step_->restart();
}

void VerletStepper::adopt(const double* q, const double* v) {
  step_->state.adopt(q, v);
  step_->discard_precomputed_kick();
}
void VerletStepper::apply(const double* loads) {
  step_->loads.applied = loads;
  step_->discard_precomputed_kick();
}

std::size_t VerletStepper::memory_size(const Model& model) {
  std::size_t count = 0;
  VerletStepper(model, 1.0).visit_saved([&count](double&) { ++count; });
  return count;
}

void VerletStepper::save(double* to) const {
  visit_saved([&to](double& value) { *to++ = value; });
}

void VerletStepper::restore(const double* from) {
  visit_saved([&from](double& value) { value = *from++; });
  step_->state.status = Status::kOk;
  step_->loads.forget();
  step_->discard_precomputed_kick();
}

void VerletStepper::command(std::span<const Eigen::Vector2d> u) {
  std::copy(u.begin(), u.end(), step_->loads.command.begin());
}

// Calls action for every number that is kept between steps. saved_q() relies on the beginning: two
// numbers of the first contact, the origin of time, q, v. The numbers of the loads and of the
// scheme follow.
template <class Action>
void VerletStepper::visit_saved(Action action) const {
  step_->contacts.visit_saved(action);
  action(step_->state.origin);
  for (double& value : step_->state.q) action(value);
  for (double& value : step_->state.v) action(value);
  step_->loads.visit_saved(action);
  step_->visit_saved(action);
}

std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step) {
  if (integrator == scene::Integrator::kEuler) return std::make_unique<EulerStepper>(model, step);
  return std::make_unique<VerletStepper>(model, step);
}

}  // namespace rotorub
