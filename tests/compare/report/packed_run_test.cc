// Runs as the player gets them: the accuracy of every quantity, at every row of the run.
#include "compare/report/pack/packed_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/engine/engine.h"
#include "compare/report/plots.h"
#include "compare/study/scene_comparison.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/recorder.h"
#include "tests/compare/report/unpacked_track.h"
#include "tests/support/native_run.h"
#include "tests/support/two_catchers.h"

namespace rotorub {
namespace {

using test::UnpackedTrack;

constexpr double kRound = 1.0 + 1e-9;

struct Packed {
  scene::Scene scene;
  Trajectory run;
  PackedRun tracks;
  renders::Machine machine;
};

Packed packed(scene::Scene scene, Trajectory run) {
  const ShownRuns shown{&scene, {{"native", &run}}, nullptr};
  const renders::Machine machine = *drawn_machine(shown);
  PackedRun tracks = pack_run(scene, machine, run);
  return {std::move(scene), std::move(run), std::move(tracks), machine};
}

// Rows as in a report: dense, but at most 50,000.
Packed packed_run(const Engine& engine, const scene::Scene& scene) {
  RunRequest request;
  request.output_times = dense_times(scene.run, 50000);
  return packed(scene, engine.run(scene, request));
}

std::string of(std::size_t contact, const char* name) { return column_of_contact(contact, name); }

void expect_places(const Packed& p, const std::string& track, const std::string& x,
                   const std::string& y) {
  const UnpackedTrack unpacked(p.tracks.at(track));
  const auto& t = p.run.column("t");
  double worst = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    worst = std::max(worst, std::hypot(unpacked.at(t[i], 0) - p.run.column(x)[i],
                                       unpacked.at(t[i], 1) - p.run.column(y)[i]));
  }
  EXPECT_LE(worst, kPlaceTolerance * kRound) << track;
}

// 1 % of the force, or of the mean over the rows with one; this is computed independently of the
// packer.
void expect_forces(const Packed& p, const std::string& track,
                   const std::vector<std::string>& names) {
  const UnpackedTrack unpacked(p.tracks.at(track));
  const auto& t = p.run.column("t");
  std::vector<double> force(t.size()), error(t.size());
  double sum = 0.0, rows = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (std::size_t c = 0; c < names.size(); ++c) {
      const double value = p.run.column(names[c])[i];
      force[i] = std::hypot(force[i], value);
      error[i] = std::hypot(error[i], unpacked.at(t[i], c) - value);
    }
    sum += force[i];
    if (force[i] > 0.0) rows += 1.0;
  }
  const double mean = rows > 0.0 ? sum / rows : 1.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_LE(error[i], 0.01 * std::max(force[i], mean) * kRound) << track << " at " << t[i];
  }
}

// The bent shaft at every station that is drawn: the sum of all modes, as the page takes it.
void expect_shaft(const Packed& p) {
  std::vector<UnpackedTrack> modes;
  for (Eigen::Index k = 0; k < p.machine.modes_x.cols(); ++k) {
    modes.emplace_back(p.tracks.at("bend_" + std::to_string(k + 1)));
  }
  const auto& t = p.run.column("t");
  double worst = 0.0;
  for (std::size_t i = 0; i < t.size(); i += 7) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(p.machine.z.size()), y = x;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const std::string n = std::to_string(k + 1);
      x += p.machine.modes_x.col(static_cast<Eigen::Index>(k)) *
           (modes[k].at(t[i], 0) - p.run.column("x_" + n)[i]);
      y += p.machine.modes_y.col(static_cast<Eigen::Index>(k)) *
           (modes[k].at(t[i], 1) - p.run.column("y_" + n)[i]);
    }
    worst = std::max(worst, (x.array().square() + y.array().square()).maxCoeff());
  }
  EXPECT_LE(std::sqrt(worst), kPlaceTolerance * kRound);
}

void expect_gap(const Packed& p, std::size_t contact = 0) {
  const UnpackedTrack unpacked(p.tracks.at(of(contact, "gap")));
  const double least = std::min(30e-9, 6e-5 * p.scene.auxiliary[contact].contact->clearance);
  const auto& t = p.run.column("t");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double gap = p.run.column(of(contact, "gap"))[i];
    ASSERT_NEAR(unpacked.at(t[i], 0), gap, std::max(least, 0.01 * std::abs(gap)) * kRound) << t[i];
  }
}

// At the rows, and between them never more than at the rows and impacts beside.
void expect_gap_rate(const Packed& p, std::size_t contact) {
  const UnpackedTrack unpacked(p.tracks.at(of(contact, "gap_rate")));
  const auto& t = p.run.column("t");
  const auto& rate = p.run.column(of(contact, "gap_rate"));
  double most = 0.0;
  for (const double value : rate) most = std::max(most, std::abs(value));
  for (const Impact& impact : counted_impacts(p.run, contact)) {
    if (p.run.is_rigid()) most = std::max(most, std::abs(impact.gap_rate_before));
  }
  const double tolerance = 0.01 * most * kRound;
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_NEAR(unpacked.at(t[i], 0), rate[i], tolerance) << t[i];
    for (int part = 1; i + 1 < t.size() && part < 10; ++part) {
      const double at = t[i] + 0.1 * part * (t[i + 1] - t[i]);
      ASSERT_LE(std::abs(unpacked.at(at, 0)), most + tolerance) << at;
    }
  }
}

void expect_modes(const Packed& p, std::size_t contact) {
  const UnpackedTrack unpacked(p.tracks.at(of(contact, "mode")));
  const auto& t = p.run.column("t");
  for (std::size_t i = 0; i < t.size(); ++i)
    ASSERT_EQ(unpacked.at(t[i], 0), p.run.column(of(contact, "mode"))[i]) << t[i];
}

void expect_all(const Packed& p) {
  if (p.scene.rotor.geometry) expect_shaft(p);
  for (std::size_t k = 0; k < p.scene.auxiliary.size(); ++k) {
    expect_places(p, of(k, "rotor"), of(k, "rotor_x"), of(k, "rotor_y"));
    if (p.scene.auxiliary[k].stator)
      expect_places(p, of(k, "ring"), of(k, "stator_x"), of(k, "stator_y"));
    expect_gap(p, k);
    expect_gap_rate(p, k);
    expect_modes(p, k);
    expect_forces(p, of(k, "normal"), {of(k, "normal_force")});
    expect_forces(p, of(k, "friction"), {of(k, "friction_force")});
    if (p.run.has(of(k, "control_x")))
      expect_forces(p, of(k, "control"), {of(k, "control_x"), of(k, "control_y")});
    if (p.run.has(of(k, "current_1")))
      expect_forces(p, of(k, "current"), {of(k, "current_1"), of(k, "current_2")});
  }
}

std::size_t bytes(const PackedRun& tracks) {
  std::size_t sum = 0;
  for (const auto& [name, track] : tracks) sum += track.bytes.size();
  return sum;
}

// A bouncing rotor with eight modes, from before its touch: hundreds of impacts.
TEST(PackedRun, KeepsABouncingRotor) {
  const scene::Scene scene = test::shipped("paper_passive", {"run.end=0.2"});
  const Packed p = packed_run(*native_engine(scene::Integrator::kEvent), scene);
  ASSERT_GT(p.run.impacts.size(), 50U);
  expect_all(p);
  EXPECT_LT(bytes(p.tracks), p.run.rows() * p.run.series.size() * 8 / 20)
      << "a twentieth of the rows";
}

// Each of two contacts has its own positions, gap and impacts.
TEST(PackedRun, KeepsEachContact) {
  const scene::Scene scene = test::segments_in_two_catchers();
  const Packed p = packed_run(*native_engine(scene::Integrator::kEvent), scene);
  expect_all(p);
  const UnpackedTrack first(p.tracks.at("gap")), second(p.tracks.at("contact2_gap"));
  for (const Impact& impact : p.run.impacts) {
    if (!counts(impact)) continue;
    EXPECT_NEAR((impact.contact == 0 ? first : second).at(impact.t, 0), 0.0, 1e-7) << impact.t;
  }
  const auto counted = [&](int contact) {
    return static_cast<std::size_t>(
        std::count_if(p.run.impacts.begin(), p.run.impacts.end(), [&](const Impact& i) {
          return counts(i) && i.normal_impulse > 0.0 && i.contact == contact;
        }));
  };
  ASSERT_GT(std::min(counted(0), counted(1)), 5U);
  EXPECT_EQ(p.tracks.at("impacts").knots, counted(0));
  EXPECT_EQ(p.tracks.at("contact2_impacts").knots, counted(1));
  const nlohmann::json contacts = contacts_values(p.scene, p.machine);
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[1].at("name"), "free end");
  EXPECT_DOUBLE_EQ(contacts[1].at("clearance"), 0.25e-3);
  EXPECT_NEAR(contacts[1].at("z").get<double>(), 0.5 / 0.6, 1e-12) << "of the shaft's length";
}

// A controlled ring, and the cone's chatter: forces that are there for a step at a time.
TEST(PackedRun, KeepsAChatteringContact) {
  const scene::Scene scene = test::shipped("paper_sliding", {"run.end=0.15"});
  for (const auto contact : {scene::ContactModel::kCone, scene::ContactModel::kCoulomb}) {
    const Packed p = packed_run(*mujoco_engine(contact), scene);
    ASSERT_TRUE(p.tracks.contains("control"));
    expect_all(p);
  }
}

TEST(PackedRun, KeepsCurrents) {
  const scene::Scene scene = test::shipped("paper_magnetic", {"run.end=0.12"});
  const Packed p = packed_run(*native_engine(scene::Integrator::kVerlet), scene);
  ASSERT_TRUE(p.tracks.contains("current"));
  expect_all(p);
}

// A clearance of 10 nm: the scene determines the accuracy.
TEST(PackedRun, KeepsATinyClearance) {
  const Packed p =
      packed_run(*native_engine(scene::Integrator::kEvent), test::shipped("hard/tiny_clearance"));
  expect_all(p);
  const UnpackedTrack rotor(p.tracks.at("rotor"));
  const auto& t = p.run.column("t");
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_NEAR(rotor.at(t[i], 0), p.run.column("rotor_x")[i], 1e-8 / 200.0 * kRound) << t[i];
  }
}

// Rows up to the middle of the run, as if it had diverged there.
TEST(PackedRun, MayEndEarly) {
  const scene::Scene scene = test::shipped("bench_ring", {"run.end=0.05"});
  RunRequest request;
  request.output_times = dense_times(scene.run, 5000);
  Trajectory run = native_engine(scene::Integrator::kEvent)->run(scene, request);
  for (Column& column : run.series) column.values.resize(column.values.size() / 2);
  const Packed p = packed(scene, run);
  expect_all(p);
  const UnpackedTrack rotor(p.tracks.at("rotor"));
  EXPECT_EQ(rotor.at(1.0, 0), rotor.at(run.column("t").back(), 0)) << "stays at its last row";
  for (Column& column : run.series) column.values.resize(1);
  EXPECT_EQ(packed(scene, run).tracks.at("rotor").knots, 1U);
  for (Column& column : run.series) column.values.clear();
  EXPECT_TRUE(pack_run(scene, p.machine, run).empty());
}

// With rows of half a millisecond bounces lie between them: the gap touches 0 at each, and rises in
// between.
TEST(PackedRun, ShowsBouncesBetweenRows) {
  const scene::Scene scene = test::shipped("bench_drop");
  RunRequest request;
  request.output_times = output_times(scene.run);
  const Packed p = packed(scene, native_engine(scene::Integrator::kEvent)->run(scene, request));
  const UnpackedTrack gap(p.tracks.at("gap"));
  const double fine = gap_tolerance(p.scene.first().contact->clearance);
  std::size_t arcs = 0;
  for (std::size_t i = 0; i + 1 < p.run.impacts.size(); ++i) {
    const Impact &a = p.run.impacts[i], &b = p.run.impacts[i + 1];
    if (!counts(a) || !counts(b)) continue;
    EXPECT_NEAR(gap.at(a.t, 0), 0.0, 2.0 * fine) << a.t;
    const double height =
        0.25 * a.gap_rate_after * (b.t - a.t);  // of a parabola that leaves at this rate
    if (height < 1e-6) continue;
    ++arcs;
    EXPECT_NEAR(gap.at(0.5 * (a.t + b.t), 0), height, 0.05 * height + 2.0 * fine) << a.t;
  }
  EXPECT_GT(arcs, 3U);
}

// Nor does a cubic between coarse rows let the rigid rotor into the ring.
TEST(PackedRun, NeverPenetratesBetweenRowsOfTheRigidLaw) {
  const scene::Scene scene =
      test::shipped("paper_magnetic", {"run.end=0.115", "run.output_step=5e-4"});
  RunRequest request;
  request.output_times = output_times(scene.run);
  const Packed p = packed(scene, native_engine(scene::Integrator::kEvent)->run(scene, request));
  const UnpackedTrack gap(p.tracks.at("gap"));
  double least = 0.0;
  for (double t = 0.0; t < 0.115; t += 1e-6) least = std::min(least, gap.at(t, 0));
  EXPECT_GE(least, -gap_tolerance(scene.first().contact->clearance));
  expect_gap(p);
}

// A rotor that waits at a constant gap for its load is drawn at that gap, although 1 % of it is far
// more than its motion.
TEST(PackedRun, AGapThatHardlyChangesIsFlat) {
  const scene::Scene scene = test::shipped("bench_drop", {"run.end=0.002"});
  RunRequest request;
  Trajectory run = native_engine(scene::Integrator::kEvent)->run(scene, request);
  const auto& t = run.column("t");
  for (Column& column : run.series) {
    if (column.name != "gap" && column.name != "gap_rate") continue;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double w = 300.0, size = 1e-7;
      column.values[i] =
          column.name == "gap" ? 4e-4 + size * std::sin(w * t[i]) : size * w * std::cos(w * t[i]);
    }
  }
  const Packed p = packed(scene, std::move(run));
  const UnpackedTrack gap(p.tracks.at("gap"));
  for (double at = 0.0; at < 0.002; at += 1e-6) ASSERT_NEAR(gap.at(at, 0), 4e-4, 1.4e-7) << at;
}

TEST(PackedRun, HasNothingThatTheSceneHasNot) {
  const scene::Scene billiard = test::shipped("bench_billiard", {"run.end=0.02"});
  const Packed p = packed_run(*native_engine(scene::Integrator::kEvent), billiard);
  ASSERT_FALSE(billiard.first().stator);
  for (const char* name :
       {"ring", "bend_1", "control", "current", "torsion", "ring_spin", "motor_torque"}) {
    EXPECT_FALSE(p.tracks.contains(name)) << name;
  }
  const nlohmann::json rig = rig_values(p.scene, p.machine);
  const nlohmann::json contacts = contacts_values(p.scene, p.machine);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].at("name"), "") << "the only one";
  EXPECT_FALSE(contacts[0].at("ring_moves"));
  EXPECT_FALSE(contacts[0].at("actuators"));
  EXPECT_TRUE(rig.at("motor").is_null());
  EXPECT_TRUE(rig.at("bearings").empty());
  EXPECT_TRUE(rig.at("magnetic_bearings").empty());
}

}  // namespace
}  // namespace rotorub
