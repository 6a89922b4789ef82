#include "compare/engine/mujoco_record.h"

#include <algorithm>

#include "native_model/dynamics/dynamics.h"
#include "native_model/run/status_reason.h"
#include "native_model/stepping/zero_order_hold.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

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

}  // namespace

MujocoRecord::MujocoRecord(const Model& model, bool rigid, double step, std::vector<double> times,
                           double window)
    : model_(model),
      rigid_(rigid),
      step_(step),
      recorder_(model, std::move(times), window),
      episodes_(recorder_),
      others_(model.auxiliary.size() - 1),
      middle_(static_cast<std::size_t>(model.nq())),
      half_(middle_) {
  for (std::size_t k = 1; k < model.auxiliary.size(); ++k) {
    further_.push_back({Mode::kFree, ContactEpisodes(recorder_, static_cast<int>(k)), {}});
  }
  if (!further_.empty()) recorder_.statistics().contacts.resize(model.auxiliary.size());
}

void MujocoRecord::begin(const double* q, const double* v) {
  // A coil that lags has no current yet, whatever its command.
  const bool lags = model_.first().magnets && model_.first().magnets->coil_lag > 0.0;
  ZeroOrderHold hold(model_);
  const Eigen::Vector2d told = hold.at(0.0, q, v);
  ActuatorState acts = actuator_state(model_, q, v, lags ? Eigen::Vector2d(0.0, 0.0) : told);
  acts.outputs = hold.outputs();
  recorder_.begin({{0.0, 0.0, Mode::kFree, acts}, 0.0, q, v, others_});
  point_ = contact_point(model_, q, v);
  for (std::size_t k = 0; k < further_.size(); ++k)
    further_[k].point = contact_point(model_, q, v, k + 1);
  last_q_.assign(q, q + model_.nq());
  last_v_.assign(v, v + model_.nq());
}

// MuJoCo's step is leapfrog, v_k the velocity of half a step before q_k. So the forces of step k do
// their work at the mean of the velocities about t_k, and what they change is
//
//   E_k = v_k' M v_{k+1} / 2 + V(q_k):   E_k - E_{k-1} = (W_{k-1} + W_k) / 2,
//
// to round-off for linear springs. (With energies and powers of q_k and v_k at one time it would
// miss h/2 of the change of every force, without bound.) Dampers of the joints are implicit, -D
// v_{k+1}.
StepBalance MujocoRecord::balance_of_step(std::int64_t k, const double* q, const double* v,
                                          const StepResult& r) {
  const double t = static_cast<double>(k) * step_;
  StepBalance done;  // of the whole step, at its begin
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    middle_[i] = 0.5 * (last_v_[i] + v[i]);
    half_[i] = 0.5 * (v[i] - last_v_[i]);
    const double damping = model_.damping[static_cast<Eigen::Index>(i)];
    done.external_work -= step_ * damping * middle_[i] * half_[i];
  }
  done.external_work +=
      step_ * external_power(model_, t, last_q_.data(), middle_.data(), r.actuator.force);
  if (model_.first().contact) {
    const ContactPoint p = contact_point(model_, last_q_.data(), middle_.data());
    done.contact_work =
        step_ * (r.forces.normal * p.gap_rate + r.forces.friction * (p.slip - held(0)));
  }
  for (std::size_t i = 0; i < r.further.size(); ++i) {
    const ContactPoint p = contact_point(model_, last_q_.data(), middle_.data(), i + 1);
    const plugin::ContactForces& f = r.further[i];
    done.contact_work += step_ * (f.normal * p.gap_rate + f.friction * (p.slip - held(i + 1)));
  }
  const auto stored = [&](const std::vector<double>& rates) {
    return energy(model_, t, last_q_.data(), rates.data());
  };
  done.energy = stored(middle_) - stored(half_);
  std::fill(half_.begin(), half_.end(), 0.0);
  done.energy += stored(half_);

  if (k == 0) {
    recorder_.statistics().energy_start = done.energy;
    last_step_ = {done.energy, -done.contact_work, -done.external_work};
  }
  const StepBalance since{done.energy, 0.5 * (last_step_.contact_work + done.contact_work),
                          0.5 * (last_step_.external_work + done.external_work)};
  last_step_ = done;
  std::copy_n(q, last_q_.size(), last_q_.begin());
  std::copy_n(v, last_v_.size(), last_v_.begin());
  return since;
}

void MujocoRecord::step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
  const double t = static_cast<double>(k) * step_;
  const ContactPoint after = contact_point(model_, q, v);
  const double next = static_cast<double>(k + 1) * step_;
  const plugin::ContactForces& f = r.forces;
  const Impact impact = f.impact ? impact_of(f, impact_time(t, f, point_), step_) : Impact{};
  if (model_.first().contact && rigid_) note_rigid(next, f, impact);
  if (model_.first().contact && !rigid_) {
    episodes_.step({t, step_, point_, after, f.normal, f.friction, f.mode});
  }
  for (std::size_t i = 1; i <= further_.size(); ++i) step_further(k, i, q, v, r);
  if (!further_.empty() && f.normal > 0.0) {
    const double slips = f.impact ? f.slip_before + f.slip_after : point_.slip + after.slip;
    recorder_.count_at(0, t, step_, step_ * f.normal, step_ * f.friction,
                       0.5 * step_ * f.friction * slips);
  }
  if (!further_.empty()) recorder_.watch_gap(0, after.gap);
  const StepBalance balance = balance_of_step(k, q, v, r);
  // An impact's impulse is no force of lasting contact.
  const double lasting = f.impact ? 0.0 : 1.0;
  recorder_.step(
      {{lasting * f.normal, lasting * f.friction, f.mode, r.actuator}, next, q, v, others_},
      step_ * f.normal, step_ * f.friction, f.impact, f.impact ? &impact : nullptr, &balance);
  point_ = after;
}

// A contact beyond the first, over step k.
void MujocoRecord::step_further(std::int64_t k, std::size_t contact, const double* q,
                                const double* v, const StepResult& r) {
  Further& own = further_[contact - 1];
  const plugin::ContactForces& f = r.further[contact - 1];
  const double t = static_cast<double>(k) * step_, next = static_cast<double>(k + 1) * step_;
  const ContactPoint after = contact_point(model_, q, v, contact);
  if (rigid_) {
    Impact impact = f.impact ? impact_of(f, impact_time(t, f, own.point), step_) : Impact{};
    impact.contact = static_cast<int>(contact);
    note_rigid(next, f, impact, contact);
  } else {
    own.episodes.step({t, step_, own.point, after, f.normal, f.friction, f.mode});
  }
  const double lasting = f.impact ? 0.0 : 1.0;
  others_[contact - 1] = {lasting * f.normal, lasting * f.friction, f.mode, {}};
  if (f.normal > 0.0) {
    const double slips = f.impact ? f.slip_before + f.slip_after : own.point.slip + after.slip;
    const double normal = step_ * f.normal, friction = step_ * f.friction,
                 work = 0.5 * friction * slips;
    recorder_.count_at(contact, t, step_, normal, friction, work);
    recorder_.count_beside(t, step_, normal, friction, work, r.forces.normal > 0.0);
  }
  recorder_.watch_gap(contact, after.gap);
  own.point = after;
}

void MujocoRecord::native_step(std::int64_t k, const double* q, const double* v,
                               const StepResult& r, bool last) {
  const double t = static_cast<double>(k) * step_;
  const plugin::ContactForces& f = r.forces;
  const bool lasting = !f.impact;
  const ContactPoint p = contact_point(model_, q, v);
  note_mode(t, f.mode);
  if (k > 0) {
    if (impact_.normal_impulse > 0.0) count_impact();
    recorder_.advance(
        {{lasting ? f.normal : 0.0, lasting ? f.friction : 0.0, f.mode, r.actuator}, t, q, v}, p,
        impact_.normal_impulse > 0.0);
  }
  StepFigures figures;
  figures.h = k == 0 || last ? 0.5 * step_ : step_;
  const double share = last ? 0.5 : 1.0;  // the first step's works are those of half a kick
  figures.external_work = share * r.works.external;
  if (lasting && f.mode != Mode::kFree && f.normal > 0.0) {
    figures.normal_impulse = figures.h * f.normal;
    figures.friction_impulse = figures.h * f.friction;
    figures.friction_work = figures.friction_impulse * p.slip;
    figures.contact_work = share * r.works.contact;
  }
  recorder_.count(figures, t);
  impact_ = Impact{};
  if (f.impact && !last) {
    impact_ = impact_of(f, f.impact_time, k == 0 ? 0.5 * step_ : step_);
    impact_work_ = r.works.contact;
    recorder_.add(impact_);
    recorder_.add(Event{impact_.t, EventKind::kImpact});
  }
}

std::optional<std::string> MujocoRecord::lost(const double* q) const {
  if (further_.empty() && recorder_.penetration() == 0.0 && !model_.first().magnets) return {};
  if (rigid_ || !model_.first().contact) return out_of_range(model_, q);
  // A soft ring holds as deep as it is thick, which no one says; no ring holds what is through it.
  return out_of_range(model_, q,
                      std::max(model_.first().contact->clearance, model_.first().contact->radius));
}

Trajectory MujocoRecord::finish(double end) {
  if (!rigid_) episodes_.finish();
  for (Further& own : further_) {
    if (!rigid_) own.episodes.finish();
  }
  return recorder_.finish(end);
}

// m/s: slip of a prescribed spin, at which the machine that holds it works, and not the
// coordinates.
double MujocoRecord::held(std::size_t contact) const {
  return model_.layout.spin ? 0.0 : model_.auxiliary[contact].contact->radius * model_.speed;
}

void MujocoRecord::count_impact() {
  StepFigures figures;
  const double lasted = model_.first().contact->impact_time();
  figures.h = lasted > 0.0 ? lasted : step_;
  figures.impact = true;
  figures.normal_impulse = impact_.normal_impulse;
  figures.friction_impulse = impact_.friction_impulse;
  figures.friction_work =
      0.5 * impact_.friction_impulse * (impact_.slip_before + impact_.slip_after);
  figures.contact_work = impact_work_;
  recorder_.count(figures, impact_.t);
}

void MujocoRecord::note_mode(double t, Mode mode, std::size_t contact) {
  Mode& last = contact == 0 ? mode_ : further_[contact - 1].mode;
  if (mode == last) return;
  recorder_.add(Event{t, mode_event(mode), static_cast<int>(contact)});
  last = mode;
}

// As the native side: one row an impact. The velocity that jumps is that of half a step ago.
void MujocoRecord::note_rigid(double next, const plugin::ContactForces& f, const Impact& impact,
                              std::size_t contact) {
  if (f.impact) {
    recorder_.add(impact);
    recorder_.add(Event{impact.t, EventKind::kImpact, impact.contact});
  }
  note_mode(next, f.mode, contact);
}

// When the gap at t closes at the rate before the impact, within the step.
double MujocoRecord::impact_time(double t, const plugin::ContactForces& f,
                                 const ContactPoint& point) const {
  const double closing = point.gap / std::max(-f.gap_rate_before, 1e-300);
  return t + std::clamp(closing, 0.0, step_);
}

}  // namespace rotorub
