#include "compare/report/modes_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/units.h"
#include "compare/modes/result.h"
#include "compare/report/assets.h"
#include "compare/report/loop_page.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/report/response_plots.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"

namespace rotorub {

namespace {

using nlohmann::json;

// Five digits without an exponent.
std::string rpm_text(double speed) {
  const double rpm = speed * kRpm;
  return std::abs(rpm) < 1e5 ? fmt::format("{:.5g} rpm", rpm) : fmt::format("{:.0f} rpm", rpm);
}

std::string damping_text(double ratio) {
  constexpr double kRoundOff = 1e-10;  // damping ratio of an undamped mode
  return fmt::format("{:.3g} %", std::abs(ratio) < kRoundOff ? 0.0 : 100.0 * ratio);
}

json spectrum_values(const WhirlSpectrum& spectrum) {
  return {{"speed", fmt::format("{} ({:.6g} rad/s)", rpm_text(spectrum.speed), spectrum.speed)},
          {"rows", list_of(spectrum.modes, [&](const WhirlMode& mode) -> json {
             const double size = std::abs(mode.frequency);
             const bool grows = mode.damping_ratio < -1e-9;
             return {{"sense", sense_of(mode, spectrum.speed)},
                     {"hertz", fmt::format("{:.6g}", size * kHz)},
                     {"radians", fmt::format("{:.6g}", size)},
                     {"damping", damping_text(mode.damping_ratio)},
                     {"tone", grows ? "bad" : ""},
                     {"grows", grows}};
           })}};
}

json critical_values(const RotorAnalysis& analysis) {
  std::size_t number = 0;
  return list_of(analysis.critical_speeds, [&](double speed) -> json {
    const char* whirl = to_string(analysis.critical_senses[number]);
    return {{"number", ++number},
            {"whirl", whirl},
            {"rpm", fmt::format("{:.6g}", speed * kRpm)},
            {"hertz", fmt::format("{:.6g}", speed * kHz)},
            {"radians", fmt::format("{:.7g}", speed)}};
  });
}

// The critical speed nearest to the rotor's speed, and its distance.
std::string nearest_text(const std::vector<double>& critical, double speed) {
  if (critical.empty()) return "no critical speed";
  if (speed == 0.0) return fmt::format("first critical speed at {}", rpm_text(critical.front()));
  const double nearest = *std::min_element(
      critical.begin(), critical.end(),
      [&](double a, double b) { return std::abs(a - speed) < std::abs(b - speed); });
  const double share = nearest / speed - 1.0;
  return fmt::format("nearest critical speed {}, {:.3g} % {}", rpm_text(nearest),
                     100.0 * std::abs(share), share >= 0.0 ? "above" : "below");
}

json critical_card(const RotorAnalysis& analysis) {
  constexpr std::size_t kShown = 3;
  const std::vector<double>& speeds = analysis.critical_speeds;
  std::string headline = "none";
  if (!speeds.empty()) {
    std::vector<std::string> words;
    for (const double speed : speeds) words.push_back(rpm_text(speed));
    words.resize(std::min(kShown, words.size()));
    headline = fmt::format("{}", fmt::join(words, ", "));
  }
  if (speeds.size() > kShown) headline += fmt::format(" and {} more", speeds.size() - kShown);
  return card("Critical speeds", "", headline,
              analysis.system.isotropic
                  ? "undamped; forward whirl, which unbalance excites"
                  : "undamped; whirl of either sense, since the planes differ");
}

bool runs_unstable(const scene::Scene& scene, const RotorAnalysis& analysis) {
  return is_unstable(analysis, std::abs(scene.rotor.speed));
}

json stability_card(const scene::Scene& scene, const RotorAnalysis& analysis) {
  const std::vector<UnstableRange>& ranges = analysis.unstable;
  const bool at_rest = !ranges.empty() && ranges.front().from == 0.0;
  std::string headline = "stable at any speed",
              text = "while it touches nothing: nothing in the rotor can make a whirl grow";
  if (!ranges.empty()) {
    const auto& [from, to] = ranges.front();
    headline = at_rest ? "unstable at rest"
               : std::isinf(to)
                   ? fmt::format("unstable above {}", rpm_text(from))
                   : fmt::format("unstable from {} to {}", rpm_text(from), rpm_text(to));
    text = at_rest ? "the negative stiffness is stronger than the shaft and its bearings"
                   : "there rotating damping or a bearing's cross stiffness feeds a whirl";
    if (ranges.size() > 1)
      text +=
          fmt::format("; {} more range{} below", ranges.size() - 1, ranges.size() > 2 ? "s" : "");
  } else if (std::isfinite(analysis.stability_bound)) {
    headline = fmt::format("stable up to {}", rpm_text(analysis.stability_bound));
    text = "where the search ends: 20 times the highest frequency";
  }
  const char* tone = runs_unstable(scene, analysis) ? "bad" : !ranges.empty() ? "" : "good";
  return card("Free whirl", tone, headline, text);
}

json running_card(const scene::Scene& scene, const RotorAnalysis& analysis) {
  const double speed = std::abs(scene.rotor.speed);
  const bool unstable = runs_unstable(scene, analysis);
  return card("The scene's speed", unstable ? "bad" : "",
              rpm_text(speed) + (unstable ? ", unstable" : ""),
              nearest_text(analysis.critical_speeds, speed));
}

// The smallest gap of the free rotor at each contact, and where it is not reliable.
void add_response_cards(const RotorAnalysis& analysis, json& cards) {
  if (analysis.responses.empty()) return;
  const RotorResponse& response = analysis.responses.front();
  const double speed = analysis.spectra.front().speed;
  const std::string at = ", " + rpm_text(std::abs(speed));
  for (const ContactPlace& place : analysis.contacts) {
    for (const ResponseWords& words : response_words(place, response, speed)) {
      cards.push_back(
          card(words.title + at, words.touches ? "bad" : "", words.headline, words.text));
    }
  }
  for (const std::string& note : response.all.notes)
    cards.push_back(card("Magnetic bearing" + at, "bad", "beyond its current limit", note));
  for (const std::string& note : response.few_modes)
    cards.push_back(card("Modes kept" + at, "", "more modes change the response", note));
}

// The possible results of a contact, for each contact.
void add_rub_cards(const RotorAnalysis& analysis, json& cards) {
  for (const RubAnalyses& rubs : analysis.rubs) {
    const std::string title =
        rubs.contact.empty() ? "Once it touches" : "Once it touches " + rubs.contact;
    if (!rubs.refused.empty()) cards.push_back(card(title, "", "not analysed", rubs.refused));
    if (rubs.at.empty()) continue;
    const rub::RubPoint& point = rubs.at.front().point;
    const auto unstable =
        std::count_if(point.rubs.begin(), point.rubs.end(),
                      [](const rub::StandingRub& r) { return !r.stability.stable; });
    const bool against_spin = point.attractors() & (rub::kBackwardWhip | rub::kRollingRub);
    std::string text = fmt::format("what is stable at {}", rpm_text(std::abs(point.speed)));
    if (unstable > 0) {
      text += fmt::format("; beside it {} lasting rub{} that {} not", unstable,
                          unstable > 1 ? "s" : "", unstable > 1 ? "are" : "is");
    }
    cards.push_back(
        card(title, against_spin ? "bad" : "", attractors_text(point.attractors()), text));
  }
}

json shape_rows(const ModeShapes& shapes, const PlaneShapes& plane) {
  Eigen::Index row = 0;
  return list_of(shapes.stations, [&](const Station& station) -> json {
    return {{"name", station.name},
            {"z", fmt::format("{:.5g}", 1e3 * station.z)},
            {"cells", list_of(plane.at_stations.row(row++),
                              [](double value) { return fmt::format("{:.4f}", value); })}};
  });
}

json plane_values(const std::string& name, const ModeShapes& shapes, const PlaneShapes& plane) {
  int number = 0;
  const json modes = list_of(plane.frequency, [&](double frequency) -> json {
    return {{"number", ++number}, {"hertz", fmt::format("{:.5g}", frequency * kHz)}};
  });
  return {{"plane", name}, {"modes", modes}, {"stations", shape_rows(shapes, plane)}};
}

json planes_values(const RotorAnalysis& analysis) {
  if (!analysis.shapes) return json::array();
  const ModeShapes& shapes = *analysis.shapes;
  if (shapes.same_planes) {
    return json::array({plane_values("planes x and y, which are alike", shapes, shapes.x)});
  }
  return json::array(
      {plane_values("plane x", shapes, shapes.x), plane_values("plane y", shapes, shapes.y)});
}

json torsion_values(const std::vector<WhirlMode>& modes) {
  int number = 0;
  return list_of(modes, [&](const WhirlMode& mode) -> json {
    return {{"number", ++number},
            {"hertz", fmt::format("{:.6g}", mode.frequency * kHz)},
            {"radians", fmt::format("{:.6g}", mode.frequency)},
            {"damping", damping_text(mode.damping_ratio)}};
  });
}

// A sentence on what lies beyond the diagram; empty if nothing does.
std::string beyond_text(const RotorAnalysis& analysis, double range) {
  const std::vector<double>& speeds = analysis.critical_speeds;
  const auto first = std::upper_bound(speeds.begin(), speeds.end(), range);
  std::string text;
  if (first != speeds.end()) {
    std::vector<double> rpm;
    for (auto speed = first; speed != speeds.end(); ++speed) rpm.push_back(*speed * kRpm);
    text = fmt::format("Beyond the diagram: {} critical speed{}, {:.0f} rpm.", rpm.size(),
                       rpm.size() > 1 ? "s" : "", fmt::join(rpm, ", "));
  }
  const auto threshold = analysis.stability_threshold();
  if (threshold && *threshold > range) {
    text += fmt::format("{}The threshold of stability, {}, lies beyond the diagram.",
                        text.empty() ? "" : " ", rpm_text(*threshold));
  }
  return text;
}

// Sets whether and where the Bode plot is shown, and its contents.
void add_bode_place(const json& bode, const char* place, json& values) {
  values["bode_place"] = place;
  values["has_bode"] = !bode.is_null();
  values["bode_forces"] = !bode.is_null() && bode.at("forces").get<bool>();
  values["bode_limit"] = !bode.is_null() && !bode.at("limit").is_null();
}

}  // namespace

Campbell campbell_of(const scene::Scene& scene, RotorAnalysis analysis, std::optional<double> range,
                     const std::function<void(double)>& progress) {
  constexpr int kSpeeds = 161;
  constexpr double kAccuracy = 1e-5;  // relative accuracy of the curves, finer than a line
  const double top = range.value_or(campbell_range(scene, analysis));
  auto branches = whirl_branches(condensed(analysis.system, top, kAccuracy),
                                 even_speeds(top, kSpeeds), progress);
  return {std::move(analysis), top, std::move(branches)};
}

std::string modes_page(const scene::Scene& scene, const Campbell& campbell) {
  const RotorAnalysis& analysis = campbell.analysis;
  json data{{"rotor", modes_plots(scene, campbell)}};
  const std::vector<StiffnessMap> maps = stiffness_maps(scene);
  data["rotor"]["stiffness"] = stiffness_data(maps);
  const json loops = loop_values(analysis);
  if (!loops.empty()) data["loops"] = loop_plots(analysis);
  json values = page_frame({scene.name, "whirl of the free rotor",
                            "Where does it whirl, and where does it stay stable?"},
                           data);
  values["hash"] = scene::scene_hash(scene);
  values["cards"] = json::array(
      {running_card(scene, analysis), critical_card(analysis), stability_card(scene, analysis)});
  add_response_cards(analysis, values["cards"]);
  add_rub_cards(analysis, values["cards"]);
  values["top"] = rpm_text(campbell.range);
  values["beyond"] = beyond_text(analysis, campbell.range);
  values["has_shapes"] = analysis.shapes.has_value();
  values["planes"] = planes_values(analysis);
  add_bode_place(data.at("rotor").at("bode"), "data-of=\"rotor\"", values);
  values["peaks"] = peak_rows(data.at("rotor").at("bode"));
  values["has_peaks"] = !values["peaks"].empty();
  values["stiffness_maps"] = stiffness_values(scene, maps);
  values["spectra"] = list_of(analysis.spectra, spectrum_values);
  values["critical"] = critical_values(analysis);
  values["stability"] = stability_text(analysis);
  values["has_torsion"] = !analysis.torsion.empty();
  values["torsion"] = torsion_values(analysis.torsion);
  values["loops"] = loops;
  values["has_loops"] = !loops.empty();
  values["text"] = scene.text;
  return fill_page(modes_html(), values);
}

RotorSection rotor_section(const scene::Scene& scene) {
  constexpr int kWhirlShapes = 4;  // for each sense
  RotorSection section;
  section.values = {{"has_campbell", false}, {"has_shapes", false},
                    {"beyond", ""},          {"speed", rpm_text(std::abs(scene.rotor.speed))},
                    {"has_bode", false},     {"bode_forces", false},
                    {"bode_limit", false},   {"bode_place", ""},
                    {"refusal", ""}};
  try {
    const Campbell campbell = campbell_of(scene, analyse_free_rotor(scene, {}));
    section.data = modes_plots(scene, campbell);
    section.values["has_campbell"] = true;
    section.values["has_shapes"] = campbell.analysis.shapes.has_value();
    section.values["beyond"] = beyond_text(campbell.analysis, campbell.range);
    add_bode_place(section.data.at("bode"), "data-over=\"rotor\"", section.values);
    // The shapes at rest and the higher ones are only on the page of `modes`.
    if (campbell.analysis.shapes) {
      json& shapes = section.data["shapes"];
      shapes.erase("modes");
      std::erase_if(shapes["whirl"].get_ref<json::array_t&>(),
                    [](const json& whirl) { return whirl.at("number") > kWhirlShapes; });
    }
  } catch (const std::runtime_error& error) {
    // The page of the run must not depend on its rotor's eigenvalues.
    section.values["refusal"] = error.what();
  }
  return section;
}

}  // namespace rotorub
