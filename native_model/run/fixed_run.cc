#include "native_model/run/fixed_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/dynamics/dynamics.h"
#include "native_model/run/status_reason.h"
#include "native_model/stepping/euler.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"
#include "native_model/system/actuation.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

// Where a command given again jumps first in begin..end, s.
CommandJump jump_of(const CommandRecord& told, double begin, double end) {
  const std::vector<double>& jumps = told.jumps();
  const auto next = std::upper_bound(jumps.begin(), jumps.end(), begin);
  if (next == jumps.end() || *next >= end) return {};
  return {(*next - begin) / (end - begin), told.mean(begin, *next), told.mean(*next, end)};
}

// A state that a run has come to, and its contact.
struct Reached {
  Reached(const Model& model, double time, const double* at, const double* rates)
      : t(time), q(at), v(rates) {
    if (model.first().contact) point = contact_point(model, q, v);
  }
  double t;  // s
  const double *q, *v;
  ContactPoint point;
};

// What every fixed-step run keeps beside its stepper.
class FixedRun {
 public:
  FixedRun(const Model& model, const scene::Run& run, double step, const NativeOptions& options)
      : model_(model),
        options_(options),
        step_(step),
        end_(run.end),
        recorder_(model, options.output_times.value_or(output_times(run)), kWindowSteps * run.step),
        message_(step_refusal(model, step)) {
    if (!message_.empty()) status_ = Status::kStepTooLarge;
  }

  std::int64_t steps() const { return static_cast<std::int64_t>(std::ceil(end_ / step_ - 1e-9)); }
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }
  bool good() const { return status_ == Status::kOk; }

  // command: of `hold`, or recorded.
  void begin(const Eigen::Vector2d& command, const ZeroOrderHold& hold) {
    begin(command, hold, {}, 1.0);
  }
  void begin(const Eigen::Vector2d& command, const ZeroOrderHold& hold, const FixedStep& done,
             double kick) {
    Snapshot s = snapshot(0.0, model_.q0.data(), model_.v0.data(), done, kick);
    s.actuator = actuator_state(model_, s.q, s.v, command);
    s.actuator.outputs = hold.outputs();
    recorder_.begin(s);
    record_mode(0.0, done);
  }

  // What `done` did, from `begin` on, with the slip of `state`; `share`: of what it did.
  void count(const FixedStep& done, double begin, const Reached& state, double share) {
    StepFigures f;
    f.h = done.impact_time > 0.0 ? done.impact_time : share * step_;
    f.impact = !done.impacts.empty();
    f.normal_impulse = share * done.normal_impulse;
    f.friction_impulse = share * done.friction_impulse;
    f.contact_work = share * done.contact_work;
    f.external_work = share * done.external_work;
    if (done.normal_impulse > 0.0) f.friction_work = share * friction_work(done, state);
    recorder_.count(f, begin);
  }

  // The next state, with the forces of `done`, impulses over `kick` (s); `impact`: one since the
  // last.
  void advance(const Reached& state, const FixedStep& done, double kick, bool impact,
               const Eigen::Vector2d& u, const ZeroOrderHold& hold) {
    record_mode(state.t, done);
    Snapshot s = snapshot(state.t, state.q, state.v, done, kick);
    if (recorder_.row_due(state.t)) {
      s.actuator = actuator_state(model_, state.q, state.v, u);
      s.actuator.outputs = hold.outputs();
    }
    recorder_.advance(s, state.point, impact);
    if (recorder_.penetration() == 0.0 && !model_.first().magnets) return;
    if (const auto why = out_of_range(model_, state.q)) fail(Status::kOutOfRange, state.t, *why);
  }

  void add_impacts(const FixedStep& done) {
    for (const Impact& impact : done.impacts) {
      recorder_.add(impact);
      recorder_.add(Event{impact.t, EventKind::kImpact});
    }
  }

  void fail(Status status, double now) { fail(status, now, status_reason(status)); }
  // The law's word names the time.
  void listen(const ZeroOrderHold& hold) {
    if (hold.failure().empty() || status_ != Status::kOk) return;
    status_ = Status::kControllerFailed;
    message_ = hold.failure();
  }
  void fail(Status status, double now, const std::string& why) {
    if (status_ != Status::kOk) return;
    status_ = status;
    message_ = why + " at t = " + std::to_string(now) + " s";
  }
  void tick(std::int64_t k) {
    if ((k & 0xfff) != 0) return;
    if (options_.interrupt && options_.interrupt->load(std::memory_order_relaxed)) {
      fail(Status::kInterrupted, time(k));
    }
    if (options_.progress) options_.progress(static_cast<double>(k) / static_cast<double>(steps()));
  }

  Trajectory finish(const char* integrator, std::int64_t taken, double reached, double wall) {
    Trajectory out = recorder_.finish(good() ? end_ : reached);
    out.engine = "native";
    out.integrator = integrator;
    out.contact_model = "rigid";
    out.step = step_;
    out.steps = taken;
    out.wall_s = wall;
    out.status = status_;
    out.message = message_;
    return out;
  }

 private:
  // An impact's impulse is no force of lasting contact.
  static Snapshot snapshot(double t, const double* q, const double* v, const FixedStep& done,
                           double kick) {
    const double scale = done.impacts.empty() ? 1.0 / kick : 0.0;
    return {{scale * done.normal_impulse + done.impact_force.x(),
             scale * done.friction_impulse + done.impact_force.y(),
             done.mode,
             {}},
            t,
            q,
            v};
  }

  static double friction_work(const FixedStep& done, const Reached& state) {
    if (done.impacts.empty()) return done.friction_impulse * state.point.slip;
    double work = 0.0;
    for (const Impact& hit : done.impacts) {
      work += 0.5 * hit.friction_impulse * (hit.slip_before + hit.slip_after);
    }
    return work;
  }

  void record_mode(double now, const FixedStep& done) {
    if (done.reversed) recorder_.add(Event{now, EventKind::kReverse});
    if (done.mode == mode_) return;
    mode_ = done.mode;
    recorder_.add(Event{now, mode_event(mode_)});
  }

  const Model& model_;
  const NativeOptions& options_;
  double step_, end_;
  Recorder recorder_;
  std::string message_;
  Status status_ = Status::kOk;
  Mode mode_ = Mode::kFree;
};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

namespace {

// Steps whose state is that of their end.
template <class Stepper>
Trajectory run_steps(const char* name, const Model& model, const scene::Run& scene_run, double step,
                     const NativeOptions& options) {
  FixedRun run(model, scene_run, step, options);
  Stepper stepper(model, step);
  ZeroOrderHold hold(model);
  const CommandRecord* recorded = model.first().recorded.get();
  const auto command = [&](std::int64_t k) -> Eigen::Vector2d {
    const double t = run.time(k);
    if (recorded) return recorded->mean(t, run.time(k + 1));
    return hold.at(t, stepper.q(), stepper.v());
  };
  run.begin(command(0), hold);
  run.listen(hold);
  const std::int64_t steps = run.steps();
  const auto start = Clock::now();
  std::int64_t k = 0;
  for (; k < steps && run.good(); ++k) {
    const Eigen::Vector2d u = command(k);
    run.listen(hold);
    if (!run.good()) break;
    const FixedStep done = stepper.step(k, u, true);
    if (done.status != Status::kOk) {
      run.fail(done.status, run.time(k));
      break;
    }
    run.add_impacts(done);
    const Reached state(model, run.time(k + 1), stepper.q(), stepper.v());
    run.count(done, run.time(k), state, 1.0);
    run.advance(state, done, step, !done.impacts.empty(), u, hold);
    run.tick(k);
  }
  return run.finish(name, k, run.time(k), seconds_since(start));
}

}  // namespace

Trajectory run_paper(const Model& model, const scene::Run& run, double step,
                     const NativeOptions& options) {
  return run_steps<MidpointStepper>("midpoint", model, run, step, options);
}

Trajectory run_literal(const Model& model, const scene::Run& run, double step,
                       const NativeOptions& options) {
  return run_steps<EulerStepper>("euler", model, run, step, options);
}

// The state of t_k is known once step k is taken: the recorder is a step behind, and impacts of
// step k belong to the next state. A last step beyond the end tells the velocities there; half of
// what its loads did about the end counts.
Trajectory run_verlet(const Model& model, const scene::Run& scene_run, double step,
                      const NativeOptions& options) {
  FixedRun run(model, scene_run, step, options);
  VerletStepper stepper(model, step);
  ZeroOrderHold hold(model);
  const auto nq = static_cast<std::size_t>(model.nq());
  std::vector<double> v(nq), a(nq, 0.0);
  const auto command = [&](std::int64_t k) -> Eigen::Vector2d {
    const double t = run.time(k), end = t + 0.5 * step;
    const double begin = k == 0 ? t : t - 0.5 * step;
    if (model.first().recorded) {
      stepper.jump(jump_of(*model.first().recorded, begin, end));
      return model.first().recorded->mean(begin, end);
    }
    if (!hold.listens(end)) return hold.held();
    stepper.velocity_now(k, hold.held(), v.data());
    for (std::size_t i = 0; k > 0 && i < nq; ++i) a[i] = 2.0 / step * (v[i] - stepper.v_half()[i]);
    const Eigen::Vector2d mean = hold.mean(begin, t, end, stepper.q(), v.data(), a.data());
    stepper.jump(hold.jump());
    return mean;
  };
  const std::int64_t steps = run.steps();
  const auto start = Clock::now();
  FixedStep hits;   // the last step, where it had impacts
  ImpactList kept;  // its impacts
  std::int64_t k = 0;
  for (; k <= steps && run.good(); ++k) {
    const double t = run.time(k);
    const Eigen::Vector2d u = command(k), held = model.first().recorded ? u : hold.held();
    run.listen(hold);
    if (!run.good()) {
      if (k == 0) run.begin(held, hold);
      break;
    }
    FixedStep done = stepper.step(k, u, true);
    if (done.status != Status::kOk) {
      run.fail(done.status, t);
      break;
    }
    stepper.last_velocity(v.data());
    const FixedStep all = done;
    if (!done.impacts.empty()) {
      done = FixedStep{};
      done.external_work = all.external_work;
      done.impact_force = all.impact_force;
    }
    const double kick = k == 0 ? 0.5 * step : step;
    if (k == 0) run.begin(held, hold, done, kick);
    // Of a step half is done before t_k, half after; all of the first, half one after.
    const Reached state(model, t, stepper.last_q(), v.data());
    const auto half = [&] { run.count(done, t, state, k == 0 ? 1.0 : 0.5); };
    if (k > 0) half();
    if (k > 0) {
      const bool impact = !hits.impacts.empty();
      if (impact) run.count(hits, hits.impacts.front().t, state, 1.0);
      run.advance(state, done, kick, impact, held, hold);
    }
    if (k < steps) half();
    hits = all;
    hits.external_work = 0.0;
    kept.count = 0;
    for (const Impact& hit : all.impacts) kept.add(hit);
    hits.impacts = kept.view();
    if (!all.impacts.empty() && k < steps) run.add_impacts(all);
    run.tick(k);
  }
  const std::int64_t taken = std::min(k, steps);
  return run.finish("verlet", taken, run.time(taken), seconds_since(start));
}

}  // namespace rotorub
