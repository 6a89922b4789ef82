#include "compare/modes/page_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "native_model/linear/campbell.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/shafts.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kEqual = 1e-9;
constexpr double kRange = 500.0;  // rad/s
constexpr int kSpeeds = 26;

scene::Scene jeffcott() {
  scene::Scene s;
  s.name = "jeffcott";
  s.rotor.speed = 100.0;
  s.rotor.modal.emplace().mass = {2.0};
  s.rotor.modal->stiffness = {2e5};
  s.rotor.modal->damping = {40.0};
  return s;
}

void add_ring(scene::Scene& s, double stiffness) {
  auto& bearing = s.first();
  bearing.contact.emplace();
  bearing.contact->radius = 50e-3;
  bearing.contact->clearance = 0.5e-3;
  bearing.stator.emplace().mass = {1.0, 1.0};
  bearing.stator->stiffness = {stiffness, stiffness};
}

Campbell campbell_of_test(const scene::Scene& s) {
  RotorAnalysis analysis = analyse_rotor(s, {});
  auto branches = whirl_branches(analysis.system, even_speeds(kRange, kSpeeds));
  return {std::move(analysis), kRange, std::move(branches)};
}
TEST(RotorData, HasTheSpectraOfTheModel) {
  const scene::Scene s = oracle::friswell_scene();
  const WhirlSystem system = whirl_system(s);
  const json data = rotor_data(s, campbell_of_test(s));
  ASSERT_EQ(data.at("branches").size(), 6u);
  for (const json& branch : data["branches"]) {
    ASSERT_EQ(branch.at("speed").size(), static_cast<std::size_t>(kSpeeds));
    EXPECT_EQ(branch["speed"].back(), kRange);
    const double last = branch.at("modes").back()[0];
    double nearest = 1.0;
    for (const WhirlMode& mode : whirl_spectrum(system, kRange).modes)
      nearest = std::min(nearest, std::abs(mode.frequency / last - 1.0));
    EXPECT_LT(nearest, kEqual) << last;
    for (const json& mode : branch["modes"])
      EXPECT_NEAR(mode[1].get<double>(), 0.0, 1e-10) << "undamped";
  }
  EXPECT_EQ(data.at("running"), 100.0);
  EXPECT_EQ(data.at("top"), kRange);
}

TEST(RotorData, HasTheShaft) {
  const scene::Scene s = oracle::friswell_scene();
  const Campbell campbell = campbell_of_test(s);
  const json data = rotor_data(s, campbell);
  EXPECT_EQ(data.at("shaft").at("discs").size(), 2u);
  ASSERT_EQ(data.at("whirl_shapes").size(), 6u);
  for (const json& whirl : data["whirl_shapes"])
    EXPECT_EQ(whirl.at("shape").size(),
              static_cast<std::size_t>(campbell.analysis.shapes->z.size()));
  EXPECT_TRUE(rotor_data(jeffcott(), campbell_of_test(jeffcott())).at("shaft").is_null());
}

// One mode: X = e r^2 / (1 - r^2 + 2 i zeta r), zeta = 1/sqrt(1000).
TEST(RotorData, HasTheResponseToUnbalance) {
  scene::Scene s = jeffcott();
  const auto response_of = [&] { return rotor_data(s, campbell_of_test(s)).at("response"); };
  EXPECT_TRUE(response_of().is_null()) << "nothing turns with the spin";
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = 2.0 * 10e-6;
  s.forces.push_back(unbalance);
  const json response = response_of();
  EXPECT_EQ(response.at("forces"), false);
  EXPECT_TRUE(response.at("before").is_null()) << "nothing is lost";
  ASSERT_EQ(response.at("probes").size(), 1u);
  const json& probe = response["probes"][0];
  const double omega = std::sqrt(1e5), zeta = 40.0 / (2.0 * 2.0 * omega);
  for (std::size_t k = 0; k < response.at("speed").size(); ++k) {
    const double r = response["speed"][k].get<double>() / omega;
    const std::complex<double> expected =
        10e-6 * r * r / std::complex<double>(1.0 - r * r, 2.0 * zeta * r);
    const json& x = probe.at("deflection")[k];
    EXPECT_NEAR(std::abs(std::complex<double>(x[0], x[1]) - expected), 0.0,
                2e-4 * std::abs(expected));
  }
  const auto peak_of = [&] { return response_of()["probes"][0].at("peaks").at(0); };
  EXPECT_NEAR(peak_of().at("amplification").get<double>() * 2.0 * zeta, 1.0, 0.01);
  // AF is 31.6 / 2: 17 % (1 - 1/14.3) below, 10 % more above.
  EXPECT_NEAR(peak_of().at("margin").get<double>(), 0.258, 5e-4);
  s.rotor.speed = 400.0;
  EXPECT_NEAR(peak_of()["margin"].get<double>(), 0.158, 5e-4);
  s.rotor.speed = 0.0;
  EXPECT_TRUE(peak_of()["margin"].is_null());
}

// An unbalance of 1e-5 kg m, to which the lost blade adds nine times as much.
TEST(RotorData, HasTheResponseBeforeAndAfterTheLossOfABlade) {
  scene::Scene s = jeffcott();
  add_ring(s, 1e6);
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = 1e-5;
  s.forces.push_back(unbalance);
  unbalance.static_moment = 9e-5;
  unbalance.on = 0.5 * s.run.end;
  s.forces.push_back(unbalance);
  const json response = rotor_data(s, campbell_of_test(s)).at("response");
  const auto most = [](const json& of) {
    double size = 0.0;
    for (const json& x : of.at("probes").at(0).at("deflection"))
      size = std::max(size, std::hypot(x[0].get<double>(), x[1].get<double>()));
    return size;
  };
  EXPECT_NEAR(most(response) / most(response.at("before")), 10.0, 0.1);
  EXPECT_EQ(response.at("contacts").at(0).at("clearance"), 0.5e-3);
}

// A start of rotor and ring that only go together, as of mjcf/bench_annular_elastic.toml.
TEST(RotorData, AsksForNoStart) {
  scene::Scene s = jeffcott();
  add_ring(s, 1e5);
  s.initial.x = {2e-3};
  s.first().stator->position = {1.8e-3, 0.0};
  const json data = modes_data(s, campbell_of_test(s));
  EXPECT_EQ(data.at("rotor").at("branches").size(), 2u);
  EXPECT_EQ(data.at("rotor").at("stiffness").size(), 1u) << "of the ring";
  EXPECT_EQ(data.at("loops"), json::array());
}

TEST(CampbellRange, ShowsWhatMattersAndNoMore) {
  scene::Scene s = jeffcott();  // critical at 316 rad/s
  const double critical = std::sqrt(1e5);
  const auto range = [&](const std::vector<double>& speeds) {
    return campbell_range(s, analyse_rotor(s, speeds)) / critical;
  };
  EXPECT_GT(range({}), 1.0);
  EXPECT_LT(range({}), 1.3);
  EXPECT_GT(range({2.0 * critical}), 2.0) << "speeds asked for";
  s.rotor.speed = 0.0;
  EXPECT_GT(range({}), 1.0);
  s.rotor.modal->internal_damping = {40.0};  // threshold at twice the critical speed
  EXPECT_GT(range({}), 2.0);
  s.rotor.modal->internal_damping = {4.0};  // at eleven times
  EXPECT_LT(range({}), 1.3);
  s.rotor.modal->stiffness = {0.0};  // nothing whirls
  EXPECT_GT(campbell_range(s, analyse_rotor(s, {})), 0.0);
}

// Critical speeds that are close together do not lead to speeds at which no machine runs.
TEST(CampbellRange, StaysNearTheMachinesSpeed) {
  scene::Scene s = jeffcott();
  RotorAnalysis analysis = analyse_rotor(s, {});
  const double speed = s.rotor.speed;
  analysis.critical_speeds = {0.7 * speed, 2.5 * speed, 9.0 * speed, 30.0 * speed};
  EXPECT_GT(campbell_range(s, analysis), 2.5 * speed);
  EXPECT_LT(campbell_range(s, analysis), 3.0 * speed);
}

// The figures of the model at the scene's speed, and no shape without a shaft.
TEST(RotorData, OfARunIsOfTheScenesSpeed) {
  const scene::Scene s = test::shipped("paper_passive");
  const json data = rotor_data(s);
  EXPECT_FALSE(data.contains("refusal"));
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), s.rotor.speed);
  const json& operating = data.at("operating");
  ASSERT_EQ(operating.size(), spectrum.modes.size());
  for (std::size_t k = 0; k < operating.size(); ++k)
    EXPECT_NEAR(operating[k][0].get<double>() / spectrum.modes[k].frequency, 1.0, kEqual);
  EXPECT_GE(data.at("whirl_shapes").size(), 8u);
  EXPECT_TRUE(rotor_data(test::shipped("bench_ring")).at("found").at("mode_shapes").is_null());
}

// A rotor without eigenvalues still has a page, with the reason.
TEST(RotorData, OfARunSaysWhyThereIsNone) {
  scene::Scene s = test::shipped("bench_ring");
  s.rotor.modal->mass = {1e-300};
  s.rotor.modal->stiffness = {1e300};
  const json section = rotor_data(s);
  EXPECT_NE(section.at("refusal"), "");
  EXPECT_EQ(section.size(), 1u);
}

}  // namespace
}  // namespace rotorub
