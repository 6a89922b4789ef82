#include "compare/engine/mujoco_engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "compare/engine/contact_episodes.h"
#include "compare/engine/engine.h"
#include "compare/engine/mujoco_messages.h"
#include "compare/engine/mujoco_model.h"
#include "mjcf/writer.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/model_checks.h"
#include "native_model/system/run_size.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"
#include "plugin/config.h"
#include "plugin/contact/forces.h"
#include "plugin/contact/verlet.h"
#include "plugin/control.h"
#include "plugin/coordinates.h"
#include "plugin/hooks.h"

namespace rotorub {
namespace {

// What a step left behind: the state at its end and the forces that acted over it.
struct StepResult {
  plugin::ContactForces forces;
  ActuatorState actuator;
};

// Steps in chunks, so that only mj_step and the copying of its results are timed.
class ChunkedRun {
 public:
  ChunkedRun(const mjModel* m, const plugin::Config& config)
      : m_(m), config_(config), data_(make_start(m)), results_(kChunk) {
    states_.resize(2 * kChunk * size());
    start_.resize(2 * size());
    read_state(start_.data());
  }

  static constexpr std::size_t kChunk = 256;

  // Up to `wanted` steps; the number that were good.
  std::size_t advance(std::size_t wanted) {
    const std::size_t count = std::min(wanted, kChunk);
    const auto start = std::chrono::steady_clock::now();
    std::size_t done = 0;
    for (; done < count && !failed_; ++done) {
      // Native steps: the state of the step's begin is known once it is taken.
      const bool native = config_.takes_native_steps();
      double* state = states_.data() + 2 * done * size();
      if (native) read_state(state);
      mj_step(m_, data_.get());
      failed_ = bad();
      if (failed_) break;
      StepResult& r = results_[done];
      r.forces = plugin::contact_forces(config_, data_.get());
      r.actuator = plugin::actuator_state(config_, m_, data_.get());
      if (r.forces.status != Status::kOk) {
        contact_status_ = r.forces.status;
        failed_ = true;
        break;
      }
      if (native) {
        std::copy_n(plugin::velocities_of_pass(config_, data_.get()), size(), state + size());
      } else {
        read_state(state);
      }
    }
    wall_ += std::chrono::steady_clock::now() - start;
    return done;
  }

  // Native steps: the forces and the state now, as of a step of which half is taken.
  StepResult last_half() {
    mj_forward(m_, data_.get());
    read_state(states_.data());
    std::copy_n(plugin::velocities_of_pass(config_, data_.get()), size(), states_.data() + size());
    return {plugin::contact_forces(config_, data_.get()),
            plugin::actuator_state(config_, m_, data_.get())};
  }

  const StepResult& result(std::size_t i) const { return results_[i]; }
  const double* q(std::size_t i) const { return states_.data() + 2 * i * size(); }
  const double* v(std::size_t i) const { return q(i) + size(); }
  const double* start_q() const { return start_.data(); }
  const double* start_v() const { return start_.data() + size(); }
  bool failed() const { return failed_; }
  // kNoSolution, kAmbiguous: what `rigid` failed by.
  Status contact_status() const { return contact_status_; }
  double wall() const { return wall_.count(); }

 private:
  std::size_t size() const { return config_.qpos_address.size(); }

  // Coordinates, then velocities, in the native layout.
  void read_state(double* to) const {
    const plugin::Coordinates state(config_, data_.get());
    std::copy_n(state.q(), size(), to);
    std::copy_n(state.v(), size(), to + size());
  }

  // MuJoCo resets a state that is not finite (or beyond 1e10) and warns.
  bool bad() const {
    const mjWarningStat* w = data_->warning;
    return (w[mjWARN_BADQPOS].number | w[mjWARN_BADQVEL].number | w[mjWARN_BADQACC].number) != 0;
  }

  const mjModel* m_;
  const plugin::Config& config_;
  MujocoData data_;
  std::vector<StepResult> results_;
  std::vector<double> states_, start_;
  bool failed_ = false;
  Status contact_status_ = Status::kOk;
  std::chrono::duration<double> wall_{0.0};
};

scene::Scene with_options(const scene::Scene& scene, const MujocoOptions& options) {
  if (scene.text.empty()) {
    throw std::invalid_argument("scene " + scene.name +
                                ": MuJoCo's plugin reads the scene's text, and it has none");
  }
  scene::Scene own = scene;
  own.mujoco.contact = options.contact.value_or(scene.mujoco.contact);
  own.run.step = options.step.value_or(scene.run.step);
  return own;
}

Impact impact_of(const plugin::ContactForces& f, double t, double h) {
  Impact i;
  i.t = t;
  i.normal_impulse = h * f.normal;
  i.friction_impulse = h * f.friction;
  i.gap_rate_before = f.gap_rate_before;
  i.gap_rate_after = f.gap_rate_after;
  i.slip_before = f.slip_before;
  i.slip_after = f.slip_after;
  i.energy_change = 0.5 * (i.normal_impulse * (f.gap_rate_before + f.gap_rate_after) +
                           i.friction_impulse * (f.slip_before + f.slip_after));
  return i;
}

const char* contact_reason(Status status) {
  return status == Status::kNoSolution ? "the contact laws have no solution (Painleve)"
                                       : "the contact laws have several solutions (Painleve)";
}

// Feeds the recorder.
class Record {
 public:
  Record(const Model& model, bool rigid, double step, std::vector<double> times)
      : model_(model),
        rigid_(rigid),
        step_(step),
        recorder_(model, std::move(times)),
        episodes_(recorder_) {}

  void begin(const double* q, const double* v) {
    // A coil that lags has no current yet, whatever it is told.
    const bool lags = model_.magnets && model_.magnets->coil_lag > 0.0;
    const Eigen::Vector2d acts = lags ? Eigen::Vector2d(0.0, 0.0)
                                      : control_command(model_, 0.0, q, v);
    recorder_.begin({0.0, q, v, 0.0, 0.0, Mode::kFree, actuator_state(model_, q, v, acts)});
    point_ = contact_point(model_, q, v);
  }

  // Step k (from 0), time counted as k step.
  void step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
    const double t = static_cast<double>(k) * step_;
    const ContactPoint after = contact_point(model_, q, v);
    const double next = static_cast<double>(k + 1) * step_;
    const plugin::ContactForces& f = r.forces;
    const Impact impact = f.impact ? impact_of(f, impact_time(t, f), step_) : Impact{};
    if (model_.contact && rigid_) note_rigid(next, f, impact);
    if (model_.contact && !rigid_) {
      episodes_.step({t, step_, point_, after, f.normal, f.friction, f.mode});
    }
    // An impact's impulse is no force of lasting contact.
    const double lasting = f.impact ? 0.0 : 1.0;
    recorder_.step({next, q, v, lasting * f.normal, lasting * f.friction, f.mode, r.actuator},
                   step_ * f.normal, step_ * f.friction, f.impact, f.impact ? &impact : nullptr);
    point_ = after;
  }

  // Step k of native steps: the state is that of t_k, and so are forces and works; what impacts do
  // comes after it. Of the last one, which begins at the end, half counts, and no impact.
  void native_step(std::int64_t k, const double* q, const double* v, const StepResult& r, bool last) {
    const double t = static_cast<double>(k) * step_;
    const plugin::ContactForces& f = r.forces;
    const bool lasting = !f.impact;
    const ContactPoint p = contact_point(model_, q, v);
    note_mode(t, f.mode);
    if (k > 0) {
      if (impact_.normal_impulse > 0.0) count_impact();
      recorder_.advance({t, q, v, lasting ? f.normal : 0.0, lasting ? f.friction : 0.0, f.mode,
                         r.actuator},
                        p, impact_.normal_impulse > 0.0);
    }
    StepFigures figures;
    figures.h = k == 0 || last ? 0.5 * step_ : step_;
    figures.external_work = figures.h * external_power(model_, t, q, v, r.actuator.force);
    if (lasting && f.mode != Mode::kFree && f.normal > 0.0) {
      figures.normal_impulse = figures.h * f.normal;
      figures.friction_impulse = figures.h * f.friction;
      figures.friction_work = figures.friction_impulse * p.slip;
      figures.contact_work =
          figures.normal_impulse * p.gap_rate + figures.friction_impulse * (p.slip - held());
    }
    recorder_.count(figures, t);
    impact_ = Impact{};
    if (f.impact && !last) {
      impact_ = impact_of(f, f.impact_time, k == 0 ? 0.5 * step_ : step_);
      recorder_.add(impact_);
      recorder_.add(Event{impact_.t, EventKind::kImpact});
    }
  }

  // Why the state is where nothing holds it, if it is.
  std::optional<std::string> lost(const double* q) const {
    if (recorder_.penetration() == 0.0 && !model_.magnets) return {};
    return out_of_range(model_, q);
  }

  Trajectory finish(double end) {
    if (!rigid_) episodes_.finish();
    return recorder_.finish(end);
  }

 private:
  // m/s: slip of a prescribed spin, at which the machine that holds it works, and not the coordinates.
  double held() const { return model_.layout.spin ? 0.0 : model_.contact->radius * model_.speed; }

  void count_impact() {
    StepFigures figures;
    const double lasted = model_.contact->compression_time + model_.contact->expansion_time;
    figures.h = lasted > 0.0 ? lasted : step_;
    figures.normal_impulse = impact_.normal_impulse;
    figures.friction_impulse = impact_.friction_impulse;
    figures.friction_work =
        0.5 * impact_.friction_impulse * (impact_.slip_before + impact_.slip_after);
    figures.contact_work = impact_.energy_change - impact_.friction_impulse * held();
    recorder_.count(figures, impact_.t);
  }

  void note_mode(double t, Mode mode) {
    if (mode == mode_) return;
    recorder_.add(Event{t, mode == Mode::kSlide   ? EventKind::kSlide
                           : mode == Mode::kStick ? EventKind::kStick
                                                  : EventKind::kLiftOff});
    mode_ = mode;
  }

  // As the native side: one row an impact. The velocity that jumps is that of half a step ago.
  void note_rigid(double next, const plugin::ContactForces& f, const Impact& impact) {
    if (f.impact) {
      recorder_.add(impact);
      recorder_.add(Event{impact.t, EventKind::kImpact});
    }
    note_mode(next, f.mode);
  }

  // When the gap at t closes at the rate before the impact, within the step.
  double impact_time(double t, const plugin::ContactForces& f) const {
    const double closing = point_.gap / std::max(-f.gap_rate_before, 1e-300);
    return t + std::clamp(closing, 0.0, step_);
  }

  const Model& model_;
  bool rigid_;
  double step_;
  Mode mode_ = Mode::kFree;
  Recorder recorder_;
  ContactEpisodes episodes_;
  ContactPoint point_;
  Impact impact_;  // of native steps: of the step before
};

}  // namespace

Trajectory run_mujoco(const scene::Scene& given, const MujocoOptions& options) {
  const scene::Scene scene = with_options(given, options);
  const bool lags = scene.actuator && scene.actuator->coil_lag > 0.0;
  const bool native =
      scene.mujoco.rotor == scene::MujocoRotor::kModal && !scene.mujoco.shadow && !lags;
  if (scene.mujoco.contact == scene::ContactModel::kRigid) {
    refuse_finite_impacts(scene, native ? FiniteImpacts::kUnsampled : FiniteImpacts::kNone);
  }
  const double step = scene.run.step;
  check_steps(scene, step);
  const MujocoMessages messages;
  const plugin::Hooks hooks;
  const MujocoModel m = load_mjcf(mjcf(scene));
  const plugin::Config config = plugin::make_config(m.get());
  const Model& model = config.model;
  check_run_size(scene, model, std::nullopt, options.output_times ? &*options.output_times : nullptr);

  ChunkedRun run(m.get(), config);
  Record record(model, config.contact == scene::ContactModel::kRigid, step,
                options.output_times.value_or(output_times(scene.run)));
  record.begin(run.start_q(), run.start_v());

  const auto steps = static_cast<std::int64_t>(std::ceil(scene.run.end / step - 1e-9));
  Status status = Status::kOk;
  std::string message = config.segments ? plugin::segment_step_refusal(*config.segments, step)
                                        : step_refusal(model, step);
  if (!message.empty()) status = Status::kStepTooLarge;
  std::int64_t k = 0;
  try {
    while (k < steps && status == Status::kOk) {
      const std::size_t good = run.advance(static_cast<std::size_t>(steps - k));
      for (std::size_t i = 0; i < good; ++i, ++k) {
        if (config.takes_native_steps()) {
          record.native_step(k, run.q(i), run.v(i), run.result(i), false);
          if (const auto why = record.lost(run.q(i))) {
            status = Status::kOutOfRange;
            message = *why;
            break;
          }
        } else {
          record.step(k, run.q(i), run.v(i), run.result(i));
        }
      }
      if (status != Status::kOk) break;
      if (run.contact_status() != Status::kOk) {
        status = run.contact_status();
        message = contact_reason(status);
      } else if (run.failed()) {
        status = Status::kDiverged;
        const std::vector<std::string> warnings = messages.warnings();
        message = warnings.empty() ? "the state is no longer finite" : warnings.back();
      } else if (options.interrupt && options.interrupt->load(std::memory_order_relaxed)) {
        status = Status::kInterrupted;
        message = "interrupted";
      }
      if (options.progress) options.progress(static_cast<double>(k) / static_cast<double>(steps));
    }
    if (status == Status::kOk && config.takes_native_steps()) {
      const StepResult last = run.last_half();
      record.native_step(k, run.q(0), run.v(0), last, true);
    }
  } catch (const MujocoError& error) {
    status = Status::kDiverged;
    message = error.what();
  }

  const double reached = static_cast<double>(k) * step;
  Trajectory out = record.finish(status == Status::kOk ? scene.run.end : reached);
  out.engine = "mujoco";
  out.integrator =
      scene.mujoco.integrator == scene::MujocoIntegrator::kImplicit ? "implicit" : "euler";
  out.contact_model = to_string(scene.mujoco.contact);
  out.step = step;
  out.steps = k;
  out.wall_s = run.wall();
  out.status = status;
  if (status != Status::kOk && status != Status::kStepTooLarge) {
    message += " at t = " + std::to_string(reached) + " s";
  }
  out.message = message;
  return out;
}

}  // namespace rotorub
