#include "compare/report/modes_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/units.h"
#include "compare/modes/result.h"
#include "compare/report/loop_page.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/report/response_plots.h"
#include "compare/result/result.h"
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

// The data of a rotor's plots, with the words that belong to them.
json rotor_data(const scene::Scene& scene, const Campbell& campbell) {
  json data = modes_plots(scene, campbell);
  data["words"] = {{"top", rpm_text(campbell.range)},
                   {"speed", rpm_text(std::abs(scene.rotor.speed))},
                   {"beyond", beyond_text(campbell.analysis, campbell.range)}};
  return data;
}

json cards_of(const scene::Scene& scene, const RotorAnalysis& analysis) {
  json cards = {running_card(scene, analysis), critical_card(analysis),
                stability_card(scene, analysis)};
  add_response_cards(analysis, cards);
  add_rub_cards(analysis, cards);
  return cards;
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
  const result::Section found = modes_result(scene.name, analysis);
  json rotor = rotor_data(scene, campbell);
  rotor["stiffness"] = stiffness_data(scene);
  const json loops = loop_plots(analysis);
  constexpr const char* lead =
      "Small whirl of the rotor in its bearings, without contact: eigenvalues of the gyroscopic "
      "system with external and rotating damping, at a constant spin speed.{} Forward whirl turns "
      "with the spin, backward whirl against it.";
  json parts = {
      {{"cards", cards_of(scene, analysis)}},
      {{"lead", fmt::format(lead, analysis.shapes ? " The shaft is not truncated to the modes kept."
                                                  : "")}},
      {{"class", "plots"}, {"parts", {{{"plots", "rotor"}}}}}};
  if (!loops.empty()) parts.push_back({{"class", "plots"}, {"parts", loop_parts(loops)}});
  json sheets = page_json(found);
  const json peaks = page_json(result::Section{.parts = peak_parts(rotor.at("bode"))});
  sheets.insert(sheets.end(), peaks.begin(), peaks.end());
  sheets.push_back({{"summary", "The scene's text"}, {"pre", scene.text}});
  parts.push_back({{"class", "sheets"}, {"parts", sheets}});
  const bool is_sheared =
      scene.rotor.geometry && scene.rotor.geometry->theory == scene::ShaftTheory::kTimoshenko;
  return laid_out_page(
      {scene.name, "whirl of the free rotor",
       "Where does it whirl, and where does it stay stable?"},
      found, parts, {{"rotor", rotor}, {"loops", loops}},
      fmt::format("Scene {}. Limits: {} shaft with rotary inertia, small deflections, no contact.",
                  scene::scene_hash(scene), is_sheared ? "Timoshenko" : "Euler-Bernoulli"));
}

json rotor_section(const scene::Scene& scene) {
  constexpr int kWhirlShapes = 4;  // for each sense
  try {
    json data = rotor_data(scene, campbell_of(scene, analyse_free_rotor(scene, {})));
    // The shapes at rest and the higher ones are only on the page of `modes`.
    json& shapes = data["shapes"];
    if (shapes.is_null()) return data;
    shapes.erase("modes");
    std::erase_if(shapes["whirl"].get_ref<json::array_t&>(),
                  [](const json& whirl) { return whirl.at("number") > kWhirlShapes; });
    return data;
  } catch (const std::runtime_error& error) {
    // The page of the run must not depend on its rotor's eigenvalues.
    return {{"refusal", error.what()}};
  }
}

}  // namespace rotorub
