#include "native_model/trajectory/recorder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

bool has_actuator_columns(const AuxiliaryBearing& at) {
  return at.moves() && (at.commanded() || at.magnets);
}

// Their units and meanings: columns.cc.
std::vector<Column> make_columns(const Model& model) {
  const Layout& l = model.layout;
  std::vector<Column> c;
  const auto add = [&c](const std::string& name) {
    c.push_back({name, std::string(series_column(name).unit), {}});
  };
  const auto numbered = [&](const std::string& name, int count) {
    for (int k = 1; k <= count; ++k) add(name + "_" + std::to_string(k));
  };
  // What moves the ring of the k-th bearing, and its spin.
  const auto add_ring = [&](std::size_t k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    const auto of = [k](const char* name) { return column_of_contact(k, name); };
    if (has_actuator_columns(at)) {
      add(of("control_x"));
      add(of("control_y"));
    }
    numbered(of("current"), at.magnets ? 2 : 0);
    if (at.controller) {
      for (const Controller::Output& out : at.controller->outputs()) {
        c.push_back({of("control_") + std::string(out.name), std::string(out.unit), {}});
      }
    }
    if (!at.turns()) return;
    add(of("ring_angle"));
    add(of("ring_speed"));
  };
  for (const char* name : {"t", "rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x", "stator_y",
                           "stator_vx", "stator_vy", "spin_angle", "spin_speed", "gap", "gap_rate", "slip",
                           "normal_force", "friction_force", "mode"}) {
    add(name);
  }
  for (const char* name : {"x", "y", "vx", "vy"}) numbered(name, l.modes);
  numbered("torsion", l.torsion);
  numbered("torsion_speed", l.torsion);
  add_ring(0);
  if (model.drive) add("motor_torque");
  if (model.feedback) {
    add("bearing_current_x");
    add("bearing_current_y");
  }
  for (std::size_t k = 1; k < model.auxiliary.size(); ++k) {
    for (const char* name : {"rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x", "stator_y", "stator_vx",
                             "stator_vy", "gap", "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
      add(column_of_contact(k, name));
    }
    add_ring(k);
  }
  return c;
}

// The contact's rate of work on the coordinates is N gdot_N + T gdot_T, without what the machine
// that holds a prescribed speed does.
double dof_slip(const Model& model, const ContactPoint& p) {
  if (model.layout.spin || !model.first().contact) return p.slip;
  return p.slip - model.first().contact->radius * model.speed;
}

}  // namespace

std::vector<double> output_times(const scene::Run& run) {
  std::vector<double> times = run.output_times;
  times.push_back(run.end);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  // A multiple that round-off alone keeps apart from one of these is that one.
  const std::vector<double> exact = times;
  const double spacing = run.series_step(), same = 1e-9 * spacing;
  const auto known = [&](double t) {
    const auto next = std::lower_bound(exact.begin(), exact.end(), t - same);
    return next != exact.end() && *next <= t + same;
  };
  const auto count = static_cast<std::int64_t>(std::floor(run.end / spacing * (1.0 + 1e-12)));
  times.reserve(exact.size() + static_cast<std::size_t>(count) + 1);
  for (std::int64_t k = 0; k <= count; ++k) {
    const double t = static_cast<double>(k) * spacing;
    if (t < run.end && !known(t)) times.push_back(t);
  }
  std::sort(times.begin(), times.end());
  return times;
}

Recorder::Recorder(const Model& model, std::vector<double> times, double window)
    : model_(&model), times_(std::move(times)), columns_(make_columns(model)),
      least_gaps_(model.auxiliary.size(), std::numeric_limits<double>::infinity()), window_(window) {
  assert(std::is_sorted(times_.begin(), times_.end()));
  for (Column& column : columns_) column.values.reserve(times_.size());
  const auto n = static_cast<std::size_t>(model.nq());
  for (auto* v : {&last_q_, &last_v_, &q_, &v_}) v->assign(n, 0.0);
}

double Recorder::next_time() const {
  return next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity();
}

void Recorder::keep(const Snapshot& now) {
  last_ = now;
  std::copy_n(now.q, last_q_.size(), last_q_.begin());
  std::copy_n(now.v, last_v_.size(), last_v_.begin());
  last_.q = last_q_.data();
  last_.v = last_v_.data();
}

void Recorder::look_at_energy() {
  meet_energy(energy(*model_, last_.t, last_.q, last_.v));
}

void Recorder::meet_energy(double now) {
  Statistics& s = statistics_;
  s.energy_end = now;
  s.energy_scale = std::max(s.energy_scale, std::abs(now));
}

void Recorder::begin(const Snapshot& start) {
  const ContactPoint point = contact_point(*model_, start.q, start.v);
  keep(start);
  if (model_->first().contact) statistics_.least_gap = point.gap;
  last_gap_rate_ = point.gap_rate;
  last_slip_ = dof_slip(*model_, point);
  last_whole_slip_ = point.slip;
  last_power_ = external_power(*model_, start.t, start.q, start.v, start.actuator.force);
  look_at_energy();
  statistics_.energy_start = statistics_.energy_end;
  while (next_time() <= start.t) row(start);
}

void Recorder::count_contact(double normal_impulse, double friction_impulse, double h, double begin,
                             bool impact) {
  Statistics& s = statistics_;
  if (s.first_touch < 0.0) s.first_touch = begin;
  const double force = normal_impulse / h;
  s.contact_time += h;
  if (impact) s.impact_time += h;
  window_.add(begin, normal_impulse);
  s.impulse_total += normal_impulse;
  s.friction_impulse += friction_impulse;
  s.force_square += force * force * h;
  s.peak_force = std::max(s.peak_force, force);
}

void Recorder::count_gap(const ContactPoint& point, double h) {
  Statistics& s = statistics_;
  s.least_gap = std::min(s.least_gap, point.gap);
  penetration_ = std::max(0.0, -point.gap);
  if (penetration_ > 0.0) {
    s.max_penetration = std::max(s.max_penetration, penetration_);
    s.penetration_square += penetration_ * penetration_ * h;
  }
  if (s.first_touch >= 0.0) s.gap_rate_square += point.gap_rate * point.gap_rate * h;
}

void Recorder::count(const StepFigures& f, double begin) {
  if (f.normal_impulse > 0.0) count_contact(f.normal_impulse, f.friction_impulse, f.h, begin, f.impact);
  statistics_.friction_work += f.friction_work;
  statistics_.contact_work += f.contact_work;
  statistics_.external_work += f.external_work;
}

void Recorder::advance(const Snapshot& now, const ContactPoint& point, bool impact) {
  const double h = now.t - last_.t;
  const std::size_t row = next_;
  rows_until(now, impact);
  statistics_.external_work += switching_work(*model_, last_.t, now.t, now.q, now.v);
  if (model_->first().contact) count_gap(point, h);
  keep(now);
  constexpr std::int64_t kLook = 256;  // steps
  if (++steps_ % kLook == 0 || row != next_) look_at_energy();
}

void Recorder::step(const Snapshot& now, double normal_impulse, double friction_impulse,
                    bool impact, const Impact* detail, const StepBalance* balance) {
  const double h = now.t - last_.t;
  const ContactPoint point = contact_point(*model_, now.q, now.v);
  rows_until(now, impact);

  Statistics& s = statistics_;
  if (normal_impulse > 0.0) {
    count_contact(normal_impulse, friction_impulse, h, last_.t, impact);
    const double slips =
        detail ? detail->slip_before + detail->slip_after : last_whole_slip_ + point.slip;
    s.friction_work += 0.5 * friction_impulse * slips;
  }
  if (model_->first().contact) count_gap(point, h);
  s.external_work += switching_work(*model_, last_.t, now.t, now.q, now.v);
  if (balance) {
    s.contact_work += balance->contact_work;
    s.external_work += balance->external_work;
    keep(now);
    meet_energy(balance->energy);
  } else {
    book_ends(now, point, normal_impulse, friction_impulse, detail);
    keep(now);
    look_at_energy();
  }
  last_whole_slip_ = point.slip;
}

// Works by the means of rates and powers at the step's ends.
void Recorder::book_ends(const Snapshot& now, const ContactPoint& point, double normal_impulse,
                         double friction_impulse, const Impact* detail) {
  Statistics& s = statistics_;
  double gap_rates = last_gap_rate_ + point.gap_rate;
  double slips = last_slip_ + dof_slip(*model_, point);
  if (detail) {
    const double held = point.slip - dof_slip(*model_, point);
    gap_rates = detail->gap_rate_before + detail->gap_rate_after;
    slips = detail->slip_before + detail->slip_after - 2.0 * held;
  }
  s.contact_work += 0.5 * (normal_impulse * gap_rates + friction_impulse * slips);
  const double power = external_power(*model_, now.t, now.q, now.v, now.actuator.force);
  s.external_work += 0.5 * (now.t - last_.t) * (last_power_ + power);
  last_gap_rate_ = point.gap_rate;
  last_slip_ = dof_slip(*model_, point);
  last_power_ = power;
}

// Rows in (last, now]: at the step's own time its state to the bit, else interpolated.
void Recorder::rows_until(const Snapshot& now, bool impact) {
  const double h = now.t - last_.t;
  const double same = 1e-9 * h;  // a requested time this near to a step is that step
  while (next_time() <= now.t + same) {
    const double t = next_time(), s = (t - last_.t) / h;
    if (std::abs(now.t - t) <= same) {
      Snapshot exact = now;
      exact.t = t;
      row(exact);
      continue;
    }
    const double s2 = s * s, s3 = s2 * s;
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const double q0 = last_q_[i], q1 = now.q[i], v0 = last_v_[i], v1 = now.v[i];
      q_[i] = impact ? q0 + s * (q1 - q0)
                     : (2 * s3 - 3 * s2 + 1) * q0 + (s3 - 2 * s2 + s) * h * v0 +
                           (3 * s2 - 2 * s3) * q1 + (s3 - s2) * h * v1;
      v_[i] = v0 + s * (v1 - v0);
    }
    Snapshot between = now;
    between.t = t;
    between.q = q_.data();
    between.v = v_.data();
    row(between);
  }
}

void Recorder::add(const Impact& impact) { impacts_.push_back(impact); }
void Recorder::add(const Event& event) { events_.push_back(event); }

void Recorder::row(const Snapshot& now) {
  const Model& m = *model_;
  const Layout& l = m.layout;
  const ContactPoint p = contact_point(m, now.q, now.v);
  const Eigen::Vector2d r = rotor_point(m, now.q), rv = rotor_point(m, now.v);
  const Eigen::Vector2d f = ring_centre(m, now.q), fv = stator_point(m, now.v);
  if (m.first().contact) statistics_.least_gap = std::min(statistics_.least_gap, p.gap);
  least_gaps_[0] = std::min(least_gaps_[0], p.gap);
  resting_ = now.mode == Mode::kFree ? 0.0 : now.normal_force * m.first().contact->clearance;
  auto column = columns_.begin();
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  for (double value : {next_time(), r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(),
                       spin_angle(m, now.t, now.q), spin_speed(m, now.v), p.gap, p.gap_rate, p.slip,
                       now.normal_force, now.friction_force, static_cast<double>(now.mode)}) {
    put(value);
  }
  const auto block = [&](const double* from, int at, int count) {
    for (int k = 0; k < count; ++k) put(from[at + k]);
  };
  block(now.q, l.x(), 2 * l.modes);
  block(now.v, l.x(), 2 * l.modes);
  block(now.q, l.theta(), l.torsion);
  block(now.v, l.theta(), l.torsion);
  put_ring(0, now, now, column);
  if (m.drive) put(motor_torque(m, next_time(), now.q, now.v));
  if (m.feedback) {
    for (const double current : bearing_current(m, next_time(), now.q, now.v)) put(current);
  }
  for (std::size_t k = 1; k < m.auxiliary.size(); ++k) put_further(k, now.others[k - 1], now, column);
  assert(column == columns_.end());
  ++next_;
}

// The columns of another contact than the first.
void Recorder::put_further(std::size_t k, const ContactSnapshot& at, const Snapshot& now, Place& column) {
  const Model& m = *model_;
  const ContactPoint p = contact_point(m, now.q, now.v, k);
  const Eigen::Vector2d r = rotor_point(m, now.q, k), rv = rotor_point(m, now.v, k);
  const Eigen::Vector2d f = ring_centre(m, now.q, k), fv = stator_point(m, now.v, k);
  statistics_.least_gap = std::min(statistics_.least_gap, p.gap);
  least_gaps_[k] = std::min(least_gaps_[k], p.gap);
  if (at.mode != Mode::kFree) resting_ += at.normal_force * m.auxiliary[k].contact->clearance;
  for (double value : {r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(), p.gap, p.gap_rate, p.slip,
                       at.normal_force, at.friction_force, static_cast<double>(at.mode)}) {
    (column++)->values.push_back(value);
  }
  put_ring(k, at, now, column);
}

// What moves the ring of the k-th bearing, and its spin.
void Recorder::put_ring(std::size_t k, const ContactSnapshot& at, const Snapshot& now, Place& column) {
  const AuxiliaryBearing& bearing = model_->auxiliary[k];
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  if (has_actuator_columns(bearing)) {
    put(at.actuator.force.x());
    put(at.actuator.force.y());
  }
  if (bearing.magnets) {
    put(at.actuator.current.x());
    put(at.actuator.current.y());
  }
  if (bearing.controller && !bearing.controller->outputs().empty()) {
    std::array<double, kMostOutputs> values = at.actuator.outputs;
    if (!bearing.loop) control_outputs(*model_, now.t, now.q, now.v, values.data(), k);
    for (std::size_t i = 0; i < bearing.controller->outputs().size(); ++i) put(values[i]);
  }
  if (!bearing.turns()) return;
  put(now.q[bearing.ring_angle]);
  put(now.v[bearing.ring_angle]);
}

Trajectory Recorder::finish(double end) {
  if (steps_ > 0) look_at_energy();
  statistics_.energy_scale = std::max(statistics_.energy_scale, resting_);
  statistics_.window_impulse = window_.largest();
  for (std::size_t k = 0; k < statistics_.contacts.size(); ++k) {
    ContactStatistics& own = statistics_.contacts[k];
    own.least_gap = std::min(own.least_gap, least_gaps_[k]);
    if (own.first_touch >= 0.0) own.least_gap = std::min(own.least_gap, 0.0);
  }
  Trajectory t;
  t.end = end;
  t.contacts = model_->auxiliary.size();
  t.series = std::move(columns_);
  t.impacts = std::move(impacts_);
  t.events = std::move(events_);
  t.statistics = statistics_;
  return t;
}

}  // namespace rotorub
