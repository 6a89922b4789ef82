#include "native_model/stepping/ensemble.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "native_model/stepping/lane_steps.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/zero_order_hold.h"

namespace rotorub {
namespace {

// The runs of one group of lanes.
template <int W>
class LaneGroup {
 public:
  using M = Lanes<W>;
  using Step = VerletStep<M>;
  using T = typename Step::T;

  LaneGroup(std::vector<const Model*> runs, double h)
      : models_(std::move(runs)),
        model_(models_),
        work_{Step(model_, models_, h), {}},
        h_(h),
        v_(static_cast<std::size_t>(model_.layout.nq()), T{}) {
    work_.step.x.load_initial_states();
    work_.step.restart();
    if (!models_.front()->first().controller) return;
    for (const Model* m : models_) holds_.emplace_back(*m);
  }

  void advance_to(std::int64_t from, std::int64_t to, const EnsembleWatch& watch) {
    constexpr std::int64_t kPatience = 4096;  // steps between looks at the interrupt
    while (from < to && !watch.stopped()) {
      const std::int64_t count = holds_.empty() ? std::min(kPatience, to - from) : 1;
      command(from);
      advance(work_, from, count);
      from += count;
    }
  }

  // Of the first `wanted` runs, which are `first`, ... of all.
  void look(std::int64_t k, const EnsembleWatch& watch, std::size_t first, std::size_t wanted) {
    find_velocities(k);
    double q[kMaxCoordinates], v[kMaxCoordinates];
    for (std::size_t lane = 0; lane < wanted; ++lane) {
      const int l = static_cast<int>(lane);
      for (std::size_t i = 0; i < v_.size(); ++i) {
        q[i] = work_.step.x.q[i][l];
        v[i] = v_[i][l];
      }
      double force = k > 0 && !hit(lane) ? work_.step.contact.normal_impulse()[l] / h_ : 0.0;
      force += work_.step.impact_force(l, k).x();
      watch.look({first + lane, k, q, v, force, work_.totals.impacts[l]});
    }
  }

  void report(std::int64_t steps, const EnsembleWatch& watch, std::span<EnsembleRun> out) {
    find_velocities(steps);
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const int l = static_cast<int>(lane);
      const Model& m = *models_[lane];
      const LaneTotals<W>& totals = work_.totals;
      EnsembleRun& r = out[lane];
      r.status = step_refusal(m, h_).empty() ? work_.step.x.status[l] : Status::kStepTooLarge;
      if (watch.stopped()) r.status = Status::kInterrupted;
      r.first_touch = totals.first_touch[l];
      r.contact_steps = totals.contact_steps[l];
      r.impacts = totals.impacts[l];
      r.impulse_total = totals.impulse_total[l];
      r.peak_impulse = totals.peak_impulse[l];
      r.peak_impact = totals.peak_impact[l];
      r.friction_work = totals.friction_work[l];
      if (m.first().contact) {
        const double depth = std::sqrt(totals.farthest[l]) - m.first().contact->clearance;
        r.max_penetration = std::max(0.0, depth);
      }
      for (std::size_t i = 0; i < v_.size(); ++i) {
        r.q.push_back(work_.step.x.q[i][l]);
        r.v.push_back(v_[i][l]);
      }
    }
    if (!watch.stopped()) count_half_step(steps, out);
  }

 private:
  bool hit(std::size_t lane) const {
    return work_.step.contact.impacted && work_.step.contact.impacts[lane].count > 0;
  }

  void find_velocities(std::int64_t k) {
    std::copy_n(work_.step.x.v.begin(), v_.size(), v_.begin());
    velocities_now(work_.step, k, v_.data());
  }

  // The commands of step k, by the controller of each run, which sees its own run only.
  void command(std::int64_t k) {
    if (holds_.empty()) return;
    const double t = static_cast<double>(k) * h_, end = t + 0.5 * h_;
    StepState<M>& x = work_.step.x;
    auto& asked = work_.step.loads.command[0];
    const auto listens = [end](const ZeroOrderHold& hold) { return hold.listens(end); };
    const auto tell = [&](std::size_t lane, const Eigen::Vector2d& u) {
      lanes::set(asked.x, static_cast<int>(lane), u.x());
      lanes::set(asked.y, static_cast<int>(lane), u.y());
    };
    for (std::size_t lane = 0; lane < W; ++lane) tell(lane, holds_[lane].held());
    if (std::none_of(holds_.begin(), holds_.end(), listens)) return;
    find_velocities(k);
    double q[kMaxCoordinates], v[kMaxCoordinates], a[kMaxCoordinates];
    for (std::size_t lane = 0; lane < W; ++lane) {
      const int l = static_cast<int>(lane);
      ZeroOrderHold& hold = holds_[lane];
      for (std::size_t i = 0; i < v_.size(); ++i) {
        q[i] = x.q[i][l];
        v[i] = v_[i][l];
        a[i] = k == 0 ? 0.0 : 2.0 / h_ * (v[i] - x.v[i][l]);
      }
      if (hold.listens(end)) {
        tell(lane, hold.mean(k == 0 ? t : t - 0.5 * h_, t, end, q, v, a));
        work_.step.jump(lane, hold.jump());
      }
      if (!hold.failure().empty()) x.fail(l, Status::kControllerFailed);
    }
  }

  // The steps lie about the t_k: of the one about the end half counts, as in run/fixed_run.cc.
  void count_half_step(std::int64_t steps, std::span<EnsembleRun> out) {
    work_.totals = {};
    command(steps);
    advance(work_, steps, 1);
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const int l = static_cast<int>(lane);
      if (hit(lane) || !(work_.totals.contact_steps[l] > 0.0)) continue;
      out[lane].ends_in_contact = true;
      out[lane].impulse_total += 0.5 * work_.totals.impulse_total[l];
      out[lane].friction_work += 0.5 * work_.totals.friction_work[l];
      out[lane].peak_impulse = std::max(out[lane].peak_impulse, work_.totals.peak_impulse[l]);
    }
  }

  std::vector<const Model*> models_;
  M model_;
  LaneWork<W> work_;
  double h_;
  lanes::Array<T> v_;
  std::vector<ZeroOrderHold> holds_;  // of each lane, where there are controllers
};

template <int W>
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
    LaneGroup<W> group(std::move(runs), step);
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

Ensemble::Ensemble(std::vector<Model> models, double step, InstructionSet set)
    : models_(std::move(models)), step_(step), set_(set) {
  assert(set <= best_instruction_set());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (!same_structure(models_.front(), models_[i])) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has other parts than run 0");
    }
    if (std::ranges::any_of(models_[i].samplers,
                            [](const SampledFeedback& s) { return s.library != nullptr; })) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has magnetic bearings under a library, whose "
                                  "failure would end all; run it by itself");
    }
    if (models_[i].auxiliary.size() > 1 || models_[i].gives() || !models_[i].supports.empty()) {
      throw std::invalid_argument(
          "run " + std::to_string(i) +
          " of the ensemble has several contacts, one that gives, or a ring on more than a spring "
          "and a damper; run it by itself");
    }
    const auto& c = models_[i].first().contact;
    const bool sampled = !models_[i].samplers.empty() ||
                         (models_[i].first().controller && models_[i].first().sample_time > 0.0);
    if (sampled && c && c->impact_time() > 0.0) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has impacts that take time, which need the "
                                  "integrator event where a controller is sampled");
    }
  }
}

std::vector<EnsembleRun> Ensemble::run(std::int64_t steps, const EnsembleWatch& watch) {
  std::vector<EnsembleRun> out(models_.size());
  if (models_.empty()) return out;
  switch (set_) {
#if defined(ROTORUB_EACH_TARGET)
    case InstructionSet::kAvx512:
      run_groups<8>(models_, step_, steps, watch, out);
      break;
    case InstructionSet::kAvx2:
      run_groups<4>(models_, step_, steps, watch, out);
      break;
#endif
    default:
      run_groups<2>(models_, step_, steps, watch, out);
  }
  return out;
}

}  // namespace rotorub
