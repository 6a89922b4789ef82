#include "native_model/run/several_contacts.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "native_model/run/status_reason.h"
#include "native_model/stepping/coupled_verlet.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/zero_order_hold.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

class SeveralRun {
 public:
  SeveralRun(const Model& model, const scene::Run& run, double step, const NativeOptions& options)
      : model_(model),
        options_(options),
        step_(step),
        end_(run.end),
        recorder_(model, options.output_times.value_or(output_times(run)), kWindowSteps * run.step),
        stepper_(model, step),
        forces_(model.auxiliary.size(), Eigen::Vector2d(0.0, 0.0)),
        velocity_(static_cast<std::size_t>(model.nq())),
        acceleration_(velocity_),
        modes_(model.auxiliary.size(), Mode::kFree),
        others_(model.auxiliary.size() - 1),
        message_(step_refusal(model, step)) {
    for (std::size_t i = 0; i < model.auxiliary.size(); ++i) holds_.emplace_back(model, i);
    if (!message_.empty()) status_ = Status::kStepTooLarge;
    recorder_.statistics().contacts.resize(model.auxiliary.size());
  }

  // The state of t_k is known once step k is taken; of a step half is done before t_k, half after,
  // all of the first, half one, after. Impacts of step k belong to the next state.
  Trajectory go() {
    const auto start = std::chrono::steady_clock::now();
    const auto steps = static_cast<std::int64_t>(std::ceil(end_ / step_ - 1e-9));
    std::int64_t k = 0;
    for (; k <= steps && status_ == Status::kOk; ++k) {
      const double t = static_cast<double>(k) * step_;
      command(k);
      if (status_ != Status::kOk) break;
      const CoupledVerlet::Result done = stepper_.step(k, forces_);
      if (done.status != Status::kOk) {
        fail(done.status, t, status_reason(done.status));
        break;
      }
      stepper_.last_velocity(velocity_.data());
      const Snapshot now = snapshot(t, k, done);
      if (k == 0) {
        recorder_.begin(now);
      } else {
        count_lasting(done, t - 0.5 * step_, 0.5);
        recorder_.advance(now, contact_point(model_, now.q, now.v), hit_);
        watch_gaps(now);
        if (const auto why = out_of_range(model_, now.q)) fail(Status::kOutOfRange, t, *why);
      }
      note_modes(t, done);
      if (k == steps) break;
      count_lasting(done, t, k == 0 ? 1.0 : 0.5);
      count_impacts(done, t);
      tick(k, steps);
    }
    const std::int64_t taken = std::min(k, steps);
    Trajectory out =
        recorder_.finish(status_ == Status::kOk ? end_ : static_cast<double>(taken) * step_);
    out.engine = "native";
    out.integrator = "verlet";
    out.contact_model = "rigid";
    out.step = step_;
    out.steps = taken;
    out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    out.status = status_;
    out.message = message_;
    return out;
  }

 private:
  // What drives each ring over step k: the mean of its command over (t_k - h/2, t_k + h/2).
  void command(std::int64_t k) {
    const double t = static_cast<double>(k) * step_, end = t + 0.5 * step_;
    const double begin = k == 0 ? t : t - 0.5 * step_;
    const double* q = stepper_.q();
    bool known = false;
    for (std::size_t i = 0; i < holds_.size(); ++i) {
      const AuxiliaryBearing& bearing = model_.auxiliary[i];
      if (!bearing.commanded() && !bearing.magnets) continue;
      Eigen::Vector2d told = holds_[i].held();
      if (bearing.recorded) {
        told = bearing.recorded->mean(begin, end);
      } else if (holds_[i].listens(end)) {
        if (!known) {
          stepper_.velocity_now(k, velocity_.data());
          for (std::size_t j = 0; k > 0 && j < velocity_.size(); ++j) {
            acceleration_[j] = 2.0 / step_ * (velocity_[j] - stepper_.v_half()[j]);
          }
        }
        known = true;
        told = holds_[i].mean(begin, t, end, q, velocity_.data(), acceleration_.data());
      }
      if (!holds_[i].failure().empty() && status_ == Status::kOk) {
        status_ = Status::kControllerFailed;
        message_ = holds_[i].failure();
      }
      told_[i] = told;
      forces_[i] = actuator_state(model_, q, stepper_.v_half(), told, i).force;
    }
  }

  ContactSnapshot contact_snapshot(std::size_t i, double kick,
                                   const CoupledVerlet::Lasting& did) const {
    ContactSnapshot s{did.normal / kick, did.friction / kick, did.mode, {}};
    s.actuator = actuator_state(model_, stepper_.last_q(), velocity_.data(), told_[i], i);
    s.actuator.outputs = holds_[i].outputs();
    return s;
  }

  Snapshot snapshot(double t, std::int64_t k, const CoupledVerlet::Result& done) {
    const double kick = k == 0 ? 0.5 * step_ : step_;
    for (std::size_t i = 1; i < done.contacts.size(); ++i) {
      others_[i - 1] = contact_snapshot(i, kick, done.contacts[i]);
    }
    return {contact_snapshot(0, kick, done.contacts[0]), t, stepper_.last_q(), velocity_.data(),
            others_};
  }

  // The share of what lasting contact did over a step.
  void count_lasting(const CoupledVerlet::Result& done, double begin, double share) {
    StepFigures f;
    f.h = share * step_;
    f.contact_work = share * done.lasting_work;
    f.external_work = share * done.external_work;
    for (std::size_t i = 0; i < done.contacts.size(); ++i) {
      const CoupledVerlet::Lasting& did = done.contacts[i];
      if (!(did.normal > 0.0)) continue;
      const double slip = contact_point(model_, stepper_.last_q(), velocity_.data(), i).slip;
      const double normal = share * did.normal, friction = share * did.friction;
      f.normal_impulse += normal;
      f.friction_impulse += friction;
      f.friction_work += friction * slip;
      recorder_.count_at(i, begin, f.h, normal, friction, friction * slip);
    }
    recorder_.count(f, begin);
  }

  void count_impacts(const CoupledVerlet::Result& done, double begin) {
    hit_ = !done.impacts.empty();
    if (!hit_) return;
    StepFigures f;
    f.h = step_;
    f.impact = true;
    f.contact_work = done.impact_work;
    for (const Impact& hit : done.impacts) {
      const double work = 0.5 * hit.friction_impulse * (hit.slip_before + hit.slip_after);
      f.normal_impulse += hit.normal_impulse;
      f.friction_impulse += hit.friction_impulse;
      f.friction_work += work;
      recorder_.count_at(static_cast<std::size_t>(hit.contact), hit.t, step_, hit.normal_impulse,
                         hit.friction_impulse, work);
      recorder_.add(hit);
      recorder_.add(Event{hit.t, EventKind::kImpact, hit.contact});
    }
    recorder_.count(f, begin);
  }

  void watch_gaps(const Snapshot& now) {
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      recorder_.watch_gap(i, contact_point(model_, now.q, now.v, i).gap);
    }
  }

  void note_modes(double t, const CoupledVerlet::Result& done) {
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      const Mode mode = done.contacts[i].mode;
      const int contact = static_cast<int>(i);
      if (done.contacts[i].reversed) recorder_.add(Event{t, EventKind::kReverse, contact});
      if (mode == modes_[i]) continue;
      modes_[i] = mode;
      recorder_.add(Event{t, mode_event(mode), contact});
    }
  }

  void fail(Status status, double t, const std::string& why) {
    if (status_ != Status::kOk) return;
    status_ = status;
    message_ = why + " at t = " + std::to_string(t) + " s";
  }
  void tick(std::int64_t k, std::int64_t steps) {
    if ((k & 0xfff) != 0) return;
    if (options_.interrupt && options_.interrupt->load(std::memory_order_relaxed)) {
      fail(Status::kInterrupted, static_cast<double>(k) * step_,
           status_reason(Status::kInterrupted));
    }
    if (options_.progress) options_.progress(static_cast<double>(k) / static_cast<double>(steps));
  }

  const Model& model_;
  const NativeOptions& options_;
  double step_, end_;
  Recorder recorder_;
  CoupledVerlet stepper_;
  std::vector<ZeroOrderHold> holds_;
  std::array<Eigen::Vector2d, kMaxContacts> told_ = [] {
    std::array<Eigen::Vector2d, kMaxContacts> none;
    none.fill(Eigen::Vector2d(0.0, 0.0));
    return none;
  }();
  std::vector<Eigen::Vector2d> forces_;
  std::vector<double> velocity_, acceleration_;
  std::vector<Mode> modes_;
  std::vector<ContactSnapshot> others_;
  std::string message_;
  Status status_ = Status::kOk;
  bool hit_ = false;  // in the last step
};

}  // namespace

Trajectory run_several_contacts(const Model& model, const scene::Run& run, double step,
                                const NativeOptions& options) {
  return SeveralRun(model, run, step, options).go();
}

}  // namespace rotorub
