#include "native_model/stepping/ensemble.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
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
      Eigen::Vector2d u = hold.held();
      if constexpr (!kLate) {
        u = hold.at(t, q, v);
      } else if (hold.listens(end)) {
        u = hold.mean(k == 0 ? t : t - 0.5 * step_, t, end, q, v, a);
        kernel.jump(lane, hold.jump());
      }
      lanes::set(kernel.command_x, lane, u.x());
      lanes::set(kernel.command_y, lane, u.y());
      if (!hold.failure().empty()) kernel.fail(lane, Status::kControllerFailed);
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
  using T = typename Kernel::T;

  LaneGroup(std::vector<const Model*> runs, double h)
      : models(std::move(runs)),
        model(Lanes<W>(models)),
        work{Kernel(model, models, h), {}},
        step(h),
        v(static_cast<std::size_t>(model.layout.nq()), T{}) {
    work.kernel.load_initial_states();
    if constexpr (kVerlet) work.kernel.restart();
    if (models.front()->first().controller) commands.emplace(models, step);
  }

  void advance_to(std::int64_t from, std::int64_t to, const EnsembleWatch& watch) {
    constexpr std::int64_t kPatience = 4096;  // steps between looks at the interrupt
    while (from < to && !watch.stopped()) {
      const std::int64_t count = commands ? 1 : std::min(kPatience, to - from);
      if (commands) commands->tell(work.kernel, from);
      advance(work, step, from, count);
      from += count;
    }
  }

  void find_velocities(std::int64_t k) {
    std::copy_n(work.kernel.v(), v.size(), v.begin());
    if constexpr (kVerlet) velocities_now(work.kernel, k, v.data());
  }

  bool impact(int lane) const {
    return work.kernel.any_impact() && work.kernel.impacts[lane].count > 0;
  }

  // Of the first `wanted` runs, which are `first`, ... of all.
  void look(std::int64_t k, const EnsembleWatch& watch, std::size_t first, std::size_t wanted) {
    find_velocities(k);
    double q_of[kMaxCoordinates], v_of[kMaxCoordinates];
    for (std::size_t lane = 0; lane < wanted; ++lane) {
      const int l = static_cast<int>(lane);
      for (std::size_t i = 0; i < v.size(); ++i) {
        q_of[i] = work.kernel.q()[i][l];
        v_of[i] = v[i][l];
      }
      double force = k > 0 && !impact(l) ? work.kernel.normal_impulse[l] / step : 0.0;
      if constexpr (kVerlet) force += work.kernel.impact_force(l, k).x();
      watch.look({first + lane, k, q_of, v_of, force, work.totals.impacts[l]});
    }
  }

  void report(std::int64_t steps, const EnsembleWatch& watch, std::span<EnsembleRun> out) {
    const Kernel& kernel = work.kernel;
    find_velocities(steps);
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const int l = static_cast<int>(lane);
      EnsembleRun& r = out[lane];
      r.status =
          step_refusal(*models[lane], step).empty() ? kernel.status[l] : Status::kStepTooLarge;
      if (watch.stopped()) r.status = Status::kInterrupted;
      r.first_touch = work.totals.first_touch[l];
      r.contact_steps = work.totals.contact_steps[l];
      r.impacts = work.totals.impacts[l];
      r.impulse_total = work.totals.impulse_total[l];
      r.peak_impulse = work.totals.peak_impulse[l];
      r.peak_impact = work.totals.peak_impact[l];
      r.friction_work = work.totals.friction_work[l];
      if (models[lane]->first().contact) {
        const double depth =
            std::sqrt(work.totals.farthest[l]) - models[lane]->first().contact->clearance;
        r.max_penetration = std::max(0.0, depth);
      }
      for (std::size_t i = 0; i < v.size(); ++i) {
        r.q.push_back(kernel.q()[i][l]);
        r.v.push_back(v[i][l]);
      }
    }
    if (kVerlet && !watch.stopped()) count_half_step(steps, out);
  }

  // The steps of `verlet` lie about the t_k: of the one about the end half counts, as in
  // run/fixed_run.cc.
  void count_half_step(std::int64_t steps, std::span<EnsembleRun> out) {
    work.totals = {};
    if (commands) commands->tell(work.kernel, steps);
    advance(work, step, steps, 1);
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const int l = static_cast<int>(lane);
      if (impact(l) || !(work.totals.contact_steps[l] > 0.0)) continue;
      out[lane].ends_in_contact = true;
      out[lane].impulse_total += 0.5 * work.totals.impulse_total[l];
      out[lane].friction_work += 0.5 * work.totals.friction_work[l];
      out[lane].peak_impulse = std::max(out[lane].peak_impulse, work.totals.peak_impulse[l]);
    }
  }

  std::vector<const Model*> models;
  M model;
  LaneWork<Kernel, W> work;
  double step;
  lanes::Array<T> v;
  std::optional<LaneCommands<Kernel>> commands;
};

template <class Kernel, class M, int W>
void run_groups(const std::vector<Model>& models, double step, std::int64_t steps,
                const EnsembleWatch& watch, std::vector<EnsembleRun>& out) {
  constexpr std::size_t kWidth = W;
  for (std::size_t begin = 0; begin < models.size(); begin += kWidth) {
    // The last group is filled up with copies of its first run.
    std::vector<const Model*> runs(kWidth);
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      runs[lane] = &models[begin + lane < models.size() ? begin + lane : begin];
    }
    const std::size_t wanted = std::min(kWidth, models.size() - begin);
    LaneGroup<Kernel, M, W> group(std::move(runs), step);
    std::int64_t k = 0;
    for (const std::int64_t at : watch.steps) {
      group.advance_to(k, at, watch);
      if (watch.stopped()) break;
      k = at;
      group.look(k, watch, begin, wanted);
    }
    group.advance_to(k, steps, watch);
    group.report(steps, watch, {&out[begin], wanted});
  }
}

template <class M, int W>
void run_sized(const std::vector<Model>& models, double step, scene::Integrator integrator,
               std::int64_t steps, const EnsembleWatch& watch, std::vector<EnsembleRun>& out) {
  if (integrator == scene::Integrator::kVerlet) {
    run_groups<VerletKernel<M>, M, W>(models, step, steps, watch, out);
  } else {
    run_groups<MidpointKernel<M>, M, W>(models, step, steps, watch, out);
  }
}

template <int W>
void run_all(const std::vector<Model>& models, double step, scene::Integrator integrator,
             std::int64_t steps, const EnsembleWatch& watch, std::vector<EnsembleRun>& out) {
  if (models.empty()) return;
#define ROTORUB_SIZE(L, unused)                                                           \
  if (L::fits(models.front().layout)) {                                                   \
    return run_sized<Sized<Lanes<W>, L>, W>(models, step, integrator, steps, watch, out); \
  }
  ROTORUB_SMALL_LAYOUTS(ROTORUB_SIZE, )
#undef ROTORUB_SIZE
  run_sized<Lanes<W>, W>(models, step, integrator, steps, watch, out);
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
  const double in_contact = contact_steps + (ends_in_contact ? 0.5 : 0.0);
  return std::min(1.0, in_contact * step / (end - first_touch));
}

double EnsembleRun::mean_force(double end) const {
  return first_touch < 0.0 || end <= first_touch ? 0.0 : impulse_total / (end - first_touch);
}

Ensemble::Ensemble(std::vector<Model> models, double step, scene::Integrator integrator,
                   InstructionSet set)
    : models_(std::move(models)), step_(step), integrator_(integrator), set_(set) {
  assert(integrator == scene::Integrator::kMidpoint || integrator == scene::Integrator::kVerlet);
  assert(set <= best_instruction_set());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (!same_structure(models_.front(), models_[i])) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has other parts than run 0");
    }
    if (models_[i].auxiliary.size() > 1) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has several contacts; run it by itself");
    }
    const auto& c = models_[i].first().contact;
    const bool sampled = models_[i].first().controller && models_[i].first().sample_time > 0.0;
    if ((integrator == scene::Integrator::kMidpoint || sampled) && c && c->impact_time() > 0.0) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has impacts that take time, which need the "
                                  "integrator event, or verlet without a sampled controller");
    }
  }
}

std::vector<EnsembleRun> Ensemble::run(std::int64_t steps, const EnsembleWatch& watch) {
  std::vector<EnsembleRun> out(models_.size());
  switch (set_) {
#if defined(ROTORUB_EACH_TARGET)
    case InstructionSet::kAvx512:
      run_all<8>(models_, step_, integrator_, steps, watch, out);
      break;
    case InstructionSet::kAvx2:
      run_all<4>(models_, step_, integrator_, steps, watch, out);
      break;
#endif
    default:
      run_all<2>(models_, step_, integrator_, steps, watch, out);
  }
  return out;
}

}  // namespace rotorub
