#include "native_model/stepping/stepper.h"

#include <algorithm>
#include <cassert>

#include "native_model/scene/run.h"
#include "native_model/stepping/euler.h"
#include "native_model/stepping/verlet.h"

namespace rotorub {
namespace {

// The interface to a step of `verlet`.
class Leapfrog final : public KeptStepper {
 public:
  Leapfrog(const Model& model, double h) : step_(model, h) {}

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override {
    command(u);
    if (!u[0].isZero(0.0)) step_.loads.drive_first_ring();
    step_.step(k);
    FixedStep out;
    step_.contacts.tell(out);
    out.status = step_.x.status;
    out.impact_time = step_.impact_time();
    out.impact_force = step_.impact_force(k);
    if (works && out.status == Status::kOk) {
      out.impact_work = impact_work(step_.x.m, out.impacts);
      out.contact_work = out.impact_work + step_.contacts.lasting_work(step_.x);
      out.external_work = step_.external_work();
    }
    return out;
  }
  const double* q() const override { return step_.x.q.data(); }
  const double* v() const override { return step_.x.v.data(); }

  void begin(double t, const double* q, const double* v) override {
    for_each_kept([](double& value) { value = 0.0; });
    step_.x.adopt(q, v);
    step_.x.origin = t;
    step_.x.status = Status::kOk;
    step_.restart();
  }
  std::size_t memory_size() override {
    std::size_t size = 0;
    for_each_kept([&size](double&) { ++size; });
    return size;
  }
  void save(double* to) override {
    for_each_kept([&to](double& value) { *to++ = value; });
  }
  void restore(const double* from) override {
    for_each_kept([&from](double& value) { value = *from++; });
    step_.x.status = Status::kOk;
    step_.loads.forget();
  }
  void adopt(const double* q, const double* v) override { step_.x.adopt(q, v); }
  void apply(const double* loads) override { step_.loads.applied = loads; }

  bool leaps() const override { return true; }
  void jump(std::size_t contact, const CommandJump& command) override {
    step_.announce_jump(contact, command);
  }
  void velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) override {
    command(held);
    step_.velocity_now(k, v);
  }
  const double* last_q() const override { return step_.x.seen.data(); }
  void last_velocity(double* v) const override { step_.last_velocity(v); }
  double last_kick() const override { return step_.was_first() ? 0.5 : 1.0; }

 private:
  void command(std::span<const Eigen::Vector2d> u) {
    std::copy(u.begin(), u.end(), step_.loads.command.begin());
  }
  // All numbers that are kept between steps: two of the contact and the origin of time, the state,
  // then those of the loads and of the scheme.
  template <class Action>
  void for_each_kept(Action action) {
    step_.contacts.for_each_kept(action);
    action(step_.x.origin);
    for (double& value : step_.x.q) action(value);
    for (double& value : step_.x.v) action(value);
    step_.loads.for_each_kept(action);
    step_.for_each_kept(action);
  }

  VerletStep step_;
};

}  // namespace

std::unique_ptr<KeptStepper> make_kept_stepper(const Model& model, double step,
                                               const State& start) {
  assert(step > 0.0);
  auto stepper = std::make_unique<Leapfrog>(model, step);
  stepper->begin(start.t, start.q.data(), start.v.data());
  return stepper;
}

std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step) {
  if (integrator == scene::Integrator::kEuler) return std::make_unique<EulerStepper>(model, step);
  return make_kept_stepper(model, step, initial_state(model));
}

}  // namespace rotorub
