#include "compare/report/modes_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/report/assets.h"
#include "compare/report/plot_points.h"
#include "compare/report/response_plots.h"
#include "native_model/linear/campbell.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/shafts.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kDrawn = 1e-6;   // relative: the page's data have seven digits
constexpr double kRange = 500.0;  // rad/s
constexpr int kSpeeds = 26;

scene::Scene friswell() {
  scene::Scene s;
  s.name = "friswell";
  s.rotor.speed = 100.0;
  s.rotor.geometry = oracle::friswell_rotor();
  return s;
}

scene::Scene jeffcott() {
  scene::Scene s;
  s.name = "jeffcott";
  s.rotor.speed = 100.0;
  s.rotor.modal.emplace().mass = {2.0};
  s.rotor.modal->stiffness = {2e5};
  s.rotor.modal->damping = {40.0};
  return s;
}

Campbell campbell_of_test(const scene::Scene& s) {
  RotorAnalysis analysis = analyse_rotor(s, {});
  auto branches = whirl_branches(analysis.system, even_speeds(kRange, kSpeeds));
  return {std::move(analysis), kRange, std::move(branches)};
}
json plots_of(const scene::Scene& s) { return modes_plots(s, campbell_of_test(s)); }
std::string page_of(const scene::Scene& s) { return modes_page(s, campbell_of_test(s)); }

// Between two strings.
std::string part(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  EXPECT_NE(begin, std::string::npos) << from;
  const std::size_t end = text.find(to, begin + from.size());
  return text.substr(begin + from.size(), end - begin - from.size());
}

TEST(ModesPlots, DrawTheSpectraOfTheModel) {
  const scene::Scene s = friswell();
  const WhirlSystem system = whirl_system(s);
  const json campbell = plots_of(s).at("campbell");
  ASSERT_EQ(campbell.at("pieces").size(), 6u);
  for (const json& piece : campbell["pieces"]) {
    ASSERT_EQ(piece.at("speed").size(), static_cast<std::size_t>(kSpeeds));
    const double sign = piece.at("sense") == "forward" ? 1.0 : -1.0;
    const double speed = kRange;
    const double drawn = piece.at("frequency").back().get<double>() / kHz * sign;
    double nearest = 1.0;
    for (const WhirlMode& mode : whirl_spectrum(system, speed).modes) {
      nearest = std::min(nearest, std::abs(mode.frequency / drawn - 1.0));
    }
    EXPECT_LT(nearest, kDrawn) << drawn;
    for (const json& ratio : piece.at("damping")) EXPECT_EQ(ratio, 0.0) << "undamped";
  }
  EXPECT_NEAR(campbell.at("running").get<double>(), 100.0 * kRpm, 1e-3);
  EXPECT_NEAR(campbell.at("top").get<double>(), kRange * kRpm, 1e-2);
}

TEST(ModesPlots, HaveAllCriticalSpeeds) {
  const scene::Scene s = friswell();
  const std::vector<double> expected = critical_speeds(whirl_system(s));
  const json drawn = plots_of(s)["campbell"].at("critical");
  ASSERT_EQ(expected.size(), 3u);
  ASSERT_EQ(drawn.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(drawn[k].get<double>() / (expected[k] * kRpm), 1.0, kDrawn);
  }
}

double highest(const json& mode) {
  double most = 0.0;
  for (const json& value : mode.at("shape")) most = std::max(most, std::abs(value.get<double>()));
  return most;
}

TEST(ModesPlots, DrawTorsionAndTheWhirlAtTheScenesSpeed) {
  scene::Scene s = friswell();
  EXPECT_EQ(plots_of(s)["campbell"].at("torsion"), json::array()) << "none without [rotor.torsion]";
  s.rotor.torsion.emplace().modes = 2;
  const RotorAnalysis analysis = analyse_rotor(s, {});
  const json plots = plots_of(s);
  ASSERT_EQ(plots["campbell"]["torsion"].size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(
        plots["campbell"]["torsion"][k].get<double>() / (analysis.torsion[k].frequency * kHz), 1.0,
        kDrawn);
  }
  // Each sense counts its own modes, and each is drawn 1 high.
  const json& whirl = plots["shapes"].at("whirl");
  ASSERT_EQ(whirl.size(), 6u);
  for (const json& mode : whirl) {
    EXPECT_EQ(highest(mode), 1.0) << mode.at("sense") << mode.at("number");
  }
  EXPECT_EQ(whirl[4].at("number"), 3);
  EXPECT_EQ(whirl[5].at("number"), 3);
}

TEST(ModesPlots, MarkTheThresholdOrSayThereIsNone) {
  scene::Scene s = friswell();
  EXPECT_TRUE(plots_of(s)["campbell"].at("threshold").is_null());
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const double expected = stability_threshold(whirl_system(s)).value();
  const json campbell = plots_of(s)["campbell"];
  EXPECT_NEAR(campbell.at("threshold").get<double>() / (expected * kRpm), 1.0, kDrawn);

  // Forward whirl grows beyond it, and there alone.
  for (const json& piece : campbell["pieces"]) {
    for (std::size_t k = 0; k < piece["speed"].size(); ++k) {
      const bool below = piece["speed"][k].get<double>() < expected * kRpm;
      const double damping = piece["damping"][k];
      if (below || piece["sense"] == "backward") {
        EXPECT_GT(damping, 0.0);
      }
    }
  }
  EXPECT_LT(campbell["pieces"][1]["damping"].back().get<double>(), 0.0);
}

TEST(ModesPlots, DrawModesOneHigh) {
  scene::Scene s = friswell();
  s.rotor.geometry->bearings[0].stiffness.y() *= 0.5;
  const json shapes = plots_of(s).at("shapes");
  EXPECT_EQ(shapes.at("same_planes"), false);
  EXPECT_EQ(shapes.at("discs").size(), 2u);
  ASSERT_EQ(shapes.at("modes").size(), 6u) << "three in each plane";
  EXPECT_EQ(shapes["modes"][0].at("plane"), "x");
  EXPECT_EQ(shapes["modes"][5].at("plane"), "y");
  for (const json& mode : shapes["modes"]) {
    ASSERT_EQ(mode.at("shape").size(), shapes.at("z").size());
    EXPECT_EQ(highest(mode), 1.0);
  }
  EXPECT_TRUE(plots_of(jeffcott()).at("shapes").is_null());
}

TEST(ModesPage, HoldsAllItNeeds) {
  std::string page = page_of(friswell());
  const std::string plotly = base64(packed_plotly_js());
  const std::size_t script = page.find(plotly);
  ASSERT_NE(script, std::string::npos);
  page.erase(script, plotly.size());
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing from a network";
  EXPECT_EQ(page.find("src="), std::string::npos) << "nothing from another file";
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos) << "every name of the template filled";
  const json data = json::parse(part(page, "type=\"application/json\">", "</script>"));
  json expected = plots_of(friswell());
  expected["stiffness"] = stiffness_data(friswell());
  EXPECT_EQ(data["rotor"], expected);
  EXPECT_EQ(data.at("loops"), json::array());
}

// The drawn Bode plot of one mode: e r^2 / (1 - r^2 + 2 i zeta r), zeta = 1/sqrt(1000).
TEST(ModesPlots, DrawTheResponseToUnbalance) {
  scene::Scene s = jeffcott();
  EXPECT_TRUE(plots_of(s).at("bode").is_null()) << "nothing turns with the spin";
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = 2.0 * 10e-6;
  s.forces.push_back(unbalance);
  const json bode = plots_of(s).at("bode");
  EXPECT_EQ(bode.at("forces"), false);
  ASSERT_EQ(bode.at("curves").size(), 1u);
  const json& curve = bode["curves"][0];
  const double omega = std::sqrt(1e5), zeta = 40.0 / (2.0 * 2.0 * omega);
  for (std::size_t k = 0; k < bode.at("speed").size(); ++k) {
    const double r = bode["speed"][k].get<double>() / kRpm / omega;
    const double size = 10.0 * r * r / std::hypot(1.0 - r * r, 2.0 * zeta * r);
    EXPECT_NEAR(curve.at("amplitude")[k].get<double>() / size, 1.0, 2e-4);
    const double phase = -std::atan2(2.0 * zeta * r, 1.0 - r * r) * 180.0 / 3.14159265358979;
    EXPECT_NEAR(curve.at("phase")[k].get<double>(), phase, 0.02);
  }
  ASSERT_EQ(curve.at("peaks").size(), 1u);
  EXPECT_NEAR(curve["peaks"][0].at("factor").get<double>() * 2.0 * zeta, 1.0, 0.01);
  // AF is 31.6 / 2: 17 % (1 - 1/14.3) below, 10 % more above.
  EXPECT_NEAR(curve["peaks"][0].at("margin").get<double>(), 0.258, 5e-4);
  s.rotor.speed = 400.0;
  EXPECT_NEAR(plots_of(s)["bode"]["curves"][0]["peaks"][0]["margin"].get<double>(), 0.158, 5e-4);
  s.rotor.speed = 0.0;
  EXPECT_TRUE(plots_of(s)["bode"]["curves"][0]["peaks"][0]["margin"].is_null());
}

void add_ring(scene::Scene& s, double stiffness) {
  auto& bearing = s.first();
  bearing.contact.emplace();
  bearing.contact->radius = 50e-3;
  bearing.contact->clearance = 0.5e-3;
  bearing.stator.emplace().mass = {1.0, 1.0};
  bearing.stator->stiffness = {stiffness, stiffness};
}

json judged_of(const scene::Scene& s) {
  return json::parse(part(page_of(s), "type=\"application/json\">", "</script>")).at("judged");
}

// A free rotor that is stable at any speed may whip once it touches: the page says so beside it.
TEST(ModesPage, SaysWhatATouchMayLeadTo) {
  scene::Scene s = jeffcott();
  EXPECT_TRUE(judged_of(s).at("speed").at("rub").is_null()) << "there is nothing to touch";
  add_ring(s, 1e6);
  s.first().contact->friction.coefficient = 0.2;
  s.first().stator->damping = {200.0, 200.0};
  const json attractors = judged_of(s).at("speed").at("rub").at("attractors");
  EXPECT_NE(std::ranges::find(attractors, "backward whip"), attractors.end());
}

// A start of rotor and ring that only go together, as of mjcf/bench_annular_elastic.toml.
TEST(ModesPage, AsksForNoStart) {
  scene::Scene s = jeffcott();
  add_ring(s, 1e5);
  s.initial.x = {2e-3};
  s.first().stator->position = {1.8e-3, 0.0};
  EXPECT_EQ(judged_of(s).at("unstable_ranges"), json::array());
}

TEST(ModesPage, SaysWhatTheModelSays) {
  scene::Scene s = friswell();
  EXPECT_EQ(judged_of(s).at("unstable_ranges"), json::array());
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const json range = judged_of(s).at("unstable_ranges").at(0);
  EXPECT_NEAR(range[0].get<double>() * kRpm, 830.42, 0.01) << "as the first critical";
  EXPECT_TRUE(range[1].is_null());
}

TEST(ModesPage, OfAModalFormSaysWhyItHasNoShapes) {
  EXPECT_NE(page_of(jeffcott()).find("mode shapes: unknown, because the scene gives"),
            std::string::npos);
  EXPECT_NE(page_of(friswell()).find("mode shapes at rest"), std::string::npos);
}

// A text that would end the script element, and HTML in the scene.
TEST(ModesPage, EscapesTheScene) {
  scene::Scene s = jeffcott();
  s.text = "# </script><b>";
  const std::string page = page_of(s);
  EXPECT_EQ(page.find("# </script>"), std::string::npos);
  EXPECT_NE(page.find("# \\u003c/script>\\u003cb>"), std::string::npos);
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

// Critical speeds a little apart each do not lead on to speeds at which no machine runs.
TEST(CampbellRange, StaysNearTheMachinesSpeed) {
  scene::Scene s = jeffcott();
  RotorAnalysis analysis = analyse_rotor(s, {});
  const double speed = s.rotor.speed;
  analysis.critical_speeds = {0.7 * speed, 2.5 * speed, 9.0 * speed, 30.0 * speed};
  EXPECT_GT(campbell_range(s, analysis), 2.5 * speed);
  EXPECT_LT(campbell_range(s, analysis), 3.0 * speed);
}

// What the model says at the scene's speed, and no shape without a shaft.
TEST(RotorSection, IsOfTheScenesSpeed) {
  const scene::Scene s = test::shipped("paper_passive");
  const json section = rotor_section(s);
  EXPECT_FALSE(section.contains("refusal"));
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), s.rotor.speed);
  const json& operating = section.at("campbell").at("operating");
  ASSERT_EQ(operating.size(), spectrum.modes.size());
  for (std::size_t k = 0; k < operating.size(); ++k) {
    EXPECT_NEAR(
        operating[k].at("frequency").get<double>() / (kHz * std::abs(spectrum.modes[k].frequency)),
        1.0, 1e-6);
    EXPECT_EQ(operating[k].at("sense"), spectrum.modes[k].frequency > 0.0 ? "forward" : "backward");
  }
  const json& shapes = section.at("shapes");
  EXPECT_FALSE(shapes.contains("modes")) << "those at rest are on the page of modes";
  ASSERT_EQ(shapes.at("whirl").size(), 8u);
  EXPECT_EQ(shapes["whirl"][0].at("shape").size(), shapes.at("z").size());
}

TEST(RotorSection, OfAModalFormHasADiagramAlone) {
  const json section = rotor_section(test::shipped("bench_ring"));
  EXPECT_TRUE(section.at("shapes").is_null());
  EXPECT_EQ(section.at("campbell").at("torsion"), json::array());
}

// A rotor without eigenvalues to show still has its page, with the reason.
TEST(RotorSection, SaysWhyThereIsNone) {
  scene::Scene s = test::shipped("bench_ring");
  s.rotor.modal->mass = {1e-300};
  s.rotor.modal->stiffness = {1e300};
  const json section = rotor_section(s);
  EXPECT_NE(section.at("refusal"), "");
  EXPECT_EQ(section.size(), 1u);
}

}  // namespace
}  // namespace rotorub
