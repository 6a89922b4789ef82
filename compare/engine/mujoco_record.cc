#include "compare/engine/mujoco_record.h"

#include <algorithm>

#include "native_model/model/dynamics.h"
#include "native_model/stepping/zero_order_hold.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/status_reason.h"

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

// Time of an impact that the engine did not locate: when the gap at t would close at the approach
// rate, limited to the step. The velocity that jumps is the one half a step before t.
double impact_time(const plugin::ContactForces& f, double t, double h, double gap) {
  return t + std::clamp(gap / std::max(-f.gap_rate_before, 1e-300), 0.0, h);
}

}  // namespace

MujocoRecord::MujocoRecord(const Model& model, bool rigid, double step, std::vector<double> times,
                           double window)
    : model_(model),
      rigid_(rigid),
      step_(step),
      recorder_(model, std::move(times), window),
      shown_(model.auxiliary.size()),
      points_(model.auxiliary.size()),
      middle_(static_cast<std::size_t>(model.nq())),
      half_(middle_) {
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    contacts_.push_back({ContactMode::kFree, ContactEpisodes(recorder_, static_cast<int>(k)), {}});
  }
}

void MujocoRecord::begin(const double* q, const double* v) {
  // A lagging coil carries no current at the start, whatever its command.
  ZeroOrderHold hold(model_);
  const Eigen::Vector2d told = hold.at(0.0, q, v);
  ActuatorState acts =
      actuator_state(model_, q, v, model_.first().lags() ? Eigen::Vector2d(0.0, 0.0) : told);
  acts.outputs = hold.outputs();
  shown_[0].actuator = acts;
  recorder_.begin({0.0, q, v, shown_});
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    contacts_[k].point = contact_point(model_, q, v, k);
  last_q_.assign(q, q + model_.nq());
  last_v_.assign(v, v + model_.nq());
}

// MuJoCo's step is leapfrog: v_k is the velocity half a step before q_k. The forces of step k
// therefore work at the mean of the velocities around t_k, and the energy balance
//
//   E_k = v_k' M v_{k+1} / 2 + V(q_k):   E_k - E_{k-1} = (W_{k-1} + W_k) / 2,
//
// holds to round-off for linear springs. (With energies and powers from q_k and v_k it would miss
// h/2 times the change of every force, without bound.) Joint dampers are implicit, -D v_{k+1}.
StepBalance MujocoRecord::balance_of_step(std::int64_t k, const double* q, const double* v,
                                          const StepResult& r) {
  const double t = time(k);
  StepBalance done;  // of the whole step, evaluated at its begin
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    middle_[i] = 0.5 * (last_v_[i] + v[i]);
    half_[i] = 0.5 * (v[i] - last_v_[i]);
    const double damping = model_.damping[static_cast<Eigen::Index>(i)];
    done.external_work -= step_ * damping * middle_[i] * half_[i];
  }
  done.external_work +=
      step_ * external_power(model_, t, last_q_.data(), middle_.data(), r.actuator.force);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!model_.auxiliary[i].contact) continue;
    const ContactPoint p = contact_point(model_, last_q_.data(), middle_.data(), i);
    const plugin::ContactForces& f = r.forces[i];
    done.contact_work += step_ * (f.normal * p.gap_rate + f.friction * (p.slip - held(i)));
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
  const Impact impact = step_contact(k, 0, q, v, r);
  for (std::size_t i = 1; i < contacts_.size(); ++i) step_contact(k, i, q, v, r);
  const StepBalance balance = balance_of_step(k, q, v, r);
  const plugin::ContactForces& f = r.forces.front();
  recorder_.step({time(k + 1), q, v, shown_}, step_ * f.normal, step_ * f.friction,
                 f.impact ? &impact : nullptr, balance);
}

// Shows the contact's forces without the impulse of an impact, which is not a lasting force, and
// the actuator of the first ring.
void MujocoRecord::show(std::size_t contact, const StepResult& r) {
  const plugin::ContactForces& f = r.forces[contact];
  const double share = f.impact ? 0.0 : 1.0;
  shown_[contact] = {share * f.normal, share * f.friction, f.mode,
                     contact == 0 ? r.actuator : ActuatorState{}};
}

// Records a contact over step k; returns its impact, or an empty one.
Impact MujocoRecord::step_contact(std::int64_t k, std::size_t contact, const double* q,
                                  const double* v, const StepResult& r) {
  AtContact& own = contacts_[contact];
  const plugin::ContactForces& f = r.forces[contact];
  const double t = time(k);
  const ContactPoint after = contact_point(model_, q, v, contact);
  Impact impact =
      f.impact ? impact_of(f, impact_time(f, t, step_, own.point.gap), step_) : Impact{};
  impact.contact = static_cast<int>(contact);
  if (rigid_) {
    if (f.impact) {  // one row per impact, as on the native side
      recorder_.add(impact);
      recorder_.add(Event{impact.t, EventKind::kImpact, impact.contact});
    }
    note_mode(time(k + 1), f.mode, contact);
  } else if (model_.auxiliary[contact].contact) {
    own.episodes.step({t, step_, own.point, after, f.normal, f.friction, f.mode});
  }
  show(contact, r);
  if (contact > 0 && f.normal > 0.0) {
    const double slips = f.impact ? f.slip_before + f.slip_after : own.point.slip + after.slip;
    const double normal = step_ * f.normal, friction = step_ * f.friction;
    double before = 0.0;
    for (std::size_t i = 0; i < contact; ++i) before += step_ * r.forces[i].normal;
    recorder_.count_further(contact, t, step_, normal, friction, 0.5 * friction * slips, before);
  }
  own.point = after;
  return impact;
}

void MujocoRecord::native_step(std::int64_t k, const double* q, const double* v,
                               const StepResult& r, bool last) {
  const double t = time(k), kick = k == 0 ? 0.5 * step_ : step_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    points_[i] = contact_point(model_, q, v, i);
    note_mode(t, r.forces[i].mode, i);
    show(i, r);
  }
  if (k > 0) {
    count_impacts();
    recorder_.advance({t, q, v, shown_}, points_, !impacts_.empty());
  }
  StepFigures figures;
  figures.h = last ? 0.5 * step_ : kick;
  // The works of the first step already belong to half a kick.
  const double share = last ? 0.5 : 1.0;
  figures.external_work = share * r.works.external;
  figures.contact_work = share * (r.works.contact - r.works.impact);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const plugin::ContactForces& f = r.forces[i];
    if (f.impact || f.mode == ContactMode::kFree || !(f.normal > 0.0)) continue;
    const double normal = figures.h * f.normal, friction = figures.h * f.friction;
    add_contact(figures, i, t, normal, friction, friction * points_[i].slip);
  }
  recorder_.count(figures, t);
  impacts_.clear();
  impact_work_ = r.works.impact;
  for (std::size_t i = 0; i < contacts_.size() && !last; ++i) {
    const plugin::ContactForces& f = r.forces[i];
    if (!f.impact) continue;
    impacts_.push_back(impact_of(f, f.impact_time, kick));
    impacts_.back().contact = static_cast<int>(i);
    recorder_.add(impacts_.back());
    recorder_.add(Event{f.impact_time, EventKind::kImpact, static_cast<int>(i)});
  }
}

// Adds the impulses (N s) and the friction work (J) of a contact to the totals and to its own
// figures.
void MujocoRecord::add_contact(StepFigures& figures, std::size_t contact, double t, double normal,
                               double friction, double work) {
  figures.normal_impulse += normal;
  figures.friction_impulse += friction;
  figures.friction_work += work;
  recorder_.count_at(contact, t, figures.h, normal, friction, work);
}

std::optional<std::string> MujocoRecord::lost(const double* q, const double* v) const {
  // Rigid and compliant contacts end at the same range as on the native side.
  const bool soft = !rigid_ && !model_.is_compliant();
  return out_of_range(model_, q, v, soft ? RingDepth::kThickness : RingDepth::kClearance);
}

Trajectory MujocoRecord::finish(const RunEnd& end) {
  if (!rigid_) {
    for (AtContact& own : contacts_) own.episodes.finish();
  }
  return recorder_.finish(end);
}

// m/s: the slip from a prescribed spin. The machine that holds the spin does this work, not the
// coordinates.
double MujocoRecord::held(std::size_t contact) const {
  return model_.auxiliary[contact].contact->radius * model_.prescribed_spin();
}

// Counts the impacts of the previous step.
void MujocoRecord::count_impacts() {
  if (impacts_.empty()) return;
  StepFigures figures;
  const double lasted = model_.first().contact->impact_time();
  figures.h = lasted > 0.0 ? lasted : step_;
  figures.impact = true;
  figures.contact_work = impact_work_;
  for (const Impact& hit : impacts_) {
    const double work = 0.5 * hit.friction_impulse * (hit.slip_before + hit.slip_after);
    add_contact(figures, static_cast<std::size_t>(hit.contact), hit.t, hit.normal_impulse,
                hit.friction_impulse, work);
  }
  recorder_.count(figures, impacts_.front().t);
}

void MujocoRecord::note_mode(double t, ContactMode mode, std::size_t contact) {
  ContactMode& last = contacts_[contact].mode;
  if (mode == last) return;
  recorder_.add(Event{t, mode_event(mode), static_cast<int>(contact)});
  last = mode;
}

WatchFeed::WatchFeed(const Model& model, double step, StepWatch watch)
    : model_(model),
      h_(step),
      watch_(std::move(watch)),
      lags_(model.first().lags()),
      contacts_(model.auxiliary.size()) {}

void WatchFeed::begin(const double* q, const double* v) {
  if (!watch_) return;
  q_.assign(q, q + model_.nq());
  v_.assign(v, v + model_.nq());
  mean_ = v_;
}

void WatchFeed::step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
  if (!watch_) return;
  for (std::size_t i = 0; i < v_.size(); ++i) mean_[i] = k == 0 ? v_[i] : 0.5 * (v_[i] + v[i]);
  tell(k, q_.data(), mean_.data(), h_, r);
  std::copy_n(q, q_.size(), q_.begin());
  std::copy_n(v, v_.size(), v_.begin());
}

void WatchFeed::native_step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
  if (!watch_) return;
  tell(k, q, v, k == 0 ? 0.5 * h_ : h_, r);
}

// kick: s, the time over which the step's forces act.
void WatchFeed::tell(std::int64_t k, const double* q, const double* v, double kick,
                     const StepResult& r) {
  WatchedStep s;
  s.t = static_cast<double>(k) * h_;
  s.h = h_;
  s.q = q;
  s.v = v;
  s.current = current_;
  s.command = r.command;
  // With lagging coils the current responds from the start of the step on.
  s.command_begin = k == 0 || lags_ ? s.t : s.t - 0.5 * h_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const plugin::ContactForces& f = r.forces[i];
    contacts_[i] = {kick * f.normal, f.impact, f.impact_time, f.gap_rate_after};
    if (f.impact && f.impact_time == 0.0) {
      contacts_[i].impact_time = impact_time(f, s.t, h_, contact_point(model_, q, v, i).gap);
    }
  }
  s.contacts = contacts_;
  watch_(s);
  current_ = r.actuator.current;
}

}  // namespace rotorub
