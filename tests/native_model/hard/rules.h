// The rules that every hard case must pass: finite and complete rows, the contact laws in every row
// by the independent residual, no impact that gains energy, bounded penetration, a closed energy
// balance.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/support/contact_residual.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub::test {

inline constexpr double kLaws = 1e-10;   // scaled residual of complementarity and Coulomb
inline constexpr double kEnergy = 1e-9;  // energy residual of `event`: tolerance x steps, with room
inline constexpr double kRoundOff = 1e-12;

inline Trajectory run_verlet(const scene::Scene& scene, double step) {
  return run_with(scene, scene::Integrator::kVerlet, step);
}

inline double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

// Every requested time has its row, without NaN or infinity.
inline void expect_finite(const Trajectory& t) {
  ASSERT_FALSE(t.series.empty());
  for (const Column& column : t.series) {
    ASSERT_EQ(column.values.size(), t.rows()) << column.name;
    for (const double x : column.values) ASSERT_TRUE(std::isfinite(x)) << column.name;
  }
  for (const Impact& i : t.impacts) {
    ASSERT_TRUE(std::isfinite(i.t + i.normal_impulse + i.friction_impulse + i.gap_rate_after +
                              i.slip_after + i.energy_change));
  }
}

// Impacts push, friction stays in its cone, and no impact gains energy.
inline void expect_dissipative_impacts(const scene::Scene& scene, const Trajectory& t) {
  if (!scene.first().contact) return;
  const double mu = scene.first().contact->friction.coefficient;
  for (const Impact& i : t.impacts) {
    ASSERT_GE(i.normal_impulse, 0.0);
    ASSERT_LE(std::abs(i.friction_impulse), mu * i.normal_impulse * (1.0 + kRoundOff) + 1e-300);
    const double size =
        i.normal_impulse * (std::abs(i.gap_rate_before) + std::abs(i.gap_rate_after)) +
        std::abs(i.friction_impulse) * (std::abs(i.slip_before) + std::abs(i.slip_after));
    ASSERT_LE(i.energy_change, kRoundOff * size) << "at " << i.t;
  }
}

inline void expect_in_cone(const scene::Scene& scene, const Trajectory& t) {
  if (!scene.first().contact) return;
  const auto &normal = t.column("normal_force"), &friction = t.column("friction_force");
  const double scale = std::max(largest(normal), 1e-300);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    ASSERT_GE(normal[k], 0.0);
    ASSERT_LE(std::abs(friction[k]),
              scene.first().contact->friction.coefficient * normal[k] + kLaws * scale);
  }
}

// The balance relative to the work done: with a tiny gap it is far more than the stored energy.
inline double energy_residual(const Trajectory& t) {
  const Statistics& s = t.statistics;
  const double through =
      std::max({s.energy_scale, std::abs(s.external_work), std::abs(s.contact_work)});
  return through > 0.0 ? s.energy_residual() * s.energy_scale / through : 0.0;
}

// All rules of a run of `event` that is expected to succeed.
inline void expect_sound_event(const scene::Scene& scene, const Trajectory& t) {
  expect_finite(t);
  ASSERT_DOUBLE_EQ(t.column("t").back(), scene.run.end);
  EXPECT_LT(energy_residual(t), kEnergy);
  if (!scene.first().contact) return;
  expect_dissipative_impacts(scene, t);
  expect_in_cone(scene, t);
  const auto &gap = t.column("gap"), &slip = t.column("slip"), &mode = t.column("mode");
  const auto &normal = t.column("normal_force"), &friction = t.column("friction_force");
  const double force = std::max(largest(normal), 1e-9), speed = std::max(largest(slip), 1e-9);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const ContactResidual r = contact_residual(gap[k], normal[k], friction[k], slip[k],
                                               scene.first().contact->friction.coefficient,
                                               scene.first().contact->clearance, force, speed);
    ASSERT_LT(r.complementarity, kLaws) << "t = " << t.column("t")[k];
    if (static_cast<ContactMode>(mode[k]) != ContactMode::kFree) {
      ASSERT_LT(r.coulomb, kLaws) << "t = " << t.column("t")[k];
    }
  }
}

// Runs that keep every rule.
inline Trajectory sound_event(const scene::Scene& scene) {
  Trajectory t = run_event(scene);
  expect_sound_event(scene, t);
  return t;
}
// It is never deeper in the ring than one step of flight. fastest: m/s, relative speed that the
// scene cannot exceed.
inline Trajectory sound_verlet(const scene::Scene& scene, double step = 1e-5,
                               double fastest = 2.0) {
  Trajectory t = run_verlet(scene, step);
  expect_finite(t);
  EXPECT_DOUBLE_EQ(t.column("t").back(), scene.run.end);
  if (!scene.first().contact) return t;
  expect_dissipative_impacts(scene, t);
  expect_in_cone(scene, t);
  EXPECT_LE(t.statistics.max_penetration, fastest * step);
  return t;
}

// Every status has a reason, and the results so far are complete.
inline void expect_refused_or_finite(const Trajectory& t) {
  if (t.status != Status::kOk) {
    EXPECT_FALSE(t.message.empty());
  }
  expect_finite(t);
}

}  // namespace rotorub::test
