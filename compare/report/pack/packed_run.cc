#include "compare/report/pack/packed_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/pack/gap_samples.h"

namespace rotorub {
namespace {

using Values = std::vector<double>;
using Columns = std::vector<Values>;

constexpr double kClearanceShare = 1.0 / 200.0;
constexpr double kLeastShare = 1e-6;  // of the largest: a tolerance is never 0

// Euclidean length over the components, a row.
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

class RunPacker {
 public:
  RunPacker(const scene::Scene& scene, const renders::Machine& machine, const Trajectory& run)
      : scene_(scene), machine_(machine), run_(run) {}

  PackedRun packed() {
    add_places();
    add_bends();
    add_angles();
    add_speeds();
    add_forces();
    add_mode();
    add_impacts();
    return std::move(packed_);
  }

 private:
  std::size_t rows() const { return run_.rows(); }
  Columns columns(const std::vector<std::string>& names) const {
    Columns all;
    for (const std::string& name : names) all.push_back(run_.column(name));
    return all;
  }
  bool has(const std::vector<std::string>& names) const {
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return run_.has(name); });
  }
  void add(const std::string& name, TrackKind kind, Columns values, Columns rates,
           Values tolerance) {
    packed_[name] =
        pack(kind, {run_.column("t"), std::move(values), std::move(rates), std::move(tolerance)});
  }
  void add_even(const std::string& name, TrackKind kind, Columns values, Columns rates,
                double tolerance) {
    const double least = kLeastShare * largest(lengths(values));
    const double bound = std::max({tolerance, least, 1e-300});
    add(name, kind, std::move(values), std::move(rates), Values(rows(), bound));
  }
  void add_force(const std::string& name, const std::vector<std::string>& names) {
    if (!has(names)) return;
    const Columns values = columns(names);
    add(name, TrackKind::kLinear, values, {}, force_tolerance(values));
  }

  void add_places() {
    add_even("rotor", TrackKind::kHermite, columns({"rotor_x", "rotor_y"}),
             columns({"rotor_vx", "rotor_vy"}), place_tolerance(scene_));
    if (scene_.first().stator ||
        (scene_.first().contact && !scene_.first().contact->offset.isZero(0.0))) {
      add_even("ring", TrackKind::kHermite, columns({"stator_x", "stator_y"}),
               columns({"stator_vx", "stator_vy"}), place_tolerance(scene_));
    }
    if (scene_.first().contact) {
      packed_["gap"] =
          pack(TrackKind::kHermite,
               gap_samples(run_, gap_tolerance(scene_.first().contact->clearance), kShare),
               run_.contact_model == "rigid");
    }
  }

  // The modes share the tolerance of the shaft evenly: their errors add up at worst.
  void add_bends() {
    const Eigen::Index modes = machine_.modes_x.cols();
    for (Eigen::Index k = 0; k < modes; ++k) {
      const double reach = std::max(machine_.modes_x.col(k).cwiseAbs().maxCoeff(),
                                    machine_.modes_y.col(k).cwiseAbs().maxCoeff());
      const auto n = k + 1;
      add_even(fmt::format("bend_{}", n), TrackKind::kHermite,
               columns({fmt::format("x_{}", n), fmt::format("y_{}", n)}),
               columns({fmt::format("vx_{}", n), fmt::format("vy_{}", n)}),
               place_tolerance(scene_) / (static_cast<double>(modes) * std::max(reach, 1e-12)));
    }
  }

  void add_angles() {
    add_even("spin", TrackKind::kHermite, columns({"spin_angle"}), columns({"spin_speed"}),
             kAngleTolerance);
    if (has({"ring_angle", "ring_speed"})) {
      add_even("ring_spin", TrackKind::kHermite, columns({"ring_angle"}), columns({"ring_speed"}),
               kAngleTolerance);
    }
    if (!run_.has("torsion_1")) return;
    // The twist at the contact: each torsion mode is 1 there.
    Values twist(rows(), 0.0);
    for (int k = 1; run_.has(fmt::format("torsion_{}", k)); ++k) {
      const Values& mode = run_.column(fmt::format("torsion_{}", k));
      for (std::size_t i = 0; i < rows(); ++i) twist[i] += mode[i];
    }
    const Values bound = force_tolerance({twist});
    add("torsion", TrackKind::kLinear, {std::move(twist)}, {}, bound);
  }

  void add_speeds() {
    for (const char* name : {"spin_speed", "ring_speed"}) {
      if (!run_.has(name)) continue;
      const Values& speed = run_.column(name);
      if (speed.empty()) continue;
      const auto [low, high] = std::minmax_element(speed.begin(), speed.end());
      add_even(name, TrackKind::kLinear, {speed}, {}, kShare * (*high - *low));
    }
  }

  void add_forces() {
    if (scene_.first().contact) {
      add_force("normal", {"normal_force"});
      add_force("friction", {"friction_force"});
    }
    add_force("control", {"control_x", "control_y"});
    add_force("current", {"current_1", "current_2"});
    add_force("motor_torque", {"motor_torque"});
  }

  // A knot where it changes.
  void add_mode() {
    if (!scene_.first().contact) return;
    const Values& mode = run_.column("mode");
    Samples samples;
    samples.value.resize(1);
    for (std::size_t i = 0; i < rows(); ++i) {
      if (i > 0 && mode[i] == mode[i - 1]) continue;
      samples.t.push_back(run_.column("t")[i]);
      samples.value[0].push_back(mode[i]);
      samples.tolerance.push_back(kSteps);
    }
    packed_["mode"] = pack(TrackKind::kHold, samples);
  }

  void add_impacts() {
    if (!scene_.first().contact) return;
    Samples samples;
    samples.value.resize(2);
    for (const Impact& impact : counted_impacts(run_)) {
      if (impact.normal_impulse <= 0.0) continue;
      samples.t.push_back(impact.t);
      samples.value[0].push_back(impact.normal_impulse);
      samples.value[1].push_back(impact.friction_impulse);
    }
    const double most = std::max(largest(samples.value[0]), 1e-300);
    samples.tolerance.assign(samples.t.size(), kImpulseShare * most);
    packed_["impacts"] = pack(TrackKind::kHold, samples);
  }

  static constexpr double kSteps = 4.0;          // a quantum of 1: whole numbers
  static constexpr double kImpulseShare = 4e-5;  // of the largest impulse: a quantum of 1e-5
  const scene::Scene& scene_;
  const renders::Machine& machine_;
  const Trajectory& run_;
  PackedRun packed_;
};

}  // namespace

double place_tolerance(const scene::Scene& scene) {
  if (!scene.first().contact || scene.first().contact->clearance <= 0.0) return kPlaceTolerance;
  return std::min(kPlaceTolerance, kClearanceShare * scene.first().contact->clearance);
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
