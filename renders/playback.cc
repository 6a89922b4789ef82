#include "renders/playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "native_model/numerics/hermite.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::renders {

namespace {

const std::vector<double>& need(const Trajectory& trajectory, const std::string& name) {
  if (!trajectory.has(name)) {
    throw std::runtime_error(fmt::format("the series has no column `{}`", name));
  }
  const std::vector<double>& values = trajectory.column(name);
  if (values.empty() || values.size() != trajectory.rows()) {
    throw std::runtime_error(fmt::format("the series has no values in column `{}`", name));
  }
  return values;
}

Eigen::Vector2d direction(const Eigen::Vector2d& d) {
  const double length = d.norm();
  return length > 0.0 ? Eigen::Vector2d(d / length) : Eigen::Vector2d::Zero();
}

}  // namespace

std::optional<double> first_touch(const Trajectory& trajectory) {
  std::optional<double> first;
  const auto earlier = [&first](double t) { first = std::min(first.value_or(t), t); };
  if (trajectory.statistics.first_touch >= 0.0) earlier(trajectory.statistics.first_touch);
  // A run read from its folder has no statistics.
  if (!trajectory.impacts.empty()) earlier(trajectory.impacts.front().t);
  if (!trajectory.has("normal_force")) return first;
  const auto& force = trajectory.column("normal_force");
  const auto row = std::find_if(force.begin(), force.end(), [](double f) { return f > 0.0; });
  if (row != force.end())
    earlier(trajectory.column("t")[static_cast<std::size_t>(row - force.begin())]);
  return first;
}

Eigen::Vector2d Pose::e_r() const { return direction(rotor - stator); }

Playback::Playback(const Trajectory& trajectory, std::size_t contact)
    : Playback(trajectory, contact,
               [contact](const char* name) { return column_of_contact(contact, name); }) {}

template <class Of>
Playback::Playback(const Trajectory& trajectory, std::size_t contact, const Of& of)
    : trajectory_(&trajectory),
      time_(&need(trajectory, "t")),
      gap_(&need(trajectory, of("gap"))),
      normal_(&need(trajectory, of("normal_force"))),
      friction_(&need(trajectory, of("friction_force"))),
      mode_(&need(trajectory, of("mode"))),
      rotor_{track(of("rotor_x"), of("rotor_vx")), track(of("rotor_y"), of("rotor_vy"))},
      stator_{track(of("stator_x"), of("stator_vx")), track(of("stator_y"), of("stator_vy"))},
      spin_(track("spin_angle", "spin_speed")) {
  for (int i = 1; trajectory.has(fmt::format("x_{}", i)); ++i) {
    modes_.push_back({track(fmt::format("x_{}", i), fmt::format("vx_{}", i)),
                      track(fmt::format("y_{}", i), fmt::format("vy_{}", i))});
  }
  if (trajectory.has(of("ring_angle"))) ring_ = track(of("ring_angle"), of("ring_speed"));
  if (trajectory.has(of("control_x")))
    control_ = {track(of("control_x"), ""), track(of("control_y"), "")};
  if (trajectory.has(of("current_1")))
    current_ = {track(of("current_1"), ""), track(of("current_2"), "")};
  if (!std::is_sorted(time_->begin(), time_->end())) {
    throw std::runtime_error("the times of the series do not ascend");
  }
  for (const Impact& impact : trajectory.impacts) {
    if (!counts(impact) || static_cast<std::size_t>(impact.contact) != contact) continue;
    strikes_.push_back({impact.t, impact.normal_impulse, {1.0, 0.0}});
  }
  std::stable_sort(strikes_.begin(), strikes_.end(),
                   [](const Strike& a, const Strike& b) { return a.t < b.t; });
  for (Strike& strike : strikes_) strike.e_r = at(strike.t).e_r();
}

Playback::Track Playback::track(const std::string& value, const std::string& rate) const {
  return {&need(*trajectory_, value), trajectory_->has(rate) ? &need(*trajectory_, rate) : nullptr};
}

std::size_t Playback::row_before(double t) const {
  const auto after = std::upper_bound(time_->begin(), time_->end(), t);
  return after == time_->begin() ? 0 : static_cast<std::size_t>(after - time_->begin()) - 1;
}

bool Playback::impact_between(double from, double to) const {
  const auto first =
      std::lower_bound(strikes_.begin(), strikes_.end(), from,
                       [](const Strike& strike, double time) { return strike.t < time; });
  return first != strikes_.end() && first->t <= to;
}

double Playback::interpolate(const Track& track, std::size_t row, double t, bool smooth) const {
  const Values& value = *track.value;
  if (row + 1 >= value.size()) return value[row];
  const double from = (*time_)[row];
  const double h = (*time_)[row + 1] - from;
  if (h <= 0.0) return value[row + 1];
  const double s = (t - from) / h;
  if (smooth && track.rate != nullptr) {
    return hermite(value[row], (*track.rate)[row], value[row + 1], (*track.rate)[row + 1], h, s);
  }
  return (1.0 - s) * value[row] + s * value[row + 1];
}

double Playback::whirl(std::size_t row) const {
  Eigen::Vector2d d, v;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!rotor_[k].rate || !stator_[k].rate) return 0.0;
    const auto axis = static_cast<Eigen::Index>(k);
    d[axis] = (*rotor_[k].value)[row] - (*stator_[k].value)[row];
    v[axis] = (*rotor_[k].rate)[row] - (*stator_[k].rate)[row];
  }
  const double square = d.squaredNorm();
  return square > 0.0 ? (d[0] * v[1] - d[1] * v[0]) / square : 0.0;
}

std::pair<std::size_t, std::size_t> Playback::rows_of(double from, double to) const {
  const std::size_t first = row_before(from);
  std::size_t end = first;
  while (end + 1 < time_->size() && (*time_)[end] <= to) ++end;
  return {first, end};
}

double Playback::median_whirl(double from, double to) const {
  const auto [first, end] = rows_of(from, to);
  std::vector<double> whirls;
  for (std::size_t row = first; row < end; ++row) whirls.push_back(whirl(row));
  if (whirls.empty()) return 0.0;
  const auto middle = whirls.begin() + static_cast<std::ptrdiff_t>(whirls.size() / 2);
  std::nth_element(whirls.begin(), middle, whirls.end());
  return *middle;
}

double Playback::closest(double from, double to) const {
  const auto [first, end] = rows_of(from, to);
  const auto at = [this](std::size_t row) {
    return gap_->begin() + static_cast<std::ptrdiff_t>(row);
  };
  return (
      *time_)[static_cast<std::size_t>(std::min_element(at(first), at(end) + 1) - gap_->begin())];
}

std::optional<Strobe> Playback::strobe(double from, double to, double spacing) const {
  const auto [first, end] = rows_of(from, to);
  if (first == end) return std::nullopt;
  const double apart = ((*time_)[end] - (*time_)[first]) / static_cast<double>(end - first);
  const Strobe strobe{median_whirl(from, to), std::max(spacing, apart)};
  const double turn = std::abs(strobe.whirl) * strobe.spacing;
  if (turn * kPointsOfATurn <= 2.0 * std::numbers::pi) return std::nullopt;
  return strobe;
}

Pose Playback::at(double t) const {
  Pose pose;
  pose.t = std::clamp(t, start(), end());
  const std::size_t row = row_before(pose.t);
  const std::size_t next = std::min(row + 1, time_->size() - 1);
  const double turned = whirl(row) * ((*time_)[next] - (*time_)[row]);
  const bool smooth = !impact_between((*time_)[row], (*time_)[next]) &&
                      std::abs(turned) * kPointsOfATurn <= 2.0 * std::numbers::pi;
  const auto value = [&](const Track& track) { return interpolate(track, row, pose.t, smooth); };

  const auto pair = [&](const Pair& p) { return Eigen::Vector2d(value(p[0]), value(p[1])); };
  pose.rotor = pair(rotor_);
  pose.stator = pair(stator_);
  pose.spin_angle = value(spin_);
  if (ring_) pose.ring_angle = value(*ring_);
  pose.x.resize(modes());
  pose.y.resize(modes());
  for (int i = 0; i < modes(); ++i) {
    const Eigen::Vector2d bend = pair(modes_[static_cast<std::size_t>(i)]);
    pose.x[i] = bend[0];
    pose.y[i] = bend[1];
  }
  if (control_) pose.control = pair(*control_);
  if (current_) pose.current = pair(*current_);
  pose.gap = interpolate({gap_, nullptr}, row, pose.t, false);

  // Forces are interpolated within one contact, and otherwise keep the value of the row before.
  pose.mode = static_cast<ContactMode>(std::lround((*mode_)[row]));
  const bool lasting = pose.mode != ContactMode::kFree && (*mode_)[next] > 0.0;
  pose.normal_force =
      lasting ? interpolate({normal_, nullptr}, row, pose.t, false) : (*normal_)[row];
  pose.friction_force =
      lasting ? interpolate({friction_, nullptr}, row, pose.t, false) : (*friction_)[row];
  return pose;
}

double Playback::largest(const std::optional<Pair>& pair, double from, double to) const {
  double result = 0.0;
  for (std::size_t i = 0; pair && i < time_->size(); ++i) {
    if ((*time_)[i] < from || (*time_)[i] > to) continue;
    result = std::max(result, std::hypot((*(*pair)[0].value)[i], (*(*pair)[1].value)[i]));
  }
  return result;
}

template <class Taken>
double Playback::quantile_of(const Values& values, double quantile, double from, double to,
                             const Taken& taken) const {
  Values found;
  for (std::size_t i = 0; i < time_->size(); ++i) {
    if ((*time_)[i] >= from && (*time_)[i] <= to && taken(i)) found.push_back(values[i]);
  }
  if (found.empty()) return 0.0;
  const double place = quantile * static_cast<double>(found.size() - 1);
  const auto nth = found.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(found.begin(), nth, found.end());
  return *nth;
}

double Playback::force_quantile(double quantile, double from, double to) const {
  return quantile_of(*normal_, quantile, from, to,
                     [this](std::size_t i) { return (*normal_)[i] > 0.0; });
}

double Playback::gap_quantile(double quantile, double from, double to) const {
  return quantile_of(*gap_, quantile, from, to, [](std::size_t) { return true; });
}

}  // namespace rotorub::renders
