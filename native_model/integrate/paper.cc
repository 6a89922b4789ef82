#include "native_model/integrate/paper.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "native_model/integrate/paper_kernel_contact.h"
#include "native_model/integrate/paper_kernel_load.h"
#include "native_model/integrate/paper_kernel_memory.h"

namespace rotorub {

struct PaperStepper::Kernel : PaperKernel<double> {
  using PaperKernel<double>::PaperKernel;
};

double circle_crossing(double dx, double dy, double vx, double vy, double radius, double h) {
  const double a = vx * vx + vy * vy, b = dx * vx + dy * vy;
  const double c = dx * dx + dy * dy - radius * radius;
  if (a == 0.0 || c >= 0.0) return 0.0;
  const double root = std::sqrt(b * b - a * c);
  // The positive root, without cancellation.
  const double s = b > 0.0 ? -c / (b + root) : (root - b) / a;
  return std::clamp(s, 0.0, h);
}

std::string step_beyond(double step, double limit) {
  char text[96];
  std::snprintf(text, sizeof text, "step %g s is not below 2 / omega_max = %.4g s", step, limit);
  return text;
}

std::string step_refusal(const Model& model, double step) {
  double largest = 0.0;
  for (int i = 0; i < model.nq(); ++i) {
    largest = std::max(largest, model.stiffness[i] / model.mass[i]);
  }
  const double limit = 2.0 / std::sqrt(largest);
  if (largest == 0.0 || step < limit) return {};
  return step_beyond(step, limit) + " of the stiffest mode";
}

PaperStepper::PaperStepper(const Model& model, double step)
    : PaperStepper(model, step, initial_state(model)) {}

PaperStepper::PaperStepper(const Model& model, double step, const State& start)
    : kernel_(std::make_unique<Kernel>(std::vector<const Model*>{&model}, step)) {
  assert(step > 0.0);
  begin(start.t, start.q.data(), start.v.data());
}

PaperStepper::~PaperStepper() = default;

void PaperStepper::begin(double t, const double* q, const double* v) { kernel_->begin(t, q, v); }

const double* PaperStepper::q() const { return kernel_->q(); }
const double* PaperStepper::v() const { return kernel_->v(); }

std::size_t PaperStepper::memory_size(const Model& model) { return Kernel::memory_size(model); }
void PaperStepper::save(double* to) const { kernel_->save(to); }
void PaperStepper::restore(const double* from) { kernel_->restore(from); }
const double* PaperStepper::saved_q(const double* memory) { return Kernel::saved_q(memory); }

PaperStep PaperStepper::step(std::int64_t k, const Eigen::Vector2d& u) {
  Kernel& kernel = *kernel_;
  kernel.command_x = u.x();
  kernel.command_y = u.y();
  kernel.commanded = kernel.commanded || !u.isZero(0.0);
  kernel.step(k);
  PaperStep out;
  out.status = kernel.status[0];
  out.normal_impulse = kernel.normal_impulse;
  out.friction_impulse = kernel.friction_impulse;
  out.impact = kernel.impacted[0];
  if (out.impact) out.detail = kernel.impact[0];
  if (kernel.in_contact() > 0.0) {
    out.mode = kernel.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
  }
  return out;
}

}  // namespace rotorub
