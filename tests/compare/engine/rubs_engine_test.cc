// Rubs whose force is known, in MuJoCo. Contact model `cone-coulomb`, MuJoCo's cone corrected for
// sliding, keeps the contact, with the right force and without scatter, where the cone itself is
// thrown open; with a friction reference of its own the cone does so within the borders of
// theory.md. Of a backward whip `rigid` and `coulomb` stay near the exact one, and the cone falls
// into the rolling attractor that is there as well.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "mjcf/soft_contact.h"
#include "native_model/oracles/annular_rub.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/order.h"
#include "tests/support/whip.h"

namespace rotorub::test {
namespace {

// Figures of the last fifth of a run, from every step.
struct Rubbing {
  double mean = 0.0, scatter = 0.0;  // N
  double contact = 0.0;              // share of the rows
  double friction = 0.0;             // friction / normal force
  double whirl = 0.0;                // rad/s, at the end
  Trajectory run;
};

Rubbing rubbing(scene::Scene scene, scene::ContactModel contact, double step) {
  scene.run.output_step = step;
  Rubbing out;
  out.run = mujoco_run(scene, contact, step);
  const Trajectory& t = out.run;
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  const std::vector<double>& normal = t.column("normal_force");
  const std::size_t from = normal.size() * 4 / 5;
  const auto n = static_cast<double>(normal.size() - from);
  double squares = 0.0, friction = 0.0;
  for (std::size_t k = from; k < normal.size(); ++k) {
    out.mean += normal[k] / n;
    out.contact += normal[k] > 0.0 ? 1.0 / n : 0.0;
    friction += t.column("friction_force")[k] / n;
  }
  for (std::size_t k = from; k < normal.size(); ++k)
    squares += (normal[k] - out.mean) * (normal[k] - out.mean);
  out.scatter = std::sqrt(squares / n);
  out.friction = friction / out.mean;
  out.whirl = whirl_speed(t, t.rows() - 1);
  return out;
}

struct Exact {
  double force, whirl;  // N, rad/s
};
Exact exact(const scene::Scene& s) {
  if (s.name == "bench_whip")
    return {244.8444, -501.9257};  // tests/native_model/oracles: where the whirl ends
  const scene::RotorModal& m = *s.rotor.modal;
  const oracle::Support rotor{m.mass[0], m.damping[0], m.stiffness[0]};
  const double c = s.first().contact->clearance, mu = s.first().contact->friction.coefficient;
  const double load = s.forces[0].amplitude, frequency = s.forces[0].frequency;
  if (!s.first().stator)
    return {oracle::annular_rub(rotor, c, mu, load, frequency).value().force, frequency};
  const oracle::Support ring{s.first().stator->mass.x(), s.first().stator->damping.x(),
                             s.first().stator->stiffness.x()};
  return {oracle::annular_rub(rotor, ring, c, mu, load, frequency).value().force, frequency};
}

constexpr const char* kRubs[] = {"bench_whip", "bench_ring", "bench_annular_elastic",
                                 "bench_annular_rigid"};

void expect_near(const Rubbing& r, const Exact& exact, double share) {
  EXPECT_NEAR(r.mean, exact.force, share * exact.force);
  EXPECT_NEAR(r.whirl, exact.whirl, share * std::abs(exact.whirl));
  EXPECT_LT(r.scatter, 1.0);
  EXPECT_GT(r.contact, 1.0 - 1e-9);
}

TEST(ConeCoulomb, KeepsARubWithTheRightForce) {
  for (const char* name : kRubs) {
    SCOPED_TRACE(name);
    const scene::Scene scene = shipped(name);
    const Rubbing r = rubbing(scene, scene::ContactModel::kConeCoulomb, 1e-5);
    expect_near(r, exact(scene), 2e-3);
    EXPECT_NEAR(std::abs(r.friction), scene.first().contact->friction.coefficient, 1e-5);
    expect_near(rubbing(scene, scene::ContactModel::kConeCoulomb, 1e-4), exact(scene), 0.01);
  }
}

// At a friction of 10 the rotor rolls round the ring at thousands of rad/s, so that the tangent
// turns noticeably within a step. Friction rows that stop a slip within one step opened the contact
// in every other step here, with twice the friction work.
TEST(ConeCoulomb, KeepsRollingUnderStrongFriction) {
  const scene::Scene scene = shipped("hard/friction_ten");
  const Trajectory native = attempt_event(scene);
  const double whirl = whirl_speed(native, native.rows() - 1);
  for (const double step : {2e-5, 1e-5, 5e-6}) {
    SCOPED_TRACE(step);
    const Rubbing r = rubbing(scene, scene::ContactModel::kConeCoulomb, step);
    EXPECT_GT(r.contact, 1.0 - 1e-9);
    EXPECT_NEAR(r.whirl, whirl, 1e4 * step * std::abs(whirl)) << "of first order";
  }
}

// Theory.md (48), of a rub that circles at the exact whirl with gap 0; the ring's friction opposes
// the spin.
double border(const scene::Scene& s, double step) {
  const Exact rub = exact(s);
  const double c = s.first().contact->clearance, speed = rub.whirl * c;
  const double slip = s.first().contact->radius * s.rotor.speed + speed;
  const double damping = soft_contact(s, scene::ContactModel::kCone, step).damping;
  return speed * speed / c * (1.0 - 0.5 * damping * step) /
         (s.first().contact->friction.coefficient * std::abs(slip));
}

// The border of a constant friction reference, 19.7/s for the ring and 20.4/s for the whip: shut
// below, open above.
TEST(FrictionReference, KeepsTheContactBelowItsBorder) {
  const auto contact = [](const char* name, const char* reference) {
    const scene::Scene scene =
        shipped(name, {std::string("mujoco.friction_reference=") + reference});
    return rubbing(scene, scene::ContactModel::kCone, 1e-5);
  };
  for (const char* name : kRubs) {
    SCOPED_TRACE(name);
    expect_near(contact(name, "1"), exact(shipped(name)), 2e-3);
  }
  for (const char* name : kRubs) {
    SCOPED_TRACE(name);
    const double predicted = border(shipped(name), 1e-5);
    const auto at = [&](double share) {
      return contact(name, std::to_string(share * predicted).c_str());
    };
    EXPECT_GT(at(0.75).contact, 1.0 - 1e-9) << predicted;
    EXPECT_LT(at(1.5).contact, 0.92) << predicted;
  }
  EXPECT_NEAR(border(shipped("bench_ring"), 1e-5), 19.7, 0.1);
  EXPECT_NEAR(border(shipped("bench_whip"), 1e-5), 20.4, 0.1);
}

// [initial] rub: MuJoCo starts on the rub of `modes` and stays on its circle, the nearer the finer
// its step is: `rigid`, the cone corrected, and, with a friction reference, which alone makes it
// keep a rub, the cone; of its error there is a part that no step takes away.
TEST(RubStartEngine, StaysOnTheRubThatItStartsOn) {
  struct Start {
    const char *scene, *rub;
  };
  constexpr double kTurns = 8.0;
  for (const Start start : {Start{"bench_ring", "synchronous"}, Start{"bench_whip", "whip"}}) {
    for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCone,
                               scene::ContactModel::kConeCoulomb}) {
      SCOPED_TRACE(std::string(start.scene) + " " + to_string(contact));
      Convergence found;
      for (const double step : {8e-5, 4e-5, 2e-5, 1e-5}) {
        std::vector<std::string> set{std::string("initial={rub='") + start.rub + "'}"};
        if (contact == scene::ContactModel::kCone) set.push_back("mujoco.friction_reference=1");
        scene::Scene scene = shipped(start.scene, set);
        scene.run.end = kTurns * 2.0 * std::numbers::pi / std::abs(exact(scene).whirl);
        scene.run.output_step = scene.run.end / 400.0;
        const Trajectory t = mujoco_run(scene, contact, step);
        EXPECT_GT(t.contact_fraction(), 1.0 - 1e-9);
        const std::complex<double> place(t.column("rotor_x")[0], t.column("rotor_y")[0]),
            velocity(t.column("rotor_vx")[0], t.column("rotor_vy")[0]), rate = velocity / place;
        EXPECT_NEAR(rate.real(), 0.0, 1e-9 * std::abs(rate)) << "a circle";
        EXPECT_NEAR(rate.imag(), exact(scene).whirl, 1e-6 * std::abs(rate));
        found.steps.push_back(step);
        found.errors.push_back(
            orbit_error(t, [&](double time) { return place * std::exp(rate * time); }));
      }
      EXPECT_TRUE(std::is_sorted(found.errors.rbegin(), found.errors.rend())) << found.text();
      const bool vanishes = contact != scene::ContactModel::kCone;
      const double clearance = shipped(start.scene).first().contact->clearance;
      EXPECT_LT(found.errors.back(), (vanishes ? 0.02 : 0.03) * clearance) << found.text();
      if (vanishes) {
        EXPECT_GT(found.order(), 0.8) << found.text();
      }
    }
  }
}

Trajectory whip(scene::ContactModel contact, double end) {
  scene::Scene scene = shipped("bench_whip");
  scene.run.end = end;
  return mujoco_run(scene, contact, 1e-5);
}

// After 1 s at 10 us it has -501.845 rad/s and 244.738 N instead of -501.9257 and 244.8444.
TEST(WhipEngine, RigidAndCoulombStayNearTheExactOne) {
  for (const scene::ContactModel contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    const Trajectory t = whip(contact, 1.0);
    EXPECT_NEAR(whirl_speed(t, t.rows() - 1), -501.9257, 2e-4 * 502.0) << t.contact_model;
    EXPECT_NEAR(t.column("normal_force").back(), 244.8444, 5e-4 * 245.0) << t.contact_model;
    EXPECT_GT(t.contact_fraction(), 1.0 - 1e-9) << t.contact_model;
  }
}

}  // namespace
}  // namespace rotorub::test
