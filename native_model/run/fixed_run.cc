#include "native_model/run/fixed_run.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/run/step_commands.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/stepper.h"
#include "native_model/trajectory/contact_episodes.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"
#include "native_model/trajectory/status_reason.h"

namespace rotorub {
namespace {

// A state that the run has reached.
struct StateAt {
  double t;  // s
  const double *q, *v;
};

// The impacts of a step, which are counted after the next one.
struct PendingImpacts {
  std::vector<Impact> impacts;
  double work = 0.0, lasts = 0.0;  // J; s: the duration of an impact that takes time
  explicit PendingImpacts(std::size_t most) { impacts.reserve(most); }
  void keep(const FixedStep& done) {
    impacts.assign(done.impacts.begin(), done.impacts.end());
    work = done.impact_work;
    lasts = done.impact_time;
  }
};

class FixedRun {
 public:
  FixedRun(scene::Integrator integrator, const Model& model, const scene::Run& run, double step,
           const NativeOptions& options)
      : model_(model),
        options_(options),
        contacts_(model.auxiliary.size()),
        step_(step),
        end_(run.end),
        steps_(scene::step_count(end_, step_)),
        recorder_(model, options.output_times.value_or(output_times(run)), kWindowSteps * run.step),
        stepper_(make_stepper(integrator, model, step)),
        commands_(model, *stepper_, step),
        points_(contacts_),
        last_points_(contacts_),
        shown_(contacts_),
        message_(step_refusal(model, step)) {
    episodes_.resize(contacts_);
    for (std::size_t i = 0; i < contacts_; ++i) {
      if (model.auxiliary[i].is_compliant()) episodes_[i].emplace(recorder_, static_cast<int>(i));
    }
    if (!message_.empty()) status_ = Status::kStepTooLarge;
  }

  Trajectory take_all_steps() {
    const std::int64_t taken = stepper_->leaps() ? take_leapfrog_steps() : take_plain_steps();
    for (std::optional<ContactEpisodes>& episode : episodes_) {
      if (episode) episode->finish();
    }
    return recorder_.finish({good() ? end_ : time(taken), taken, status_, message_});
  }

 private:
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }
  bool good() const { return status_ == Status::kOk; }

  // The law of magnetic bearings is evaluated within the step.
  FixedStep take_step(std::int64_t k) {
    try {
      return stepper_->step(k, commands_.of_step(), true);
    } catch (const ControllerError& error) {
      controller_failed(error.what());
      FixedStep none;
      none.status = status_;
      return none;
    }
  }

  // For steps that yield the state at their end; returns the number of steps taken.
  std::int64_t take_plain_steps() {
    commands_.hold(0);
    check_controllers();
    begin({}, 1.0);
    for (std::int64_t k = 0; k < steps_; ++k) {
      commands_.hold(k);
      check_controllers();
      if (!good()) return k;
      const FixedStep done = take_step(k);
      if (done.status != Status::kOk) {
        fail(done.status, time(k), status_reason(done.status));
        return k;
      }
      add_impacts(done.impacts);
      const StateAt now = observe(time(k + 1), stepper_->q(), stepper_->v());
      count_lasting(done, time(k), 1.0, step_);
      count_impacts(done.impacts, done.impact_work, step_, time(k));
      advance(now, done, step_, !done.impacts.empty());
      report_progress(k);
      if (!good()) return k + 1;
    }
    return steps_;
  }

  // For leapfrog steps, where the state at t_k is known only after step k: the recorder is one step
  // behind, and the impacts of step k belong to the next state. One step beyond the end gives the
  // velocities at the end; half of the work of its loads counts.
  std::int64_t take_leapfrog_steps() {
    PendingImpacts last(contacts_ * contacts_ * kMostImpacts);
    std::int64_t k = 0;
    for (; k <= steps_ && good(); ++k) {
      const double t = time(k), kick = k == 0 ? 0.5 * step_ : step_;
      commands_.mean_about(k);
      check_controllers();
      if (!good()) {
        if (k == 0) begin({}, 1.0);
        break;
      }
      const FixedStep done = take_step(k);
      if (done.status != Status::kOk) {
        if (done.status == Status::kControllerFailed && k == 0) begin({}, 1.0);
        fail(done.status, t, status_reason(done.status));
        break;
      }
      if (k == 0) begin(done, kick);
      // Half of a step's effect lies before t_k and half after; all of the first step's lies after.
      const StateAt now = observe(t, stepper_->last_q(), stepper_->last_velocity());
      // Impacts separate the two halves.
      const bool whole = k > 0 && k < steps_ && last.impacts.empty() && done.impacts.empty();
      if (whole) {
        count_lasting(done, t, 1.0, step_);
        advance(now, done, kick, false);
      } else if (k > 0) {
        count_lasting(done, t, 0.5, 0.5 * step_);
        if (!last.impacts.empty()) {
          count_impacts(last.impacts, last.work, last.lasts > 0.0 ? last.lasts : step_,
                        last.impacts.front().t);
        }
        advance(now, done, kick, !last.impacts.empty());
      }
      if (!whole && k < steps_) count_lasting(done, t, k == 0 ? 1.0 : 0.5, 0.5 * step_);
      last.keep(done);
      if (k < steps_) add_impacts(done.impacts);
      report_progress(k);
    }
    return std::min(k, steps_);
  }

  // ------------------------------------------------------------------ what is recorded
  StateAt observe(double t, const double* q, const double* v) {
    last_points_.swap(points_);
    for (std::size_t i = 0; i < contacts_; ++i) {
      if (model_.auxiliary[i].contact) points_[i] = contact_point(model_, q, v, i);
    }
    return {t, q, v};
  }

  // The state and, as their impulses over `kick` (s), the forces of lasting contact, plus the force
  // of an impact that takes time; other impacts do not contribute. row: whether the actuators are
  // shown. Valid until the next call.
  Snapshot snapshot(const StateAt& at, const FixedStep& done, double kick, bool row) {
    const double scale = 1.0 / kick;
    for (std::size_t i = 0; i < done.contacts.size(); ++i) {
      const ContactStep& did = done.contacts[i];
      shown_[i].normal_force = scale * did.lasting.x() + did.impact_force.x();
      shown_[i].friction_force = scale * did.lasting.y() + did.impact_force.y();
      shown_[i].mode = did.mode;
    }
    for (std::size_t i = 0; row && i < contacts_; ++i) {
      ActuatorState& actuator = shown_[i].actuator;
      actuator = actuator_state(model_, at.q, at.v, commands_.shown(i), i);
      actuator.outputs = commands_.outputs(i);
    }
    return {at.t, at.q, at.v, shown_};
  }

  void begin(const FixedStep& done, double kick) {
    const StateAt start{0.0, model_.q0.data(), model_.v0.data()};
    recorder_.begin(snapshot(start, done, kick, true));
    note_contacts(0.0, done, kick, false);
  }

  // Counts a share of the effect of lasting contact and loads in a step, for `lasts` s from `begin`
  // on.
  void count_lasting(const FixedStep& done, double begin, double share, double lasts) {
    StepFigures f;
    f.h = lasts;
    f.contact_work = share * (done.contact_work - done.impact_work);
    f.external_work = share * done.external_work;
    for (std::size_t i = 0; i < done.contacts.size(); ++i) {
      const Eigen::Vector2d did = share * done.contacts[i].lasting;
      if (!(did.x() > 0.0)) continue;
      const double work = did.y() * points_[i].slip;
      f.normal_impulse += did.x();
      f.friction_impulse += did.y();
      f.friction_work += work;
      recorder_.count_at(i, begin, f.h, did.x(), did.y(), work);
    }
    recorder_.count(f, begin);
  }
  void count_impacts(std::span<const Impact> impacts, double contact_work, double lasts,
                     double begin) {
    if (impacts.empty()) return;
    StepFigures f;
    f.h = lasts;
    f.impact = true;
    f.contact_work = contact_work;
    for (const Impact& hit : impacts) {
      const double work = 0.5 * hit.friction_impulse * (hit.slip_before + hit.slip_after);
      f.normal_impulse += hit.normal_impulse;
      f.friction_impulse += hit.friction_impulse;
      f.friction_work += work;
      recorder_.count_at(static_cast<std::size_t>(hit.contact), hit.t, lasts, hit.normal_impulse,
                         hit.friction_impulse, work);
    }
    recorder_.count(f, begin);
  }
  void add_impacts(std::span<const Impact> impacts) {
    for (const Impact& hit : impacts) {
      recorder_.add(hit);
      recorder_.add(Event{hit.t, EventKind::kImpact, hit.contact});
    }
  }

  // Records the next state with the forces of `done`. impact: whether there was one since the last
  // state.
  void advance(const StateAt& now, const FixedStep& done, double kick, bool impact) {
    note_contacts(now.t, done, kick, true);
    recorder_.advance(snapshot(now, done, kick, recorder_.row_due(now.t)), points_, impact);
    if (const auto why = out_of_range(model_, now.q, now.v)) fail(Status::kOutOfRange, now.t, *why);
  }
  // Notes events of rigid contacts and the episodes of compliant ones, which start after the run
  // has begun.
  void note_contacts(double t, const FixedStep& done, double kick, bool begun) {
    for (std::size_t i = 0; i < done.contacts.size(); ++i) {
      const ContactStep& did = done.contacts[i];
      const int contact = static_cast<int>(i);
      if (episodes_[i] && !begun) continue;
      if (did.reversed) recorder_.add(Event{t, EventKind::kReverse, contact});
      if (episodes_[i]) {
        episodes_[i]->step({t, kick, points_[i], points_[i], did.lasting.x() / kick,
                            did.lasting.y() / kick, did.mode, &last_points_[i]});
      } else if (did.mode != modes_[i]) {
        modes_[i] = did.mode;
        recorder_.add(Event{t, mode_event(did.mode), contact});
      }
    }
  }

  void check_controllers() {
    if (!commands_.failure().empty()) controller_failed(commands_.failure());
  }
  // why: must include the time.
  void controller_failed(const std::string& why) {
    if (!good()) return;
    status_ = Status::kControllerFailed;
    message_ = why;
  }
  void fail(Status status, double t, const std::string& why) {
    if (!good()) return;
    status_ = status;
    message_ = why + " at t = " + std::to_string(t) + " s";
  }
  void report_progress(std::int64_t k) {
    // At every step, because a controller may take long.
    if (options_.interrupt && options_.interrupt->load(std::memory_order_relaxed)) {
      fail(Status::kInterrupted, time(k), status_reason(Status::kInterrupted));
    }
    if ((k & 0xfff) == 0 && options_.progress)
      options_.progress(static_cast<double>(k) / static_cast<double>(steps_));
  }

  const Model& model_;
  const NativeOptions& options_;
  const std::size_t contacts_;
  double step_, end_;
  std::int64_t steps_;
  Recorder recorder_;
  std::unique_ptr<FixedStepper> stepper_;
  StepCommands commands_;
  std::vector<ContactPoint> points_, last_points_;        // at the last state and the one before it
  std::vector<std::optional<ContactEpisodes>> episodes_;  // for compliant contacts
  std::vector<ContactSnapshot> shown_;                    // of the last snapshot
  std::array<ContactMode, kMaxContacts> modes_{};
  std::string message_;
  Status status_ = Status::kOk;
};

}  // namespace

Trajectory run_fixed(scene::Integrator integrator, const Model& model, const scene::Run& run,
                     double step, const NativeOptions& options) {
  return FixedRun(integrator, model, run, step, options).take_all_steps();
}

}  // namespace rotorub
