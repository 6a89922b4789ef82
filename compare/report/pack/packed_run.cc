#include "compare/report/pack/packed_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "native_model/trajectory/columns.h"

namespace rotorub {

namespace {

using Values = std::vector<double>;
using Columns = std::vector<Values>;

constexpr double kClearanceShare = 1.0 / 200.0;
constexpr double kAngleTolerance = 2e-3;  // rad
constexpr double kLeastShare = 1e-6;  // relative to the largest value, so that no tolerance is 0

// Euclidean length over the components in each row.
Values lengths(const Columns& components) {
  Values squares(components.front().size(), 0.0);
  for (const Values& column : components) {
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += column[i] * column[i];
  }
  for (double& square : squares) square = std::sqrt(square);
  return squares;
}

double largest(const Values& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// For each value the smaller of its size and of the range of the values within a 64th of the run
// before and after it.
Values size_or_range(const Values& values) {
  const std::size_t length = values.size() / 64 + 1, blocks = (values.size() - 1) / length + 1;
  Values low(blocks, 1e300), high(blocks, -1e300), result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i / length] = std::min(low[i / length], values[i]);
    high[i / length] = std::max(high[i / length], values[i]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t b = i / length, from = b > 0 ? b - 1 : 0, to = std::min(b + 1, blocks - 1);
    const double range =
        std::max({high[from], high[b], high[to]}) - std::min({low[from], low[b], low[to]});
    result.push_back(std::min(std::abs(values[i]), range));
  }
  return result;
}

// Rows of gap and gap rate. With the rigid law, every impact adds two rows with gap 0, one with the
// rate before it and one with the rate after it. The pieces between two bounces are then arcs that
// end at 0, however coarse the rows are. An impact of a soft contact is an episode that is visible
// in its rows. The tolerance of each row is the larger of `least` (m) and `kShare` of the gap or
// its range nearby (whichever is smaller), so that a gap that hardly changes is drawn as such.
Samples gap_samples(const Trajectory& run, std::size_t contact, double least) {
  const auto& t = run.column("t");
  const auto& gap = run.column(column_of_contact(contact, "gap"));
  const auto& rate = run.column(column_of_contact(contact, "gap_rate"));
  Samples samples{{}, {{}}, {{}}, {}};
  const auto put = [&](double at, double y, double dy) {
    samples.t.push_back(at);
    samples.value[0].push_back(y);
    samples.rate[0].push_back(dy);
  };
  std::vector<Impact> impacts;
  if (run.is_rigid()) impacts = counted_impacts(run, contact);
  std::size_t next = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    // A row at the time of an impact holds the state after it, so the impact precedes the row.
    for (; next < impacts.size() && impacts[next].t <= t[i]; ++next) {
      const Impact& impact = impacts[next];
      if (impact.t < t.front()) continue;
      put(impact.t, 0.0, impact.gap_rate_before);
      put(impact.t, 0.0, impact.gap_rate_after);
    }
    put(t[i], gap[i], rate[i]);
  }
  for (const double size : size_or_range(samples.value[0]))
    samples.tolerance.push_back(std::max(least, kShare * size));
  return samples;
}

// Uses the same names for the columns of a contact and for its tracks.
class RunPacker {
 public:
  RunPacker(const scene::Scene& scene, const renders::Machine& machine, const Trajectory& run)
      : scene_(scene), machine_(machine), run_(run), place_(place_tolerance(scene)) {}

  PackedRun packed() {
    add_even("spin", {"spin_angle"}, {"spin_speed"}, kAngleTolerance);
    add_speed("spin_speed");
    add_bends();
    add_twist();
    add_forces("motor_torque", {"motor_torque"});
    for (at_ = 0; at_ < scene_.auxiliary.size(); ++at_) add_contact(scene_.auxiliary[at_]);
    return std::move(packed_);
  }

 private:
  using Names = std::initializer_list<const char*>;

  // The column's name at the current contact; at the first contact the plain name.
  std::string own(const std::string& name) const { return column_of_contact(at_, name); }
  bool has(Names names) const {
    return std::all_of(names.begin(), names.end(),
                       [&](const char* name) { return run_.has(own(name)); });
  }
  Columns columns(Names names) const {
    Columns all;
    for (const char* name : names) all.push_back(run_.column(own(name)));
    return all;
  }
  void add(const std::string& name, TrackKind kind, Columns values, Columns rates,
           Values tolerance) {
    packed_[own(name)] =
        pack(kind, {run_.column("t"), std::move(values), std::move(rates), std::move(tolerance)});
  }
  // With a constant tolerance; cubic if rates are given, otherwise linear.
  void add_even(const std::string& name, Names values, Names rates, double tolerance) {
    const Columns column = columns(values);
    const double least = kLeastShare * largest(lengths(column));
    const double bound = std::max({tolerance, least, 1e-300});
    add(name, rates.size() > 0 ? TrackKind::kHermite : TrackKind::kLinear, column, columns(rates),
        Values(run_.rows(), bound));
  }
  void add_forces(const std::string& name, Names names) {
    if (!has(names)) return;
    const Columns values = columns(names);
    add(name, TrackKind::kLinear, values, {}, force_tolerance(values));
  }
  void add_speed(const char* name) {
    add_even(name, {name}, {}, range_tolerance(run_.column(own(name))));
  }

  // The modes share the shaft's tolerance evenly, because their errors may add up.
  void add_bends() {
    const Eigen::Index modes = machine_.modes_x.cols();
    for (Eigen::Index k = 0; k < modes; ++k) {
      const double reach = std::max(machine_.modes_x.col(k).cwiseAbs().maxCoeff(),
                                    machine_.modes_y.col(k).cwiseAbs().maxCoeff());
      const std::string n = std::to_string(k + 1);
      const std::string x = "x_" + n, y = "y_" + n, vx = "vx_" + n, vy = "vy_" + n;
      add_even("bend_" + n, {x.c_str(), y.c_str()}, {vx.c_str(), vy.c_str()},
               place_ / (static_cast<double>(modes) * std::max(reach, 1e-12)));
    }
  }

  // The twist at the first contact, where each torsion mode is 1.
  void add_twist() {
    if (!run_.has("torsion_1")) return;
    Values twist(run_.rows(), 0.0);
    for (int k = 1; run_.has("torsion_" + std::to_string(k)); ++k) {
      const Values& mode = run_.column("torsion_" + std::to_string(k));
      for (std::size_t i = 0; i < twist.size(); ++i) twist[i] += mode[i];
    }
    const Values bound = force_tolerance({twist});
    add("torsion", TrackKind::kLinear, {std::move(twist)}, {}, bound);
  }

  void add_contact(const scene::AuxiliaryBearing& bearing) {
    add_even("rotor", {"rotor_x", "rotor_y"}, {"rotor_vx", "rotor_vy"}, place_);
    if (bearing.stator || (bearing.contact && !bearing.contact->offset.isZero(0.0)))
      add_even("ring", {"stator_x", "stator_y"}, {"stator_vx", "stator_vy"}, place_);
    if (has({"ring_angle", "ring_speed"})) {
      add_even("ring_spin", {"ring_angle"}, {"ring_speed"}, kAngleTolerance);
      add_speed("ring_speed");
    }
    add_forces("control", {"control_x", "control_y"});
    add_forces("current", {"current_1", "current_2"});
    if (!bearing.contact) return;
    add_forces("normal", {"normal_force"});
    add_forces("friction", {"friction_force"});
    const Samples gap = gap_samples(run_, at_, gap_tolerance(bearing.contact->clearance));
    packed_[own("gap")] = pack(TrackKind::kHermite, gap, run_.is_rigid());
    // The slope of the gap's track is no substitute: where a step in MuJoCo puts an impact a little
    // off the arc of its rows, the track between the two is steep.
    packed_[own("gap_rate")] =
        pack(TrackKind::kLinear, {gap.t, gap.rate, {}, force_tolerance(gap.rate)});
    add_mode();
    add_impacts();
  }

  // One knot per change.
  void add_mode() {
    const Values& mode = run_.column(own("mode"));
    Samples samples;
    samples.value.resize(1);
    for (std::size_t i = 0; i < mode.size(); ++i) {
      if (i > 0 && mode[i] == mode[i - 1]) continue;
      samples.t.push_back(run_.column("t")[i]);
      samples.value[0].push_back(mode[i]);
      samples.tolerance.push_back(kSteps);
    }
    packed_[own("mode")] = pack(TrackKind::kHold, samples);
  }

  void add_impacts() {
    Samples samples;
    samples.value.resize(2);
    for (const Impact& impact : counted_impacts(run_, at_)) {
      if (impact.normal_impulse <= 0.0) continue;
      samples.t.push_back(impact.t);
      samples.value[0].push_back(impact.normal_impulse);
      samples.value[1].push_back(impact.friction_impulse);
    }
    const double most = std::max(largest(samples.value[0]), 1e-300);
    samples.tolerance.assign(samples.t.size(), kImpulseShare * most);
    packed_[own("impacts")] = pack(TrackKind::kHold, samples);
  }

  static constexpr double kSteps = 4.0;  // gives a quantum of 1, for whole numbers
  // Relative to the largest impulse: gives a quantum of 1e-5.
  static constexpr double kImpulseShare = 4e-5;
  const scene::Scene& scene_;
  const renders::Machine& machine_;
  const Trajectory& run_;
  double place_;        // m
  std::size_t at_ = 0;  // the current contact
  PackedRun packed_;
};

}  // namespace

std::vector<Impact> counted_impacts(const Trajectory& run, std::size_t contact) {
  std::vector<Impact> impacts;
  std::copy_if(
      run.impacts.begin(), run.impacts.end(), std::back_inserter(impacts),
      [&](const Impact& i) { return counts(i) && i.contact == static_cast<int>(contact); });
  std::stable_sort(impacts.begin(), impacts.end(),
                   [](const Impact& a, const Impact& b) { return a.t < b.t; });
  return impacts;
}

double place_tolerance(const scene::Scene& scene) {
  double tolerance = kPlaceTolerance;
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    if (!bearing.contact || bearing.contact->clearance <= 0.0) continue;
    tolerance = std::min(tolerance, kClearanceShare * bearing.contact->clearance);
  }
  return tolerance;
}

double gap_tolerance(double clearance) {
  constexpr double kFinest = 30e-9, kShareOfClearance = 6e-5;
  return clearance > 0.0 ? std::min(kFinest, kShareOfClearance * clearance) : kFinest;
}

std::vector<double> force_tolerance(const std::vector<std::vector<double>>& components) {
  Values tolerance = lengths(components);
  double sum = 0.0;
  std::size_t count = 0;
  for (const double force : tolerance) {
    sum += force;
    if (force > 0.0) ++count;
  }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 1.0;
  for (double& force : tolerance) force = kShare * std::max(force, mean);
  return tolerance;
}

double range_tolerance(const std::vector<double>& value) {
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  return kShare * (*high - *low);
}

PackedRun pack_run(const scene::Scene& scene, const renders::Machine& machine,
                   const Trajectory& trajectory) {
  if (trajectory.rows() == 0) return {};
  return RunPacker(scene, machine, trajectory).packed();
}

nlohmann::json packed_run_json(const PackedRun& run) {
  nlohmann::json tracks = nlohmann::json::object();
  for (const auto& [name, track] : run) tracks[name] = track_json(track);
  return tracks;
}

}  // namespace rotorub
