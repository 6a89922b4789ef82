#include "native_model/stepping/ensemble.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "native_model/stepping/lane_steps.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/zero_order_hold.h"

namespace rotorub {
namespace {

// Controllers see their own run only: a command for each lane.
template <class Kernel>
class LaneCommands {
 public:
  using T = typename Kernel::T;

  LaneCommands(const std::vector<const Model*>& group, double step)
      : step_(step), v_(static_cast<std::size_t>(group.front()->nq()), T{}) {
    for (const Model* m : group) holds_.emplace_back(*m);
  }

  void tell(Kernel& kernel, std::int64_t k) {
    const double t = static_cast<double>(k) * step_, end = t + 0.5 * step_;
    constexpr bool kLate = requires { velocities_now(kernel, k, v_.data()); };
    const bool listens = std::any_of(holds_.begin(), holds_.end(),
                                     [&](const ZeroOrderHold& h) { return h.listens(end); });
    for (int lane = 0; lane < Kernel::kLanes; ++lane) {
      const Eigen::Vector2d& held = holds_[static_cast<std::size_t>(lane)].held();
      lanes::set(kernel.command_x, lane, held.x());
      lanes::set(kernel.command_y, lane, held.y());
    }
    if (!listens) return;
    if constexpr (kLate) velocities_now(kernel, k, v_.data());
    const int nq = static_cast<int>(v_.size());
    double q[kMaxCoordinates], v[kMaxCoordinates], a[kMaxCoordinates];
    for (int lane = 0; lane < Kernel::kLanes; ++lane) {
      ZeroOrderHold& hold = holds_[static_cast<std::size_t>(lane)];
      for (int i = 0; i < nq; ++i) {
        q[i] = lanes::get(kernel.q()[i], lane);
        v[i] = lanes::get(kLate ? v_[static_cast<std::size_t>(i)] : kernel.v()[i], lane);
        a[i] = k == 0 ? 0.0 : 2.0 / step_ * (v[i] - lanes::get(kernel.v()[i], lane));
      }
      const Eigen::Vector2d u =
          !kLate ? hold.at(t, q, v)
                 : (hold.listens(end) ? hold.mean(k == 0 ? t : t - 0.5 * step_, t, end, q, v, a)
                                      : hold.held());
      lanes::set(kernel.command_x, lane, u.x());
      lanes::set(kernel.command_y, lane, u.y());
    }
  }

 private:
  double step_;
  std::vector<ZeroOrderHold> holds_;
  lanes::Array<T> v_;
};

// The runs of one group of lanes, by a kernel of the model's size.
template <class Kernel, class M, int W>
struct LaneGroup {
  static constexpr bool kVerlet = std::is_same_v<Kernel, VerletKernel<M>>;

  LaneGroup(std::vector<const Model*> runs, double step)
      : models(std::move(runs)), model(Lanes<W>(models)), work{Kernel(model, models, step), {}} {
    work.kernel.load_initial_states();
    if constexpr (kVerlet) work.kernel.restart();
  }

  void report(double step, std::int64_t steps, std::span<EnsembleRun> out) {
    const auto nq = static_cast<std::size_t>(model.layout.nq());
    const Kernel& kernel = work.kernel;
    lanes::Array<typename Kernel::T> v(kernel.v(), kernel.v() + nq);
    if constexpr (kVerlet) velocities_now(work.kernel, steps, v.data());
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const int l = static_cast<int>(lane);
      EnsembleRun& r = out[lane];
      r.status =
          step_refusal(*models[lane], step).empty() ? kernel.status[l] : Status::kStepTooLarge;
      r.first_touch = work.totals.first_touch[l];
      r.contact_steps = static_cast<std::int64_t>(work.totals.contact_steps[l]);
      r.impacts = work.totals.impacts[l];
      r.impulse_total = work.totals.impulse_total[l];
      r.peak_impulse = work.totals.peak_impulse[l];
      for (std::size_t i = 0; i < nq; ++i) {
        r.q.push_back(kernel.q()[i][l]);
        r.v.push_back(v[i][l]);
      }
    }
  }

  std::vector<const Model*> models;
  M model;
  LaneWork<Kernel, W> work;
};

template <class Kernel, class M, int W>
void run_groups(const std::vector<Model>& models, double step, std::int64_t steps,
                std::vector<EnsembleRun>& out) {
  constexpr std::size_t kWidth = W;
  for (std::size_t begin = 0; begin < models.size(); begin += kWidth) {
    // The last group is filled up with copies of its first run.
    std::vector<const Model*> runs(kWidth);
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      runs[lane] = &models[begin + lane < models.size() ? begin + lane : begin];
    }
    LaneGroup<Kernel, M, W> group(std::move(runs), step);
    if (models.front().controller) {
      LaneCommands<Kernel> commands(group.models, step);
      for (std::int64_t k = 0; k < steps; ++k) {
        commands.tell(group.work.kernel, k);
        advance(group.work, step, k, 1);
      }
    } else {
      advance(group.work, step, 0, steps);
    }
    group.report(step, steps, {&out[begin], std::min(kWidth, models.size() - begin)});
  }
}

template <class M, int W>
void run_sized(const std::vector<Model>& models, double step, scene::Integrator integrator,
               std::int64_t steps, std::vector<EnsembleRun>& out) {
  if (integrator == scene::Integrator::kVerlet) {
    run_groups<VerletKernel<M>, M, W>(models, step, steps, out);
  } else {
    run_groups<PaperKernel<M>, M, W>(models, step, steps, out);
  }
}

template <int W>
void run_all(const std::vector<Model>& models, double step, scene::Integrator integrator,
             std::int64_t steps, std::vector<EnsembleRun>& out) {
  if (models.empty()) return;
#define ROTORUB_SIZE(L, unused)            \
  if (L::fits(models.front().layout)) {    \
    return run_sized<Sized<Lanes<W>, L>, W>(models, step, integrator, steps, out); \
  }
  ROTORUB_SMALL_LAYOUTS(ROTORUB_SIZE, )
#undef ROTORUB_SIZE
  run_sized<Lanes<W>, W>(models, step, integrator, steps, out);
}

}  // namespace

InstructionSet best_instruction_set() {
#if defined(ROTORUB_EACH_TARGET)
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::kAvx512;
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
}

double EnsembleRun::contact_fraction(double end, double step) const {
  if (first_touch < 0.0 || end <= first_touch) return 0.0;
  return std::min(1.0, static_cast<double>(contact_steps) * step / (end - first_touch));
}

double EnsembleRun::mean_force(double end) const {
  return first_touch < 0.0 || end <= first_touch ? 0.0 : impulse_total / (end - first_touch);
}

Ensemble::Ensemble(std::vector<Model> models, double step, scene::Integrator integrator,
                   InstructionSet set)
    : models_(std::move(models)), step_(step), integrator_(integrator), set_(set) {
  assert(integrator == scene::Integrator::kPaper || integrator == scene::Integrator::kVerlet);
  assert(set <= best_instruction_set());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (!same_structure(models_.front(), models_[i])) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has other parts than run 0");
    }
    const auto& c = models_[i].contact;
    const bool sampled = models_[i].controller && models_[i].sample_time > 0.0;
    if ((integrator == scene::Integrator::kPaper || sampled) && c &&
        c->compression_time + c->expansion_time > 0.0) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has impacts that take time, which need the "
                                  "integrator event, or verlet without a sampled controller");
    }
  }
}

std::vector<EnsembleRun> Ensemble::run(std::int64_t steps) {
  std::vector<EnsembleRun> out(models_.size());
  switch (set_) {
#if defined(ROTORUB_EACH_TARGET)
    case InstructionSet::kAvx512:
      run_all<8>(models_, step_, integrator_, steps, out);
      break;
    case InstructionSet::kAvx2:
      run_all<4>(models_, step_, integrator_, steps, out);
      break;
#endif
    default: run_all<2>(models_, step_, integrator_, steps, out);
  }
  return out;
}

}  // namespace rotorub
