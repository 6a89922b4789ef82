#include "native_model/event/observer.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/impact.h"
#include "native_model/event/location.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"

namespace rotorub {

namespace {

// A row up to `now` (s) that is earlier only by round-off is a row of that instant: 0.3 s is the
// third multiple of a sample time of 0.1 s, which in floating point is later. Such a row waits for
// arrive() and shows the state after an event or a sample there.
double row_limit(double now) { return now * (1.0 - 1e-12); }

}  // namespace

Observer::Observer(const Model& model, const EventParameters& parameters, SmoothSystem& system)
    : model_(&model),
      parameters_(&parameters),
      system_(&system),
      row_(static_cast<std::size_t>(2 * model.nq() + integral_count(model))),
      slope_(row_),
      of_contacts_(model.auxiliary.size()),
      touches_(model.auxiliary.size()),
      shown_(model.auxiliary.size()) {}

void Observer::begin(const Motion& start, Recorder& recorder) {
  recorder_ = &recorder;
  std::fill(of_contacts_.begin(), of_contacts_.end(), ContactStatistics{});
  std::fill(touches_.begin(), touches_.end(), Touch{});
  contact_time_ = impact_work_ = impact_impulse_ = bin_start_ = 0.0;
  bin_ = parameters_->force_bin > 0.0 ? std::floor(start.t / parameters_->force_bin) : 0.0;
  energy_start_ = energy(*model_, start.t, start.q(), start.v());
  energy_scale_ = std::abs(energy_start_);
}

void Observer::started(const Motion& motion) {
  recorder_->begin(snapshot(motion.t, motion.y.data()));
  recorder_->statistics().energy_start = energy_start_;
}

ContactSnapshot Observer::snapshot_of(std::size_t k, double t, const double* y) const {
  ContactSnapshot s;
  s.normal_force = std::max(0.0, system_->multipliers(k).normal);
  s.friction_force = system_->multipliers(k).friction;
  s.mode = system_->state(k).mode;
  s.actuator = actuator_state(*model_, y, y + model_->nq(), system_->command(k, t, y), k);
  s.actuator.outputs = system_->outputs(k);
  return s;
}

Snapshot Observer::snapshot(double t, const double* y) {
  system_->derivative(t, y, slope_.data());
  for (std::size_t k = 0; k < shown_.size(); ++k) shown_[k] = snapshot_of(k, t, y);
  const int nq = model_->nq();  // the integrals are stored after the velocities
  return {t, y, y + nq, shown_, y + 2 * nq};
}

Snapshot Observer::within(const Motion& from, SmoothStep& step, Constraint& constraint, double t) {
  step.dense((t - from.t) / step.length(), row_.data());
  const auto closed = system_->rigid_contacts();
  if (!closed.empty()) constraint.to_circles(t, row_.data(), from.v(), closed);
  return snapshot(t, row_.data());
}

double Observer::normal_impulse(const Snapshot& at, std::size_t contact) const {
  return at.integrals[integral_index(kNormalImpulse, contact)] +
         of_contacts_[contact].impulse_total;
}

double Observer::normal_impulse(const Motion& motion) const {
  double sum = motion.integral(kNormalImpulse);
  for (std::size_t k = 1; k < of_contacts_.size(); ++k) sum += motion.integral(kNormalImpulse, k);
  return sum;
}

double Observer::contact_work(const Motion& motion) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < of_contacts_.size(); ++k) sum += motion.integral(kContactWork, k);
  return sum;
}

double Observer::prescribed_speed(std::size_t k) const {
  return model_->auxiliary[k].contact->radius * model_->prescribed_spin();
}

// Averages the normal force over bins of fixed width, as a fixed-step engine reports it, for its
// peak and mean square. In free flight only the bin that contains an impact counts.
template <class F>
void Observer::bins_until(double now, bool flies, F&& impulses_at) {
  const double width = parameters_->force_bin;
  if (width <= 0.0) return;
  Statistics& s = recorder_->statistics();
  constexpr std::size_t kAtOnce = 16;
  double edges[kAtOnce], impulses[kAtOnce];
  while (true) {
    std::size_t count = 0;
    for (; count < kAtOnce; ++count) {
      edges[count] = (bin_ + 1.0 + static_cast<double>(count)) * width;
      if (edges[count] > now) break;
    }
    if (count == 0) return;
    impulses_at(std::span(edges, count), impulses);
    for (std::size_t k = 0; k < count; ++k) {
      const double total = impact_impulse_ + impulses[k], force = (total - bin_start_) / width;
      s.peak_force = std::max(s.peak_force, force);
      s.force_square += force * force * width;
      if (total != bin_start_) recorder_->watch_impulse(edges[k] - 0.5 * width, total - bin_start_);
      bin_start_ = total;
      ++bin_;
      if (!flies || force != 0.0) continue;
      bin_ = std::max(bin_, std::floor(now / width) - 1.0);
      break;
    }
  }
}

void Observer::watch(const Motion& from, SmoothStep& step, Constraint& constraint, double now) {
  const double last = step.theta(now);
  ContactList<int> closed;  // indices of their impulses in y
  for (std::size_t k = 0; k < system_->contacts(); ++k) {
    const ContactStatistics& own = of_contacts_[k];
    if (system_->in_contact(k) || own.contact_time > 0.0 || own.impulse_total > 0.0) {
      follow(k, from, step, last);
    }
    if (!system_->in_contact(k)) continue;
    closed.push_back(from.index(kNormalImpulse, k));
    of_contacts_[k].contact_time += now - from.t;
    if (model_->auxiliary[k].is_compliant()) watch_touch(k, step, last);
  }
  for (double t = recorder_->next_time(); t < row_limit(now); t = recorder_->next_time())
    recorder_->row(within(from, step, constraint, t));
  follow_mark(from, step, constraint, now);
  bins_until(now, closed.empty(), [&](std::span<const double> times, double* impulses) {
    std::fill_n(impulses, times.size(), normal_impulse(from));
    for (const int i : closed) step.add_increments(i, times, impulses);
  });
  if (!closed.empty()) contact_time_ += now - from.t;
}

// Follows the centre at the start and the middle of a step, because half a step is less than half a
// turn. For a whole step Hermite's cubic gives the middle accurately enough to know its quarter of
// the turn. For a part of a step the dense output exists anyway.
void Observer::follow(std::size_t k, const Motion& from, SmoothStep& step, double last) {
  const Model& m = *model_;
  const Eigen::Vector2d start = separation(m, from.q(), k);
  const auto middle = [&]() -> Eigen::Vector2d {
    if (last < 1.0) return separation(m, step.at(0.5 * last), k);
    const Eigen::Vector3d change =
        contact_rates(m, from.v(), k) - contact_rates(m, step.end() + m.nq(), k);
    return 0.5 * (start + separation(m, step.end(), k)) + 0.125 * step.length() * change.head<2>();
  };
  FullPasses& passes = of_contacts_[k].passes;
  passes.follow(start, from.t);
  passes.follow(middle(), from.t + 0.5 * last * step.length());
}

// With a prescribed spin the dense output is only computed when there is a mark.
void Observer::follow_mark(const Motion& from, SmoothStep& step, Constraint& constraint,
                           double now) {
  const Model& m = *model_;
  const double last = step.theta(now);
  const double* end = last < 1.0 && m.layout.spin ? step.at(last) : step.end();
  Keyphasor& keyphasor = recorder_->keyphasor();
  keyphasor.follow(spin_angle(m, now, end), [&](double mark) {
    const auto time = [&](double share) { return from.t + share * (now - from.t); };
    const auto angle = [&](double share) {
      step.dense(share * last, row_.data());
      return spin_angle(m, time(share), row_.data());
    };
    const auto rate = [&](double) { return (now - from.t) * spin_speed(m, row_.data() + m.nq()); };
    const double t = time(share_at(mark, angle, rate));
    const Snapshot then = within(from, step, constraint, t);
    return keyphasor_pass(m, t, then.q, then.v);
  });
}

void Observer::watch_touch(std::size_t k, SmoothStep& step, double last) {
  Statistics& s = recorder_->statistics();
  double& peak = of_contacts_[k].peak_force;
  peak = locate_largest_force(k, step, last, peak);
  if (of_contacts_.size() == 1) s.peak_force = std::max(s.peak_force, peak);
  // Gauss-Legendre rule with three points.
  constexpr double kNodes[] = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr double kWeights[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (int i = 0; i < 3; ++i) {
    const double depth = separation(*model_, step.at(kNodes[i] * last), k).norm() -
                         model_->auxiliary[k].contact->clearance;
    s.penetration_square += kWeights[i] * last * step.length() * depth * depth;
  }
  const double gap = locate_least_gap(*model_, k, step, last);
  s.meet_gap(gap);
  of_contacts_[k].meet_gap(gap);
}

void Observer::begin_touch(const Motion& motion, const ClosedContact& at) {
  const std::size_t k = at.index;
  Touch& touch = touches_[k];
  touch = {true,
           {},
           motion.integral(kNormalImpulse, k),
           motion.integral(kFrictionImpulse, k),
           motion.integral(kContactWork, k)};
  touch.impact.t = motion.t;
  touch.impact.contact = static_cast<int>(k);
  touch.impact.gap_rate_before = at.point.gap_rate;
  touch.impact.slip_before = at.point.slip;
  record(motion.t, EventKind::kImpact, k);
}

void Observer::release(const Motion& motion, const ClosedContact& at) {
  const std::size_t k = at.index;
  Touch& touch = touches_[k];
  Impact& impact = touch.impact;
  impact.gap_rate_after = at.point.gap_rate;
  impact.slip_after = at.point.slip;
  impact.normal_impulse = motion.integral(kNormalImpulse, k) - touch.normal;
  impact.friction_impulse = motion.integral(kFrictionImpulse, k) - touch.friction;
  impact.energy_change =
      motion.integral(kContactWork, k) - touch.work + prescribed_speed(k) * impact.friction_impulse;
  recorder_->add(impact);
  const double lasted = motion.t - impact.t;
  if (std::ranges::all_of(model_->auxiliary, &AuxiliaryBearing::is_compliant)) {
    recorder_->count_episode(impact.t, lasted);
  } else if (lasted <= recorder_->window()) {  // beside a rigid contact
    recorder_->statistics().impact_time += lasted;
  }
  touch.active = false;
}

void Observer::watch(const Motion& from, const FiniteImpact& impact, std::size_t phase,
                     double now) {
  const double duration = impact.duration(phase);
  const double *v0 = impact.from(phase), *v1 = impact.to(phase);
  const Eigen::Vector2d force = impact.phase_force(phase);
  const auto state_at = [&](double passed) {
    const double share = passed / duration;
    for (int i = 0; i < from.nq; ++i) {
      row_[static_cast<std::size_t>(i)] = from.q()[i] + passed * v1[i];
      row_[static_cast<std::size_t>(from.nq + i)] = v0[i] + share * (v1[i] - v0[i]);
    }
  };
  // At its end the next phase begins, unless the run ends before.
  const bool cut = now < from.t + duration;
  for (double t = recorder_->next_time(); cut ? t <= now : t < now; t = recorder_->next_time()) {
    state_at(t - from.t);
    const Snapshot s = snapshot(t, row_.data());
    shown_[0].normal_force = force.x();
    shown_[0].friction_force = force.y();
    recorder_->row(s);
  }
  const auto angle = [&](double share) {
    const double passed = share * (now - from.t);
    state_at(passed);
    return spin_angle(*model_, from.t + passed, row_.data());
  };
  const double start = angle(0.0), end = angle(1.0);
  recorder_->keyphasor().follow(end, [&](double mark) {
    const double share = (mark - start) / (end - start);
    angle(share);
    return keyphasor_pass(*model_, std::lerp(from.t, now, share), row_.data(),
                          row_.data() + from.nq);
  });
  bins_until(now, false, [&](std::span<const double> times, double* impulses) {
    for (const double t : times)
      *impulses++ = from.integral(kNormalImpulse) + force.x() * (t - from.t);
  });
  contact_time_ += now - from.t;
  recorder_->statistics().impact_time += now - from.t;
}

void Observer::arrive(const Motion& motion) {
  while (recorder_->next_time() <= motion.t) {
    recorder_->row(snapshot(motion.t, motion.y.data()));
  }
}

void Observer::update_energy_scale(const Motion& m) {
  energy_scale_ = std::max(energy_scale_, std::abs(energy(*model_, m.t, m.q(), m.v())));
}

void Observer::account(Impact& record, double normal, double friction,
                       const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  const ImpulseWork work = impulse_work(normal, friction, before, after);
  record.normal_impulse += normal;
  record.friction_impulse += friction;
  record.energy_change += work.total();
  recorder_->statistics().friction_work += work.friction;
  impact_impulse_ += normal;
}

void Observer::record_impact(const Impact& impact) {
  // A machine that holds a prescribed speed exchanges work that is not work on the coordinates.
  const auto contact = static_cast<std::size_t>(impact.contact);
  impact_work_ += impact.energy_change - impact.friction_impulse * prescribed_speed(contact);
  const double rubbed = impulse_work(0.0, impact.friction_impulse, {0.0, impact.slip_before},
                                     {0.0, impact.slip_after})
                            .friction;
  recorder_->statistics().add(impact.normal_impulse, impact.friction_impulse, 0.0);
  of_contacts_[contact].add(impact.normal_impulse, impact.friction_impulse, rubbed);
  recorder_->add(impact);
  record(impact.t, EventKind::kImpact, contact);
}

void Observer::finish(const Motion& end) {
  Statistics& s = recorder_->statistics();
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    if (touches_[k].active) release(end, {k, contact_point(*model_, end.q(), end.v(), k)});
  }
  for (std::size_t k = 0; k < of_contacts_.size(); ++k) {
    ContactStatistics& own = of_contacts_[k];
    if (std::isfinite(system_->first_touch(k))) own.first_touch = system_->first_touch(k);
    if (own.first_touch >= 0.0 && (s.first_touch < 0.0 || own.first_touch < s.first_touch)) {
      s.first_touch = own.first_touch;
    }
    const double normal = end.integral(kNormalImpulse, k),
                 friction = end.integral(kFrictionImpulse, k);
    const double work = end.integral(kFrictionWork, k);
    own.add(normal, friction, work);
    s.add(normal, friction, work);
  }
  s.contact_time = contact_time_;
  s.gap_rate_square = end.integral(kGapRateSquare);
  s.contact_work = contact_work(end) + impact_work_;
  s.external_work = end.integral(kExternalWork);
  s.energy_end = energy(*model_, end.t, end.q(), end.v());
  s.energy_scale = std::max(energy_scale_, std::abs(s.energy_end));
  s.contacts = of_contacts_;
}

}  // namespace rotorub
