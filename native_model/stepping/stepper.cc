#include "native_model/stepping/stepper.h"

#include <cassert>
#include <type_traits>

#include "native_model/scene/run.h"
#include "native_model/stepping/euler.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {
namespace {

// A scheme's step, of a model of any size, of one contact or several.
template <class Step, class M>
class StepperWith final : public KeptStepper {
 public:
  StepperWith(const Model& model, double h) : model_(model), step_(model_, {&model}, h) {}

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override {
    command(u);
    if (!u[0].isZero(0.0)) step_.loads.drive_first_ring();
    const double sign = step_.contact.slip_sign();
    step_.step(k);
    FixedStep out;
    step_.contact.tell(out, sign);
    out.status = step_.x.status[0];
    if constexpr (kLeaps) {
      if (step_.takes_time) {
        out.impact_time = step_.impact_time[0];
        out.impact_force = step_.impact_force(0, k);
      }
    }
    if (works && out.status == Status::kOk) {
      out.impact_work = impact_work(model_, out.impacts);
      out.contact_work = out.impact_work + step_.contact.lasting_work(step_.x);
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
    step_.x.revive();
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
    step_.x.revive();
    step_.loads.forget(step_.x.m);
  }
  void adopt(const double* q, const double* v) override { step_.x.adopt(q, v); }
  void apply(const double* loads) override { step_.loads.applied = loads; }

  bool leaps() const override { return kLeaps; }
  void jump(std::size_t contact, const CommandJump& command) override {
    if constexpr (kLeaps) step_.jump(contact, command);
  }
  void velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) override {
    command(held);
    if constexpr (kLeaps) step_.velocity_now(k, v);
  }
  const double* last_q() const override { return kLeaps ? step_.x.seen.data() : q(); }
  void last_velocity(double* v) const override {
    if constexpr (kLeaps) step_.last_velocity(v);
  }
  double last_kick() const override {
    if constexpr (kLeaps) return step_.was_first ? 0.5 : 1.0;
    return 1.0;
  }

 private:
  static constexpr bool kLeaps = requires(const Step& s) { s.was_first; };

  void command(std::span<const Eigen::Vector2d> u) {
    for (std::size_t i = 0; i < u.size(); ++i) step_.loads.command[i] = {u[i].x(), u[i].y()};
  }
  // All that outlives a step, as plain numbers: two of the contact and the origin of time, the
  // state, and what loads and scheme keep.
  template <class Action>
  void for_each_kept(Action action) {
    step_.contact.for_each_kept(action);
    action(step_.x.origin);
    for (double& value : step_.x.q) action(value);
    for (double& value : step_.x.v) action(value);
    step_.loads.for_each_kept(action);
    step_.for_each_kept(action);
  }

  // A copy where the layout is another than the model's own.
  std::conditional_t<std::is_same_v<M, Model>, const Model&, const M> model_;
  Step step_;
};

template <class M, template <class, class> class Scheme, class Contacts>
std::unique_ptr<KeptStepper> stepper_with(const Model& model, double h) {
  return std::make_unique<StepperWith<Scheme<M, Contacts>, M>>(model, h);
}

template <template <class, class> class Scheme>
std::unique_ptr<KeptStepper> with_contacts(const Model& model, double h) {
  if (model.gives()) return stepper_with<Model, Scheme, CompliantContacts>(model, h);
  if (model.auxiliary.size() > 1) return stepper_with<Model, Scheme, SeveralContacts>(model, h);
  return stepper_with<Model, Scheme, OneContact<Model>>(model, h);
}

// The step of a small layout, where there is one.
std::unique_ptr<KeptStepper> verlet_stepper(const Model& model, double h) {
  using M = DrivenJeffcott;
  const bool one_rigid = model.auxiliary.size() == 1 && !model.gives();
  if (one_rigid && DrivenJeffcottInRing::fits(model.layout)) {
    return stepper_with<M, VerletStep, OneContact<M>>(model, h);
  }
  return with_contacts<VerletStep>(model, h);
}

}  // namespace

std::unique_ptr<KeptStepper> make_kept_stepper(const Model& model, double step,
                                               const State& start) {
  assert(step > 0.0);
  auto stepper = verlet_stepper(model, step);
  stepper->begin(start.t, start.q.data(), start.v.data());
  return stepper;
}

std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step) {
  if (integrator == scene::Integrator::kEuler) return std::make_unique<EulerStepper>(model, step);
  return make_kept_stepper(model, step, initial_state(model));
}

}  // namespace rotorub
