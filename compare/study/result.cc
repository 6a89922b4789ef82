#include "compare/study/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/measured/output.h"
#include "compare/model_error/model_error.h"
#include "compare/run_files/summary.h"
#include "compare/study/answer.h"
#include "compare/study/figure_tables.h"
#include "compare/study/resync_text.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {

// Structs that are written to JSON member by member.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Extrapolation, values, limit, order, uncertainty, valid, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Impact, t, normal_impulse, friction_impulse)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Timing, us_per_step, median, lowest, highest)

namespace {

using nlohmann::json;
using result::Data, result::Item, result::Part, result::Row, result::Section, result::Sentence,
    result::Table;

json divergence_json(const Divergence& d) {
  return {{"threshold", d.threshold},
          {"time", number_or_null(d.time)},
          {"max_distance", d.max_distance},
          {"rms_distance", d.rms_distance}};
}

json side_json(const scene::Scene& scene, const Side& side) {
  json limits = json::object();
  for (std::size_t k = 0; k < side.limits.size(); ++k) {
    if (figures()[k].split) limits[figures()[k].key] = side.limits[k];
  }
  return {{"engine", side.engine},
          {"solref", side.solref.empty() ? json(nullptr) : json(side.solref)},
          {"summary", summary_json(scene, side.trajectory)},
          {"metrics", metrics_json(side.metrics)},
          {"step_to_zero", limits},
          {"timing", side.timing}};
}

// Without a shadow: null figures and a reason.
json shadow_json(const SceneComparison& c) {
  if (!c.shadow.side) return {{"figures", nullptr}, {"reason", c.shadow.absent}};
  return {{"engine", c.shadow.side->engine},
          {"commands_of", c.shadow.driven ? json(c.models.front().run.label) : json(nullptr)},
          {"summary", summary_json(c.scene, c.shadow.side->trajectory)}};
}

// The answer to the user's question, one row per contact model. A page adds the errors by source.
Table answer_table(const SceneComparison& c, const std::vector<const ComparedModel*>& models) {
  const bool modes = c.model_error && !c.model_error->figures.empty();
  constexpr auto kPage = result::kPage;
  const auto errors_seen = c.mode == CompareMode::kResync ? result::kJson : kPage;
  Table table{"answer/#/{column}",
              {{"question", "Can MuJoCo's contact forces be trusted?", -55, result::kAll,
                "MuJoCo's contact"},
               {"trusted", "trusted", -15},
               {"why", "", 0, result::kNotTerminal, "why"},
               {"", "off by the contact model", 0, errors_seen},
               {"", "off by the step", 0, errors_seen},
               {"", "off by the modes kept", 0, modes ? errors_seen : result::kJson},
               {"us_per_step", "µs a step", 0, result::kAll, "time of a step, µs"}}};
  for (const ComparedModel* m : models) {
    const AnswerRow row = answer_row(c, *m);
    const ThreeErrors errors = three_errors(c, *m);
    const bool timed = row.us_per_step > 0.0;
    table.rows.push_back(
        {.items = {{row.question, row.question + "? (" + row.contact + ")"},
                   {row.verdict.word, "", row.verdict.tone},
                   {.value = row.why, .beside = row.decides ? "decides the exit code" : ""},
                   {.text = error_text(errors.contact)},
                   {.text = error_text(errors.step)},
                   {.text = error_text(errors.modes.value_or(LargestError()))},
                   {timed ? json(row.us_per_step) : json(nullptr), timed ? "" : "-"}},
         .lead = row.decides ? "> " : "  ",
         .note = {.text = row.why, .lead = "      ", .seen = result::kTerminal},
         .data = {{"scene", c.scene.name},
                  {"contact", row.contact},
                  {"decides_exit_code", row.decides},
                  {"evidence", row.evidence.empty() ? json(nullptr) : json(row.evidence)}}});
  }
  return table;
}

std::vector<const ComparedModel*> written_order(const SceneComparison& c) {
  std::vector<const ComparedModel*> models;
  for (const ComparedModel& m : c.models) models.push_back(&m);
  return models;
}

// Before any figure. People read the rows in another order than JSON has them.
std::vector<Part> answer_parts(const SceneComparison& c) {
  std::vector<Part> shown;
  const auto add = [&](const std::string& text, const char* lead = "    ") {
    if (!text.empty()) shown.emplace_back(Sentence{text, lead});
  };
  // A page answers in one sentence of these clauses.
  for (const AnswerRow& row : sentence_rows(c)) {
    const std::string plain = row.plain.empty() ? "" : fmt::format(" ({})", row.plain);
    shown.emplace_back(
        Sentence{.text = fmt::format("{}: {}{}", row.question, row.verdict.word, plain),
                 .tone = row.verdict.tone,
                 .toned = row.verdict.word,
                 .seen = result::kPage});
  }
  Table written = answer_table(c, written_order(c)), table = answer_table(c, reading_order(c));
  written.seen = result::kJson;
  table.seen = result::kPeople;
  shown.emplace_back(std::move(table));
  add(whose_verdict(c), "  > ");
  for (const ComparedModel* m : reading_order(c)) add(answer_row(c, *m).evidence);
  for (const std::string& text : {cone_note(c), solref_note(c), mode_note(c)}) add(text);
  const std::vector<std::string> notes = own_notes(c);
  for (std::size_t k = 0; k < notes.size(); ++k) add(notes[k], k == 0 ? "    " : "    - ");
  return {std::move(written),
          Section{"", std::move(shown), result::kPeople, "Each contact model, and why", "answer"}};
}

// The verdict on one contact model with its reasons.
std::vector<Part> verdict_parts(const SceneComparison& c, const ComparedModel& m) {
  const auto impact = [](const std::optional<Impact>& one) { return one ? json(*one) : json(); };
  json impacts = json::array();
  for (const ImpactPair& pair : m.impacts)
    impacts.push_back({{"native", impact(pair.a)}, {"other", impact(pair.b)}});
  const VerdictWords& words = verdict_words(c, m);
  Section verdict{"differences/" + m.run.label,
                  {Data{"",
                        {{"within", m.within()},
                         {"trusted", to_string(m.trust)},
                         {"decides", c.decides(m)},
                         {"reasons", m.reasons},
                         {"divergence", divergence_json(m.divergence)},
                         {"impacts", impacts}}},
                   Sentence{.text = headline(c, m),
                            .lead = fmt::format("  {:<15}", words.word),
                            .tone = words.tone,
                            .place = "headline"}}};
  for (const std::string& reason : m.reasons)
    verdict.add({Sentence{reason, "                 - "}});
  return {Sentence{}, std::move(verdict)};
}

// The keys that the terminal does not have, and the places of the other parts.
Data scene_data(const SceneComparison& c) {
  json sides = json::object();
  for (const Side* side : c.sides()) sides[side->label] = side_json(c.scene, *side);
  return {"",
          {{"mode", to_string(c.mode)},
           {"mode_note", mode_note(c)},
           {"twins", c.twins},
           {"shadow", shadow_json(c)},
           {"own_model", c.own ? json{{"left_out", c.twin_limits}} : json(nullptr)},
           {"scene", c.scene.name},
           {"scene_hash", scene::scene_hash(c.scene)},
           {"step", c.scene.run.step},
           {"end", c.scene.run.end},
           {"status", to_string(c.status())},
           {"within", c.within()},
           {"model_error", nullptr},
           {"measured", nullptr},
           {"runs", sides},
           {"differences", json::object()},
           {"twin", divergence_json(c.twin)}}};
}

}  // namespace

nlohmann::ordered_json compare_columns_json() {
  return {{"compare.json runs.*.metrics", columns_json(metric_keys())},
          {"compare.json runs.*.summary", columns_json(summary_keys())},
          {"compare.json measured", columns_json(measured_keys())}};
}

Section comparison_result(const SceneComparison& c) {
  Section told{.parts = {scene_data(c)}};
  const std::string mode =
      c.mode == CompareMode::kLockstep ? "" : fmt::format("{}, ", to_string(c.mode));
  told.add({Sentence{
      .text = fmt::format("{}: {}step {}, {} simulated, scene {}", scene::printable(c.scene.name),
                          mode, time_text(c.scene.run.step), time_text(c.scene.run.end),
                          scene::scene_hash(c.scene)),
      .wraps = false,
      .seen = result::kTerminal}});
  told.add(answer_parts(c));
  told.add({Sentence{}});
  if (c.mode == CompareMode::kResync)
    told.add({Section{"", resync_parts(c), result::kAll, "Contact by contact", "resync"}});
  told.add({figure_section(c)});
  if (c.measured) told.add({Sentence{}, measured_section(*c.measured)});
  Section verdicts{.title = "Verdicts", .id = "verdicts"};
  // If nothing touches, one sentence for all contact models.
  const bool untouched = c.is_untouched() && c.mode != CompareMode::kResync;
  for (const ComparedModel* m : reading_order(c)) {
    Section verdict{.parts = verdict_parts(c, *m)};
    if (untouched) verdict.seen = result::kJson;
    verdicts.add({std::move(verdict)});
  }
  if (untouched) {
    const VerdictWords& words = verdict_words(c, c.models.front());
    verdicts.add({Sentence{}, Sentence{.text = no_contact_note(c),
                                       .lead = fmt::format("  {:<15}", words.word),
                                       .tone = words.tone}});
  }
  told.add({std::move(verdicts)});
  return told;
}

Section comparisons_result(const std::vector<SceneComparison>& comparisons) {
  const bool any = !comparisons.empty();
  Section told{
      .parts = {Data{"",
                     {{"answer", json::array()},  // sorts first, so the file begins with it
                      {"program", "rotorub"},
                      {"version", program_version()},
                      {"mujoco_version", mujoco_version()},
                      {"mode", to_string(any ? comparisons.front().mode : CompareMode::kLockstep)},
                      {"contact", to_string(kDefaultContact)},
                      {"tolerance", any ? comparisons.front().tolerance : 0.0},
                      {"within", any && std::ranges::all_of(comparisons, &SceneComparison::within)},
                      {"scenes", json::array()}}}},
      .seen = result::kJson};
  for (const SceneComparison& c : comparisons) {
    told.add({Data{"contact", c.models.front().run.label}});
    Section scene = comparison_result(c);
    scene.place = "scenes/#";
    told.add({answer_table(c, written_order(c)), std::move(scene)});
  }
  return told;
}

}  // namespace rotorub
