#include "native_model/stepping/stepper.h"

#include <cassert>

#include "native_model/stepping/coupled_midpoint.h"
#include "native_model/stepping/coupled_verlet.h"
#include "native_model/stepping/euler.h"
#include "native_model/stepping/midpoint_step.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {

// What a kernel of any size offers beside.
struct Stepper::Kernel : FixedStepper {
  virtual void begin(double t, const double* q, const double* v) = 0;
  virtual std::size_t memory_size() = 0;
  virtual void save(double* to) = 0;
  virtual void restore(const double* from) = 0;
  virtual void adopt(const double* q, const double* v) = 0;
  virtual void apply(const double* loads) = 0;
  virtual double last_kick() const = 0;

  template <template <class> class Scheme, class M>
  class Of;
  // The kernel of the model's size.
  template <template <class> class Scheme>
  static std::unique_ptr<Kernel> make(const Model& model, double h, const State& start);
};

template <template <class> class Scheme, class M>
class Stepper::Kernel::Of final : public Stepper::Kernel {
 public:
  Of(const Model& model, double h) : model_(model), kernel_(model_, {&model}, h) {}

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override {
    command(u);
    kernel_.commanded = kernel_.commanded || !u[0].isZero(0.0);
    const double sign = kernel_.slip_sign;
    kernel_.step(k);
    FixedStep out;
    out.status = kernel_.status[0];
    out.normal_impulse = kernel_.normal_impulse;
    out.friction_impulse = kernel_.friction_impulse;
    if (kernel_.any_impact()) {
      out.impacts = kernel_.impacts[0].view();
    } else {
      out.lasting = {out.normal_impulse, out.friction_impulse};
      if (kernel_.in_contact > 0.0) {
        out.mode = kernel_.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
        out.reversed = sign * kernel_.slip_sign < 0.0;
      }
    }
    if constexpr (kLate) {
      out.impact_time = kernel_.impact_time[0];
      out.impact_force = kernel_.impact_force(0, k);
    }
    if (works && out.status == Status::kOk) {
      out.contact_work = kernel_.contact_work_of_last();
      if (kernel_.any_impact()) out.impact_work = out.contact_work;
      out.external_work = kernel_.external_work_of_last();
    }
    return out;
  }
  void begin(double t, const double* q, const double* v) override { kernel_.begin(t, q, v); }
  const double* q() const override { return kernel_.q(); }
  const double* v() const override { return kernel_.v(); }
  std::size_t memory_size() override {
    std::size_t size = 0;
    kernel_.for_each_kept([&size](double&) { ++size; });
    return size;
  }
  void save(double* to) override {
    kernel_.for_each_kept([&to](double& value) { *to++ = value; });
  }
  void restore(const double* from) override {
    kernel_.for_each_kept([&from](double& value) { value = *from++; });
    kernel_.revive();
  }
  void adopt(const double* q, const double* v) override { kernel_.adopt(q, v); }
  void apply(const double* loads) override { kernel_.applied = loads; }

  bool leaps() const override { return kLate; }
  void jump(std::size_t, const CommandJump& command) override {
    if constexpr (kLate) kernel_.jump(0, command);
  }
  void velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) override {
    command(held);
    if constexpr (kLate) kernel_.velocity_now(k, v);
  }
  const double* last_q() const override {
    if constexpr (kLate) return kernel_.last_q();
    return q();
  }
  void last_velocity(double* v) const override {
    if constexpr (kLate) kernel_.velocity_of_last(v);
  }
  double last_kick() const override {
    if constexpr (kLate) return kernel_.was_first() ? 0.5 : 1.0;
    return 1.0;
  }

 private:
  void command(std::span<const Eigen::Vector2d> u) {
    kernel_.command_x = u[0].x();
    kernel_.command_y = u[0].y();
  }

  static constexpr bool kLate = requires(const Scheme<M>& k) { k.last_q(); };
  // A copy where the layout is another than the model's own.
  std::conditional_t<std::is_same_v<M, Model>, const Model&, const M> model_;
  Scheme<M> kernel_;
};

template <template <class> class Scheme>
std::unique_ptr<Stepper::Kernel> Stepper::Kernel::make(const Model& model, double h,
                                                       const State& start) {
  assert(h > 0.0 && model.auxiliary.size() == 1);
  std::unique_ptr<Kernel> kernel;
#define ROTORUB_SIZE(L, unused)                                       \
  if (L::fits(model.layout)) {                                        \
    kernel = std::make_unique<Of<Scheme, Sized<Model, L>>>(model, h); \
  }
  ROTORUB_SMALL_LAYOUTS(ROTORUB_SIZE, )
#undef ROTORUB_SIZE
  if (!kernel) kernel = std::make_unique<Of<Scheme, Model>>(model, h);
  kernel->begin(start.t, start.q.data(), start.v.data());
  return kernel;
}

Stepper::Stepper(std::unique_ptr<Kernel> kernel) : kernel_(std::move(kernel)) {}
Stepper::~Stepper() = default;
FixedStep Stepper::step(std::int64_t k, const Eigen::Vector2d& u, bool works) {
  return kernel_->step(k, std::span(&u, 1), works);
}
void Stepper::begin(double t, const double* q, const double* v) { kernel_->begin(t, q, v); }
const double* Stepper::q() const { return kernel_->q(); }
void Stepper::save(double* to) const { kernel_->save(to); }
void Stepper::restore(const double* from) { kernel_->restore(from); }
const double* Stepper::saved_q(const double* memory) {
  constexpr std::size_t kBeforeState = 3;  // numbers before q, see for_each_kept
  return memory + kBeforeState;
}

MidpointStepper::MidpointStepper(const Model& model, double step)
    : MidpointStepper(model, step, initial_state(model)) {}
MidpointStepper::MidpointStepper(const Model& model, double step, const State& start)
    : Stepper(Kernel::make<MidpointKernel>(model, step, start)) {}
std::size_t MidpointStepper::memory_size(const Model& model) {
  return Kernel::Of<MidpointKernel, Model>(model, 1.0).memory_size();
}
const double* MidpointStepper::v() const { return kernel_->v(); }

VerletStepper::VerletStepper(const Model& model, double step)
    : VerletStepper(model, step, initial_state(model)) {}
VerletStepper::VerletStepper(const Model& model, double step, const State& start)
    : Stepper(Kernel::make<VerletKernel>(model, step, start)) {}
std::size_t VerletStepper::memory_size(const Model& model) {
  return Kernel::Of<VerletKernel, Model>(model, 1.0).memory_size();
}
void VerletStepper::adopt(const double* q, const double* v) { kernel_->adopt(q, v); }
void VerletStepper::apply(const double* loads) { kernel_->apply(loads); }
void VerletStepper::jump(const CommandJump& command) { kernel_->jump(0, command); }
const double* VerletStepper::v_half() const { return kernel_->v(); }
void VerletStepper::velocity_now(std::int64_t k, const Eigen::Vector2d& held, double* v) {
  kernel_->velocity_now(k, std::span(&held, 1), v);
}
const double* VerletStepper::last_q() const { return kernel_->last_q(); }
void VerletStepper::last_velocity(double* v) const { kernel_->last_velocity(v); }
double VerletStepper::last_kick() const { return kernel_->last_kick(); }

std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step) {
  const bool leaps = integrator == scene::Integrator::kVerlet;
  if (integrator == scene::Integrator::kEuler) return std::make_unique<EulerStepper>(model, step);
  if (model.auxiliary.size() > 1) {
    if (leaps) return std::make_unique<CoupledVerlet>(model, step);
    return std::make_unique<CoupledMidpoint>(model, step);
  }
  const State start = initial_state(model);
  if (leaps) return Stepper::Kernel::make<VerletKernel>(model, step, start);
  return Stepper::Kernel::make<MidpointKernel>(model, step, start);
}

}  // namespace rotorub
