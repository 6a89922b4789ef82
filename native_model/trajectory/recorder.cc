#include "native_model/trajectory/recorder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "native_model/model/dynamics.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

// Total time covered by the spans, s; sorts them.
double length_of_union(std::vector<Recorder::Span>& times) {
  std::ranges::stable_sort(times, {}, &Recorder::Span::begin);
  double length = 0.0, reached = -std::numeric_limits<double>::infinity();
  for (const Recorder::Span& of : times) {
    length += std::max(0.0, of.end - std::max(of.begin, reached));
    reached = std::max(reached, of.end);
  }
  return length;
}

}  // namespace

std::vector<double> output_times(const scene::Run& run) {
  std::vector<double> times = run.output_times;
  times.push_back(run.end);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  // A multiple that differs only by round-off from one of these times is left out.
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

KeyphasorPass keyphasor_pass(const Model& model, double t, const double* q, const double* v) {
  const Eigen::Vector2d at = rotor_point(model, q);
  return {t, at.x(), at.y(), spin_speed(model, v)};
}

Recorder::Recorder(const Model& model, std::vector<double> times, double window)
    : model_(&model),
      times_(std::move(times)),
      columns_(series_of(model)),
      switches_unbalance_(
          model.coupled_mass() &&
          std::ranges::any_of(model.unbalances, [](const DiscUnbalance& u) { return u.on > 0.0; })),
      points_(model.auxiliary.size()),
      least_gaps_(model.auxiliary.size(), std::numeric_limits<double>::infinity()),
      window_(window) {
  assert(std::is_sorted(times_.begin(), times_.end()));
  for (Column& column : columns_) column.values.reserve(times_.size());
  const auto n = static_cast<std::size_t>(model.nq());
  for (auto* v : {&last_q_, &last_v_, &q_, &v_}) v->assign(n, 0.0);
  statistics_.contacts.resize(model.auxiliary.size());
}

double Recorder::next_time() const {
  return next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity();
}

std::span<const ContactPoint> Recorder::points_of(const Snapshot& now) {
  for (std::size_t k = 0; k < points_.size(); ++k)
    points_[k] = contact_point(*model_, now.q, now.v, k);
  return points_;
}

void Recorder::keep(const Snapshot& now, std::span<const ContactPoint> points) {
  last_t_ = now.t;
  std::copy_n(now.q, last_q_.size(), last_q_.begin());
  std::copy_n(now.v, last_v_.size(), last_v_.begin());
  for (std::size_t k = 0; k < points.size(); ++k) {
    ContactStatistics& own = statistics_.contacts[k];
    // A touch that lasts is counted only at its end.
    if (own.first_touch < 0.0 && now.contacts[k].mode == ContactMode::kFree) continue;
    own.passes.follow(points[k].d, now.t);
  }
}

void Recorder::look_at_energy() {
  meet_energy(energy(*model_, last_t_, last_q_.data(), last_v_.data()));
}

void Recorder::meet_energy(double now) {
  Statistics& s = statistics_;
  s.energy_end = now;
  s.energy_scale = std::max(s.energy_scale, std::abs(now));
}

void Recorder::begin(const Snapshot& start) {
  const std::span<const ContactPoint> points = points_of(start);
  keep(start, points);
  meet_gaps(start.q);
  last_slip_ = points.front().slip;
  keyphasor_.begin(spin_angle(*model_, start.t, start.q));
  look_at_energy();
  statistics_.energy_start = statistics_.energy_end;
  while (next_time() <= start.t) row(start);
}

void Recorder::count_contact(double normal_impulse, double friction_impulse, double h, double begin,
                             bool impact) {
  Statistics& s = statistics_;
  s.touch(begin);
  const double force = normal_impulse / h;
  // During lasting contact an impact adds no time of its own.
  const double alone = impact ? std::max(0.0, h - lasted_) : h;
  s.contact_time += alone;
  if (impact)
    s.impact_time += alone;
  else
    lasted_ += h;
  window_.add(begin, normal_impulse);
  s.add(normal_impulse, friction_impulse, 0.0);
  s.force_square += force * force * h;
  s.peak_force = std::max(s.peak_force, force);
}

void Recorder::count_at(std::size_t contact, double begin, double h, double normal_impulse,
                        double friction_impulse, double friction_work) {
  ContactStatistics& own = statistics_.contacts[contact];
  own.touch(begin);
  own.contact_time += h;
  own.peak_force = std::max(own.peak_force, normal_impulse / h);
  own.add(normal_impulse, friction_impulse, friction_work);
}

void Recorder::count_further(std::size_t contact, double begin, double h, double normal_impulse,
                             double friction_impulse, double friction_work, double before) {
  count_at(contact, begin, h, normal_impulse, friction_impulse, friction_work);
  Statistics& s = statistics_;
  s.touch(begin);
  if (before == 0.0) s.contact_time += h;
  const double earlier = before / h, force = earlier + normal_impulse / h;
  s.force_square += (force * force - earlier * earlier) * h;
  s.peak_force = std::max(s.peak_force, force);
  window_.add(begin, normal_impulse);
  statistics_.add(normal_impulse, friction_impulse, friction_work);
}

void Recorder::count_gap(std::size_t contact, const ContactPoint& point) {
  Statistics& s = statistics_;
  s.meet_gap(point.gap);
  s.contacts[contact].meet_gap(point.gap);
  const double penetration = std::max(0.0, -point.gap);
  s.penetration_square += penetration * penetration * last_step_;
  if (s.first_touch >= 0.0) s.gap_rate_square += point.gap_rate * point.gap_rate * last_step_;
}

// The gaps of all contacts in a state that is shown.
void Recorder::meet_gaps(const double* q) {
  for (std::size_t k = 0; k < model_->auxiliary.size(); ++k) {
    const auto& contact = model_->auxiliary[k].contact;
    if (!contact) continue;
    const double gap = contact->clearance - separation(*model_, q, k).norm();
    statistics_.least_gap = std::min(statistics_.least_gap, gap);
    least_gaps_[k] = std::min(least_gaps_[k], gap);
  }
}

void Recorder::count(const StepFigures& f, double begin) {
  if (f.normal_impulse > 0.0)
    count_contact(f.normal_impulse, f.friction_impulse, f.h, begin, f.impact);
  statistics_.friction_work += f.friction_work;
  statistics_.contact_work += f.contact_work;
  statistics_.external_work += f.external_work;
}

void Recorder::move_to(const Snapshot& now, std::span<const ContactPoint> points, bool impact) {
  last_step_ = now.t - last_t_;
  rows_until(now, impact);
  passes_until(now, impact);
  if (switches_unbalance_)
    statistics_.external_work += switching_work(*model_, last_t_, now.t, now.q, now.v);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (model_->auxiliary[k].contact) count_gap(k, points[k]);
  }
  keep(now, points);
  lasted_ = 0.0;
}

void Recorder::advance(const Snapshot& now, std::span<const ContactPoint> points, bool impact) {
  const std::size_t row = next_;
  move_to(now, points, impact);
  constexpr std::int64_t kLook = 256;  // steps
  if (++steps_ % kLook == 0 || row != next_) look_at_energy();
}

void Recorder::step(const Snapshot& now, double normal_impulse, double friction_impulse,
                    const Impact* impact, const StepBalance& balance) {
  const std::span<const ContactPoint> points = points_of(now);
  const ContactPoint& point = points.front();
  const double slips = impact ? impact->slip_before + impact->slip_after : last_slip_ + point.slip;
  StepFigures figures;
  figures.h = now.t - last_t_;
  figures.normal_impulse = normal_impulse;
  figures.friction_impulse = friction_impulse;
  if (normal_impulse > 0.0) {
    figures.friction_work = 0.5 * friction_impulse * slips;
    count_at(0, last_t_, figures.h, normal_impulse, friction_impulse, figures.friction_work);
  }
  figures.contact_work = balance.contact_work;
  figures.impact = impact != nullptr;
  count(figures, last_t_);
  move_to(now, points, figures.impact);
  statistics_.external_work += balance.external_work;
  meet_energy(balance.energy);
  last_slip_ = point.slip;
}

// State at the fraction s of the step; linear if there is an impact.
void Recorder::interpolate(const Snapshot& now, double s, bool impact) {
  const double h = now.t - last_t_, s2 = s * s, s3 = s2 * s;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    const double q0 = last_q_[i], q1 = now.q[i], v0 = last_v_[i], v1 = now.v[i];
    q_[i] = impact ? q0 + s * (q1 - q0)
                   : (2 * s3 - 3 * s2 + 1) * q0 + (s3 - 2 * s2 + s) * h * v0 +
                         (3 * s2 - 2 * s3) * q1 + (s3 - s2) * h * v1;
    v_[i] = v0 + s * (v1 - v0);
  }
}

void Recorder::passes_until(const Snapshot& now, bool impact) {
  const double end = spin_angle(*model_, now.t, now.q), h = now.t - last_t_;
  keyphasor_.follow(end, [&](double mark) {
    const auto time = [&](double s) { return last_t_ + s * h; };
    const auto angle = [&](double s) {
      interpolate(now, s, impact);
      return spin_angle(*model_, time(s), q_.data());
    };
    const auto rate = [&](double) { return h * spin_speed(*model_, v_.data()); };
    const double s = share_at(mark, angle, rate);
    interpolate(now, s, impact);
    return keyphasor_pass(*model_, time(s), q_.data(), v_.data());
  });
}

// Adds the rows in (last, now]: the exact state at the step's own time, else an interpolated one.
void Recorder::rows_until(const Snapshot& now, bool impact) {
  const double h = now.t - last_t_;
  const double same = 1e-9 * h;  // a requested time this close to a step coincides with it
  while (next_time() <= now.t + same) {
    const double t = next_time(), s = (t - last_t_) / h;
    if (std::abs(now.t - t) <= same) {
      Snapshot exact = now;
      exact.t = t;
      row(exact);
      continue;
    }
    interpolate(now, s, impact);
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
  meet_gaps(now.q);
  resting_ = 0.0;
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    if (!m.auxiliary[k].contact) continue;
    const ContactSnapshot& at = now.contacts[k];
    if (at.mode != ContactMode::kFree)
      resting_ += at.normal_force * m.auxiliary[k].contact->clearance;
  }
  put_row(m, next_time(), now, columns_);
  ++next_;
}

void Recorder::count_episode(double begin, double lasted) {
  const bool several = model_->auxiliary.size() > 1, lasts = lasted > window();
  soft_ = soft_ || several;
  if (several && lasts) lasting_.push_back({begin, begin + lasted});
  if (!several && !lasts) statistics_.impact_time += lasted;
}

Trajectory Recorder::finish(const RunEnd& end) {
  if (steps_ > 0) look_at_energy();
  statistics_.energy_scale = std::max(statistics_.energy_scale, resting_);
  statistics_.window_impulse = window_.largest();
  for (std::size_t k = 0; k < statistics_.contacts.size(); ++k) {
    ContactStatistics& own = statistics_.contacts[k];
    own.least_gap = std::min(own.least_gap, least_gaps_[k]);
    if (own.first_touch >= 0.0) own.least_gap = std::min(own.least_gap, 0.0);
  }
  if (soft_)
    statistics_.impact_time = std::max(0.0, statistics_.contact_time - length_of_union(lasting_));
  statistics_.passes = std::ranges::max(statistics_.contacts, {}, [](const ContactStatistics& own) {
                         return own.passes.forward() + own.passes.backward();
                       }).passes;
  Trajectory t;
  t.end = end.end;
  t.steps = end.steps;
  t.status = end.status;
  t.message = end.message;
  t.contacts = model_->auxiliary.size();
  t.series = std::move(columns_);
  // With several contacts, an entry may arrive after later ones of other contacts, since a soft
  // contact reports an impact at its end.
  std::ranges::stable_sort(impacts_, {}, &Impact::t);
  std::ranges::stable_sort(events_, {}, &Event::t);
  t.impacts = std::move(impacts_);
  t.events = std::move(events_);
  t.keyphasor = keyphasor_.take();
  t.statistics = statistics_;
  return t;
}

}  // namespace rotorub
