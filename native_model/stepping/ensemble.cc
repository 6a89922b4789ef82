#include "native_model/stepping/ensemble.h"

#include <algorithm>
#include <cassert>
#include <optional>
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

// The runs of one group of lanes: the first `wanted` of them, which are runs `first`, ... of all.
template <class Kernel, int W>
void run_group(const std::vector<const Model*>& group, double step, std::int64_t steps,
               const EnsembleWatch& watch, std::size_t first, EnsembleRun* out,
               std::size_t wanted) {
  using T = lanes::Lane<W>;
  const LaneModel<T> model(group);
  Kernel kernel(model, group, step);
  kernel.load_initial_states();
  constexpr bool kVerlet = std::is_same_v<Kernel, VerletLanes<W>>;
  if constexpr (kVerlet) kernel.restart();
  LaneTotals<W> totals;
  std::optional<LaneCommands<Kernel>> commands;
  if (group.front()->controller) commands.emplace(group, step);
  const auto stopped = [&] {
    return watch.interrupt && watch.interrupt->load(std::memory_order_relaxed);
  };
  const auto advance_to = [&](std::int64_t from, std::int64_t to) {
    constexpr std::int64_t kPatience = 4096;  // steps between looks at the interrupt
    while (from < to && !stopped()) {
      const std::int64_t count = commands ? 1 : std::min(kPatience, to - from);
      if (commands) commands->tell(kernel, from);
      advance(kernel, totals, step, from, count);
      from += count;
    }
  };

  const auto nq = static_cast<std::size_t>(model.layout.nq());
  lanes::Array<T> v(nq, T{});
  const auto velocities = [&](std::int64_t k) {
    std::copy_n(kernel.v(), nq, v.begin());
    if constexpr (kVerlet) velocities_now(kernel, k, v.data());
  };
  const auto look = [&](std::int64_t k) {
    velocities(k);
    double q_of[kMaxCoordinates], v_of[kMaxCoordinates];
    for (std::size_t lane = 0; lane < wanted; ++lane) {
      const int l = static_cast<int>(lane);
      for (std::size_t i = 0; i < nq; ++i) {
        q_of[i] = kernel.q()[i][l];
        v_of[i] = v[i][l];
      }
      const bool lasting = k > 0 && !(kernel.any_impact() && kernel.impacts[l].count > 0);
      watch.look({first + lane, k, q_of, v_of, lasting ? kernel.normal_impulse[l] / step : 0.0,
                  totals.impacts[l]});
    }
  };
  std::int64_t k = 0;
  for (const std::int64_t at : watch.steps) {
    advance_to(k, at);
    if (stopped()) break;
    k = at;
    look(k);
  }
  advance_to(k, steps);
  velocities(steps);
  // The steps of `verlet` lie about the t_k: of the one about the end half counts, as in
  // run/fixed_run.cc.
  lanes::Array<T> q(kernel.q(), kernel.q() + nq);
  int status[W];
  for (int lane = 0; lane < W; ++lane) status[lane] = static_cast<int>(kernel.status[lane]);
  LaneTotals<W> about_end;
  if (kVerlet && !stopped()) {
    if (commands) commands->tell(kernel, steps);
    advance(kernel, about_end, step, steps, 1);
  }
  for (std::size_t lane = 0; lane < wanted; ++lane) {
    const int l = static_cast<int>(lane);
    EnsembleRun& r = out[lane];
    r.status = step_refusal(*group[lane], step).empty() ? static_cast<Status>(status[l])
                                                        : Status::kStepTooLarge;
    if (stopped()) r.status = Status::kInterrupted;
    r.first_touch = totals.first_touch[l];
    r.contact_steps = static_cast<std::int64_t>(totals.contact_steps[l]);
    r.impacts = totals.impacts[l];
    r.impulse_total = totals.impulse_total[l];
    r.peak_impulse = totals.peak_impulse[l];
    const bool impact = kernel.any_impact() && kernel.impacts[l].count > 0;
    if (kVerlet && about_end.contact_steps[l] > 0.0 && !impact) {
      r.ends_in_contact = true;
      r.impulse_total += 0.5 * about_end.impulse_total[l];
      r.peak_impulse = std::max(r.peak_impulse, about_end.peak_impulse[l]);
    }
    for (std::size_t i = 0; i < nq; ++i) {
      r.q.push_back(q[i][l]);
      r.v.push_back(v[i][l]);
    }
  }
}

template <int W>
void run_all(const std::vector<Model>& models, double step, scene::Integrator integrator,
             std::int64_t steps, const EnsembleWatch& watch, std::vector<EnsembleRun>& out) {
  constexpr std::size_t kWidth = W;
  for (std::size_t begin = 0; begin < models.size(); begin += kWidth) {
    // The last group is filled up with copies of its first run.
    std::vector<const Model*> group(kWidth);
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      group[lane] = &models[begin + lane < models.size() ? begin + lane : begin];
    }
    const std::size_t wanted = std::min(kWidth, models.size() - begin);
    if (integrator == scene::Integrator::kVerlet) {
      run_group<VerletLanes<W>, W>(group, step, steps, watch, begin, &out[begin], wanted);
    } else {
      run_group<PaperLanes<W>, W>(group, step, steps, watch, begin, &out[begin], wanted);
    }
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
  const double in_contact = static_cast<double>(contact_steps) + (ends_in_contact ? 0.5 : 0.0);
  return std::min(1.0, in_contact * step / (end - first_touch));
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
    if (c && c->compression_time + c->expansion_time > 0.0) {
      throw std::invalid_argument("run " + std::to_string(i) +
                                  " of the ensemble has impacts that take time, which need the "
                                  "integrator event");
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
    default: run_all<2>(models_, step_, integrator_, steps, watch, out);
  }
  return out;
}

}  // namespace rotorub
