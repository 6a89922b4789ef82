#include "native_model/stepping/stepper.h"

#include <cassert>

#include "native_model/stepping/paper_step.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {
namespace {

constexpr std::size_t kBeforeState = 3;  // numbers in a memory before q, see for_each_kept

template <class Kernel>
FixedStep take(Kernel& kernel, std::int64_t k, const Eigen::Vector2d& u, bool works) {
  kernel.command_x = u.x();
  kernel.command_y = u.y();
  kernel.commanded = kernel.commanded || !u.isZero(0.0);
  const double sign = kernel.slip_sign;
  kernel.step(k);
  FixedStep out;
  out.status = kernel.status[0];
  out.normal_impulse = kernel.normal_impulse;
  out.friction_impulse = kernel.friction_impulse;
  if (kernel.any_impact()) out.impacts = kernel.impacts[0];
  const bool impact = out.impacts.count > 0;
  if (kernel.in_contact > 0.0 && !impact) {
    out.mode = kernel.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
    out.reversed = sign * kernel.slip_sign < 0.0;
  }
  if (works && out.status == Status::kOk) {
    out.contact_work = kernel.contact_work_of_last();
    out.external_work = kernel.external_work_of_last();
  }
  return out;
}

template <class Kernel>
std::size_t count_kept(const Model& model) {
  Kernel kernel(model, {&model}, 1.0);
  std::size_t size = 0;
  kernel.for_each_kept([&size](double&) { ++size; });
  return size;
}

}  // namespace

struct PaperStepper::Kernel : PaperKernel<Model> {
  using PaperKernel<Model>::PaperKernel;
};
struct VerletStepper::Kernel : VerletKernel<Model> {
  using VerletKernel<Model>::VerletKernel;
};

#define ROTORUB_STEPPER(Stepper)                                                                  \
  Stepper::Stepper(const Model& model, double step) : Stepper(model, step, initial_state(model)) {} \
  Stepper::Stepper(const Model& model, double step, const State& start)                           \
      : kernel_(std::make_unique<Kernel>(model, std::vector<const Model*>{&model}, step)) {       \
    assert(step > 0.0);                                                                           \
    begin(start.t, start.q.data(), start.v.data());                                               \
  }                                                                                               \
  Stepper::~Stepper() = default;                                                                  \
  FixedStep Stepper::step(std::int64_t k, const Eigen::Vector2d& u, bool works) {                 \
    return take(*kernel_, k, u, works);                                                           \
  }                                                                                               \
  void Stepper::begin(double t, const double* q, const double* v) { kernel_->begin(t, q, v); }    \
  const double* Stepper::q() const { return kernel_->q(); }                                       \
  std::size_t Stepper::memory_size(const Model& model) { return count_kept<Kernel>(model); }      \
  void Stepper::save(double* to) const {                                                          \
    kernel_->for_each_kept([&to](double& value) { *to++ = value; });                              \
  }                                                                                               \
  void Stepper::restore(const double* from) {                                                     \
    kernel_->for_each_kept([&from](double& value) { value = *from++; });                          \
    kernel_->revive();                                                                            \
  }                                                                                               \
  const double* Stepper::saved_q(const double* memory) { return memory + kBeforeState; }

ROTORUB_STEPPER(PaperStepper)
ROTORUB_STEPPER(VerletStepper)
#undef ROTORUB_STEPPER

const double* PaperStepper::v() const { return kernel_->v(); }

void VerletStepper::adopt(const double* q, const double* v) { kernel_->adopt(q, v); }
void VerletStepper::apply(const double* loads) { kernel_->applied = loads; }
const double* VerletStepper::v_half() const { return kernel_->v(); }
void VerletStepper::velocity_now(std::int64_t k, const Eigen::Vector2d& held, double* v) {
  kernel_->command_x = held.x();
  kernel_->command_y = held.y();
  kernel_->velocity_now(k, v);
}
const double* VerletStepper::last_q() const { return kernel_->last_q(); }
void VerletStepper::last_velocity(double* v) const { kernel_->velocity_of_last(v); }
double VerletStepper::last_kick() const { return kernel_->was_first() ? 0.5 : 1.0; }

}  // namespace rotorub
