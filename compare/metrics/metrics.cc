#include "compare/metrics/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "compare/metrics/rows.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

// From the rms of v_t over the rows in contact: a disc that moves along the tangent of a ring with
// curvature 1/delta_0 for one step ends (v_t dt)^2 / (2 delta_0) beyond it.
double whirl_penetration(const Trajectory& trajectory, std::size_t contact, double clearance) {
  const auto points = relative_motion(trajectory, contact);
  const auto& normal = trajectory.column(column_of_contact(contact, "normal_force"));
  double square = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (normal[i] <= 0.0) continue;
    square += points[i].whirl_speed * points[i].whirl_speed;
    ++count;
  }
  if (count == 0) return 0.0;
  const double mean_square = square / static_cast<double>(count);
  return mean_square * trajectory.step * trajectory.step / (2.0 * clearance);
}

void gather_forces(const Trajectory& trajectory, Metrics& m) {
  const Statistics& s = trajectory.statistics;
  if (s.first_touch < 0.0) return;
  m.first_touch = s.first_touch;
  const double span = trajectory.end - s.first_touch;
  if (span <= 0.0) return;
  m.mean_force = trajectory.mean_force();
  const double variance = s.force_square / span - m.mean_force * m.mean_force;
  m.force_deviation = std::sqrt(std::max(0.0, variance));
  m.gap_rate_rms = std::sqrt(s.gap_rate_square / span);
  m.rms_penetration = std::sqrt(s.penetration_square / span);
}

// Mean over the last part of the run; empty for a prescribed speed.
std::optional<double> free_speed(const Trajectory& run, const std::string& angle,
                                 const std::string& speed, double from) {
  if (!run.has(speed) || run.rows() < 2) return std::nullopt;
  const auto [least, most] =
      std::minmax_element(run.column(speed).begin(), run.column(speed).end());
  if (*least == *most) return std::nullopt;
  return mean_speed(run, angle, speed, from);
}

// Mean speed of the ring that turns fastest; empty if no ring turns freely.
std::optional<double> ring_speed(const Trajectory& run, double from) {
  std::optional<double> fastest;
  for (std::size_t k = 0; k < run.contacts; ++k) {
    const auto own = free_speed(run, column_of_contact(k, "ring_angle"),
                                column_of_contact(k, "ring_speed"), from);
    if (own && (!fastest || std::abs(*own) > std::abs(*fastest))) fastest = own;
  }
  return fastest;
}

// The weight of a row in a mean over time, from its neighbours' times t (s). Equally spaced rows
// have equal weights.
double weight_of_row(const std::vector<double>& t, std::size_t row) {
  const std::size_t last = t.size() - 1;
  if (last == 0) return 1.0;
  if (row == 0) return 2.0 * (t[1] - t[0]);
  return row == last ? 2.0 * (t[last] - t[last - 1]) : t[row + 1] - t[row - 1];
}

// Rms force of the actuator that has the largest one, over the time of the rows, which need not be
// equally spaced; empty without actuators.
std::optional<double> rms_control(const Trajectory& trajectory) {
  std::optional<double> largest;
  for (std::size_t k = 0; trajectory.rows() > 0 && k < trajectory.contacts; ++k) {
    const std::string along_x = column_of_contact(k, "control_x");
    if (!trajectory.has(along_x)) continue;
    const auto &x = trajectory.column(along_x),
               &y = trajectory.column(column_of_contact(k, "control_y"));
    const auto square = [&](std::size_t i) { return x[i] * x[i] + y[i] * y[i]; };
    const auto& t = trajectory.column("t");
    double sum = 0.0, total = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double weight = weight_of_row(t, i);
      sum += weight * square(i);
      total += weight;
    }
    largest = std::max(largest.value_or(0.0), std::sqrt(sum / total));
  }
  return largest;
}

void gather_impacts(const Trajectory& trajectory, Metrics& m) {
  double fastest = 0.0;
  for (const Impact& impact : trajectory.impacts) {
    m.impacts += counts(impact) ? 1 : 0;
    m.peak_impulse = std::max(m.peak_impulse, impact.normal_impulse);
    fastest = std::max(fastest, -impact.gap_rate_before);
  }
  for (const Impact& impact : trajectory.impacts) {
    const bool hard = -impact.gap_rate_before > kHardShare * fastest;
    m.hard_impacts += counts(impact) && hard ? 1 : 0;
  }
}

}  // namespace

std::vector<ContactFacts> contact_facts(const scene::Scene& scene) {
  std::vector<ContactFacts> facts;
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    if (!bearing.contact) continue;
    const scene::Contact& c = *bearing.contact;
    facts.push_back({c.clearance, c.radius, c.friction, c.compression_time + c.expansion_time,
                     c.compliance.has_value()});
  }
  return facts;
}

Metrics totals(const Trajectory& trajectory) {
  const Statistics& s = trajectory.statistics;
  Metrics m;
  gather_forces(trajectory, m);
  gather_impacts(trajectory, m);
  m.peak_force = s.peak_force;
  m.contact_fraction = trajectory.contact_fraction();
  if (s.contact_time > 0.0) {
    constexpr double kUnseen = 1e-9;  // round-off in the sum of two times
    const double lasting = 1.0 - s.impact_time / s.contact_time;
    m.lasting_fraction = lasting > kUnseen ? lasting * m.contact_fraction : 0.0;
  }
  // Rigid laws are compared by their impacts, soft contacts with native by the window.
  if (trajectory.is_rigid()) m.impact_impulse = m.peak_impulse;
  if (!trajectory.is_rigid() || trajectory.engine == "native") m.window_impulse = s.window_impulse;
  m.impulse_total = s.impulse_total;
  m.friction_impulse = s.friction_impulse;
  m.friction_work = s.friction_work;
  m.max_penetration = s.max_penetration;
  m.forward_passes = s.passes.forward();
  m.backward_passes = s.passes.backward();
  m.whirl_time = s.passes.time();
  m.energy_residual = s.energy_residual();
  if (std::isfinite(s.least_gap))
    m.least_gap = s.first_touch >= 0.0 ? std::min(0.0, s.least_gap) : s.least_gap;
  m.end = trajectory.end;
  m.step = trajectory.step;
  m.steps = trajectory.steps;
  m.wall_s = trajectory.wall_s;
  if (m.steps > 0) m.us_per_step = 1e6 * m.wall_s / static_cast<double>(m.steps);
  if (m.wall_s > 0.0) m.real_time_factor = m.end / m.wall_s;
  return m;
}

namespace {

// N, of the compliant contacts: the load on the ring of a catcher bearing.
double largest_force(const Statistics& s, const std::vector<ContactFacts>& contacts) {
  double largest = 0.0;
  for (std::size_t k = 0; k < s.contacts.size(); ++k) {
    if (contacts[k].is_compliant) largest = std::max(largest, s.contacts[k].peak_force);
  }
  return largest;
}

}  // namespace

DeepestPenetration deepest_penetration(const Statistics& s,
                                       const std::vector<ContactFacts>& contacts) {
  assert(!contacts.empty());
  DeepestPenetration deepest;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactStatistics& own = s.contacts[k];
    const double share = own.max_penetration / contacts[k].clearance;
    if (k == 0 || share > deepest.share) deepest = {k, own.max_penetration, share};
  }
  return deepest;
}

Metrics metrics(const Trajectory& trajectory, const std::vector<ContactFacts>& contacts) {
  Metrics m = totals(trajectory);
  if (std::any_of(contacts.begin(), contacts.end(),
                  [](const ContactFacts& c) { return c.is_compliant; })) {
    m.contact_peak = largest_force(trajectory.statistics, contacts);
    m.contact_depth = m.max_penetration;
    m.contact_time = trajectory.statistics.contact_time;
  }
  m.settled = settled(trajectory);
  m.spin_speed = free_speed(trajectory, "spin_angle", "spin_speed", m.settled.from);
  m.ring_speed = ring_speed(trajectory, m.settled.from);
  m.control_force = rms_control(trajectory);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    m.whirl_penetration =
        std::max(m.whirl_penetration, whirl_penetration(trajectory, k, contacts[k].clearance));
  }
  m.residuals = largest_residuals(trajectory, contacts);
  return m;
}

}  // namespace rotorub
