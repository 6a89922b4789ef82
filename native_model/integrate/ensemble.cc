#include "native_model/integrate/ensemble.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "native_model/control/sampling.h"
#include "native_model/integrate/paper.h"
#include "native_model/integrate/paper_kernel_contact.h"
#include "native_model/integrate/paper_kernel_load.h"

// One body for each instruction set, chosen when the program is loaded. Contraction is off
// everywhere, so that all give the same bits.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define ROTORUB_EACH_TARGET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ROTORUB_EACH_TARGET
#endif

namespace rotorub {
namespace {

using lanes::Lane;
using Kernel = PaperKernel<Lane>;
static_assert(alignof(Kernel) == alignof(Lane) && alignof(Lane) == sizeof(Lane));

struct Totals {
  Lane first_touch = lanes::all<Lane>(-1.0);
  Lane contact_steps{}, impulse_total{}, peak_impulse{};
  std::int64_t impacts[lanes::kWidth] = {};
};

// Steps [from, from + count) of one group.
ROTORUB_EACH_TARGET
void advance(Kernel& kernel, Totals& totals, double step, std::int64_t from, std::int64_t count) {
  const Lane zero{}, one = lanes::all<Lane>(1.0);
  for (std::int64_t k = from; k < from + count; ++k) {
    kernel.step(k);
    const Lane impulse = kernel.normal_impulse;
    const lanes::LaneMask touched = impulse > zero;
    if (!lanes::any(touched)) continue;
    const Lane now = lanes::all<Lane>(static_cast<double>(k) * step);
    totals.first_touch =
        lanes::select(touched & (totals.first_touch < zero), now, totals.first_touch);
    totals.contact_steps += lanes::select(touched, one, zero);
    totals.impulse_total += impulse;
    totals.peak_impulse = lanes::larger(totals.peak_impulse, impulse);
    if (!kernel.any_impact()) continue;
    for (int lane = 0; lane < lanes::kWidth; ++lane) {
      if (kernel.impacted[lane] && counts(kernel.impact[lane])) ++totals.impacts[lane];
    }
  }
}

// Controllers see their own run only: a command for each lane, held between samples.
void command(Kernel& kernel, const std::vector<const Model*>& models,
             std::int64_t k, double step, std::vector<double>& q, std::vector<double>& v) {
  const double t = static_cast<double>(k) * step;
  for (int lane = 0; lane < lanes::kWidth; ++lane) {
    const Model& m = *models[static_cast<std::size_t>(lane)];
    if (!m.controller || t < m.control_on) continue;
    if (m.sample_time > 0.0 && k > 0) {
      const double before = t - step;
      const bool same = sample_index(t, m.sample_time) == sample_index(before, m.sample_time);
      if (before >= m.control_on && same) continue;
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = kernel.q()[i][lane];
      v[i] = kernel.v()[i][lane];
    }
    const Eigen::Vector2d u = control_command(m, t, q.data(), v.data());
    lanes::set(kernel.command_x, lane, u.x());
    lanes::set(kernel.command_y, lane, u.y());
  }
}

}  // namespace

double EnsembleRun::contact_fraction(double end, double step) const {
  if (first_touch < 0.0 || end <= first_touch) return 0.0;
  return std::min(1.0, static_cast<double>(contact_steps) * step / (end - first_touch));
}

double EnsembleRun::mean_force(double end) const {
  return first_touch < 0.0 || end <= first_touch ? 0.0 : impulse_total / (end - first_touch);
}

bool same_structure(const Model& a, const Model& b) {
  const auto layout = [](const Model& m) {
    return std::vector<int>{m.layout.modes, m.layout.spin, m.layout.torsion, m.layout.stator,
                            m.layout.coils, m.magnets.has_value()};
  };
  if (layout(a) != layout(b)) return false;
  if (a.forces.size() != b.forces.size() || a.springs.size() != b.springs.size()) return false;
  if (a.dampers.size() != b.dampers.size() || a.unbalances.size() != b.unbalances.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.forces.size(); ++i) {
    if (a.forces[i].kind != b.forces[i].kind) return false;
  }
  if (a.drive.has_value() != b.drive.has_value()) return false;
  if (a.drive && a.drive->kind() != b.drive->kind()) return false;
  return a.contact.has_value() == b.contact.has_value() &&
         a.weight.size() == b.weight.size() &&
         a.gyroscopic.absent() == b.gyroscopic.absent() &&
         a.internal_xx.absent() == b.internal_xx.absent() &&
         (a.controller == nullptr) == (b.controller == nullptr);
}

Ensemble::Ensemble(std::vector<Model> models, double step)
    : models_(std::move(models)), step_(step) {
  for (std::size_t i = 1; i < models_.size(); ++i) {
    if (!same_structure(models_.front(), models_[i])) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has other parts than run 0");
    }
  }
}

Ensemble::~Ensemble() = default;

std::vector<EnsembleRun> Ensemble::run(std::int64_t steps) {
  constexpr auto kWidth = static_cast<std::size_t>(lanes::kWidth);
  std::vector<EnsembleRun> out(models_.size());
  for (std::size_t begin = 0; begin < models_.size(); begin += kWidth) {
    // The last group is filled up with copies of its first run.
    std::vector<const Model*> group(kWidth);
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      group[lane] = &models_[begin + lane < models_.size() ? begin + lane : begin];
    }
    Kernel kernel(group, step_);
    Totals totals;
    const bool controlled = models_.front().controller != nullptr;
    const auto nq = static_cast<std::size_t>(models_.front().nq());
    std::vector<double> q(nq), v(nq);
    if (controlled) {
      for (std::int64_t k = 0; k < steps; ++k) {
        command(kernel, group, k, step_, q, v);
        advance(kernel, totals, step_, k, 1);
      }
    } else {
      advance(kernel, totals, step_, 0, steps);
    }
    for (std::size_t lane = 0; lane < kWidth && begin + lane < models_.size(); ++lane) {
      const int l = static_cast<int>(lane);
      EnsembleRun& r = out[begin + lane];
      r.status = step_refusal(*group[lane], step_).empty() ? kernel.status[l] : Status::kStepTooLarge;
      r.first_touch = totals.first_touch[l];
      r.contact_steps = static_cast<std::int64_t>(totals.contact_steps[l]);
      r.impacts = totals.impacts[l];
      r.impulse_total = totals.impulse_total[l];
      r.peak_impulse = totals.peak_impulse[l];
      for (std::size_t i = 0; i < nq; ++i) {
        r.q.push_back(kernel.q()[i][l]);
        r.v.push_back(kernel.v()[i][l]);
      }
    }
  }
  return out;
}

}  // namespace rotorub
