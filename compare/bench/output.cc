#include "compare/bench/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/bench/work_precision.h"
#include "compare/figures/figure.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub::bench {
namespace {

using nlohmann::json;
using result::Data;
using result::Item;
using result::Section;
using result::Sentence;
using result::Table;

json wall_json(const WallTime& wall) {
  if (wall.repeats == 0) return nullptr;
  return {{"median", kMilli * wall.median},
          {"low", kMilli * wall.low},
          {"high", kMilli * wall.high},
          {"repeats", wall.repeats}};
}

json settled_json(const Settled& s) {
  return {{"attractor", rotorub::to_string(s.attractor)},
          {"contact_share", number_or_null(s.contact_share)},
          {"whirl_frequency", number_or_null(s.whirl_frequency)}};
}

json reference_json(const Reference& r) {
  return {{"source", r.source},
          {"error", r.error},
          {"event_distance", r.event_distance},
          {"rows", r.times.size()},
          {"settled", settled_json(settled(r.trajectory))},
          {"impulse_total", number_or_null(r.trajectory.statistics.impulse_total)}};
}

json level_json(const Level& level, const std::vector<Point>& points) {
  json engines = json::array();
  for (const Best& best : level.engines) {
    const Point& p = points[best.point];
    engines.push_back({{"engine", best.engine},
                       {"setting", p.setting.setting},
                       {"step", number_or_null(p.setting.step)},
                       {"position_error", number_or_null(p.errors->position)},
                       {"wall_ms", 1e3 * best.seconds},
                       {"ratio", best.seconds / level.engines.front().seconds}});
  }
  const auto verdict = [](std::optional<bool> v) { return v ? json(*v) : json(nullptr); };
  return {{"clearance_share", level.share},
          {"error", level.error},
          {"judged", level.judged},
          {"native_is_fastest", verdict(native_is_fastest(level))},
          {"rigid_is_fastest_mujoco", verdict(rigid_is_fastest_mujoco(level))},
          {"engines", engines}};
}

json stability_json(const StabilityMap& map) {
  json cells = json::array();
  for (const StabilityCell& c : map.cells) {
    cells.push_back({{"engine", c.engine},
                     {"friction", c.friction},
                     {"step", c.step},
                     {"stiffness", c.stiffness > 0.0 ? json(c.stiffness) : json(nullptr)},
                     {"outcome", to_string(c.judgement.outcome)},
                     {"reason", c.judgement.reason}});
  }
  return {{"engines", map.engines},
          {"steps", map.steps},
          {"stiffnesses", map.stiffnesses},
          {"frictions", map.frictions},
          {"cells", cells}};
}

json restitution_json(const std::vector<RestitutionRow>& rows) {
  json all = json::array();
  for (const RestitutionRow& r : rows) {
    all.push_back({{"asked", r.asked},
                   {"engine", r.engine},
                   {"setting", r.setting},
                   {"got", r.failure.empty() ? number_or_null(r.got) : json(nullptr)},
                   {"reason", r.failure}});
  }
  return all;
}

json point_json(const Point& p) {
  const auto error = [&](auto member) {
    return p.errors ? number_or_null(*p.errors.*member) : json(nullptr);
  };
  const auto metric = [&](double Metrics::*member) {
    return p.metrics ? number_or_null(*p.metrics.*member) : json(nullptr);
  };
  const auto cost = [&](double value) {
    return p.wall.repeats > 0 ? number_or_null(value) : json(nullptr);
  };
  return {{"engine", p.setting.engine},
          {"setting", p.setting.setting},
          {"step", number_or_null(p.setting.step)},
          {"outcome", to_string(p.judgement.outcome)},
          {"reason", p.judgement.reason},
          {"position_error", error(&PointErrors::position)},
          {"force_error", error(&PointErrors::force)},
          {"impulse_error", error(&PointErrors::impulse)},
          {"limit_error", number_or_null(p.limit_error)},
          {"penetration", metric(&Metrics::max_penetration)},
          {"predicted_penetration", metric(&Metrics::whirl_penetration)},
          {"energy_residual", metric(&Metrics::energy_residual)},
          {"residuals", p.metrics ? residuals_json(p.metrics->residuals) : json(nullptr)},
          {"settled", p.metrics ? settled_json(p.metrics->settled) : json(nullptr)},
          {"steps", p.steps},
          {"us_per_step", cost(p.us_per_step())},
          {"real_time_factor", cost(p.real_time_factor())},
          {"wall_ms", wall_json(p.wall)}};
}

constexpr int kEngine = 20;  // for "mujoco-cone-coulomb"

std::string others_text(const Level& level) {
  std::vector<std::string> others;
  for (const Best& best : level.engines | std::views::drop(1))
    others.push_back(
        fmt::format("{} ×{:.3g}", best.engine, best.seconds / level.engines.front().seconds));
  return fmt::format("   {}{}",
                     others.empty() ? "alone" : fmt::format("{}", fmt::join(others, ", ")),
                     level.judged ? "" : "  (at the reference's own error)");
}

// Levels finer than those of a headline are left out on the terminal.
Table levels_table(const SceneBench& bench) {
  Table table{"levels/#/{column}",
              {{.heading = "level", .width = -9},
               {.heading = "fastest", .width = -kEngine},
               {.heading = "setting", .width = -24},
               {.heading = "median", .width = 13},
               {.heading = "   others"}}};
  for (const Level& level : bench.levels) {
    result::Row row{.items = {{.text = fmt::format("{:.0e}", level.share)}},
                    .data = level_json(level, bench.points),
                    .seen = in_headline(level) ? result::kAll : result::kNotTerminal};
    if (level.engines.empty()) {
      row.items.push_back({.text = "no engine reaches it"});
      if (!level.judged) row.note = {.text = "at the reference's own error", .seen = result::kPage};
    } else {
      const Best& first = level.engines.front();
      const Tone tone = *native_is_fastest(level) ? Tone::kGood : Tone::kBad;
      row.items.push_back({.text = first.engine, .tone = tone});
      row.items.push_back({.text = setting_text(bench.points[first.point].setting)});
      row.items.push_back({.text = fmt::format("{:.4g} ms", kMilli * first.seconds)});
      row.items.push_back({.text = others_text(level)});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table series_table(const SceneBench& bench) {
  Table table{"series/#/{column}",
              {{"engine", "engine and setting", -kEngine - 2, result::kAll, "engine"},
               {"setting", "", -18, result::kAll, "setting"},
               {"order", "order", 6},
               {.heading = "µs/step", .width = 10},
               {.heading = "least error", .width = 12},
               {.heading = "  outcomes"}}};
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    const std::string cost = s.us_per_step > 0.0 ? fmt::format("{:.3g}", s.us_per_step) : "–";
    const std::string least =
        s.best ? fmt::format("{:.1e} m", bench.points[*s.best].errors->position) : "–";
    table.rows.push_back(
        {.items = {{s.engine},
                   {s.setting},
                   {number_or_null(s.order), s.order ? fmt::format("{:.2f}", *s.order) : "–"},
                   {.text = cost},
                   {.text = least},
                   {.text = "  " + outcomes_text(s)}},
         .note = {.text = s.reason, .lead = "      "}});
  }
  return table;
}

// Explains what the table of series leaves open.
std::vector<result::Part> series_notes(const SceneBench& bench) {
  const std::vector<Series> all = series_of(bench.points, bench.telling_errors());
  const bool unfitted = std::ranges::any_of(all, [&](const Series& s) {
    return !s.order && !s.points.empty() && bench.points[s.points.front()].setting.step;
  });
  const bool stiff = std::ranges::any_of(
      all, [](const Series& s) { return s.setting.find("K ") != std::string::npos; });
  std::vector<result::Part> notes;
  if (unfitted) {
    notes.emplace_back(Sentence{
        .text = "An order needs at least three steps whose errors are well above the reference's "
                "own and below the clearance.",
        .lead = "  order –: "});
  }
  if (stiff) {
    notes.emplace_back(Sentence{
        .text = "Stiffness of MuJoCo's soft contact in 1/s² (solref=\"-K -B\").", .lead = "  K: "});
  }
  return notes;
}

// ---------------------------------------------------------------- on the page alone
Sentence page_heading(const char* text) {
  return {.text = text, .seen = result::kPage, .role = result::Role::kHeading};
}
Sentence page_text(std::string text) { return {.text = std::move(text), .seen = result::kPage}; }

Item outcome_item(const Judgement& judgement) {
  switch (judgement.outcome) {
    case Outcome::kOk:
      return {.text = "fine", .tone = Tone::kGood};
    case Outcome::kChatter:
      return {.text = "bouncing", .tone = Tone::kPart, .note = judgement.reason};
    case Outcome::kWrongAttractor:
      return {.text = "wrong", .tone = Tone::kBad, .note = judgement.reason};
    case Outcome::kDiverged:
      return {.text = "diverged", .tone = Tone::kBad, .note = judgement.reason};
    case Outcome::kRefused:
      break;
  }
  return {.text = "refused", .tone = Tone::kPart, .note = judgement.reason};
}

// A table per friction, a row per contact model and stiffness.
std::vector<result::Part> stability_parts(const StabilityMap& map) {
  std::vector<result::Part> parts{
      page_heading("Stability of MuJoCo's contact: step, stiffness, friction"),
      page_text("How the run has ended, against event at the same friction: fine, bouncing, wrong "
                "(another attractor) or diverged. Rows: stiffness of the soft contact (direct "
                "solref, 1/s²; the default solref of MuJoCo has 2500); the rigid one has none.")};
  auto cell = map.cells.begin();
  for (const double friction : map.frictions) {
    Table table{.columns = {{.heading = "contact", .width = -kEngine},
                            {.heading = "stiffness", .width = 12}},
                .seen = result::kPage};
    for (const double step : map.steps)
      table.columns.push_back({.heading = time_text(step), .width = -10});
    while (cell != map.cells.end() && cell->friction == friction) {
      result::Row row{.items = {{cell->engine}, {.text = "–"}}};
      if (cell->stiffness > 0.0) row.items[1].text = fmt::format("{:g}", cell->stiffness);
      for (std::size_t k = 0; k < map.steps.size() && cell != map.cells.end(); ++k, ++cell)
        row.items.push_back(outcome_item(cell->judgement));
      table.rows.push_back(std::move(row));
    }
    parts.insert(parts.end(), {Sentence{.text = "friction " + short_number(friction),
                                        .seen = result::kPage,
                                        .role = result::Role::kCaption},
                               table});
  }
  return parts;
}

// A row per restitution asked for, a column per contact model.
Section restitution_section(const std::vector<RestitutionRow>& rows) {
  Table table{.columns = {{.heading = "asked", .width = 8}}};
  for (const RestitutionRow& r : rows) {
    const std::string asked = fmt::format("{:.1f}", r.asked);
    if (table.rows.empty() || table.rows.back().items.front().text != asked)
      table.rows.push_back({.items = {{.text = asked}}});
    if (table.rows.size() == 1)
      table.columns.push_back(
          {.heading = r.setting.empty() ? r.engine : r.engine + ", " + r.setting, .width = 12});
    table.rows.back().items.push_back(
        {.text = r.failure.empty() ? fmt::format("{:.4f}", r.got) : r.failure});
  }
  return {"restitution",
          {page_text("A mass of 2 kg at 0.5 m/s hits a fixed ring, with a step of 10 µs. MuJoCo's "
                     "soft contact can be calibrated: stiffness and damping of a direct solref "
                     "follow from the restitution asked for. One as stiff as the step allows (16 "
                     "steps a bounce) meets it less well, and the default bounces with e⁻² "
                     "whatever is asked."),
           table},
          result::kPage,
          "Restitution asked and got"};
}

Section engines_section() {
  Table table{.columns = {{.width = -kEngine}, {}}};
  for (const BenchEngine& e : bench_engines())
    table.rows.push_back(
        {.items = {{e.name}, {.text = e.missing.empty() ? e.what : "not here: " + e.missing}}});
  return {"engines", {table}, result::kPage, "Who is who"};
}

}  // namespace

Section scene_section(const SceneBench& bench) {
  json points = json::array(), engines = json::array(), missing = json::array();
  for (const Point& p : bench.points) points.push_back(point_json(p));
  for (const BenchEngine& e : bench.engines) {
    engines.push_back({{"engine", e.name}, {"family", to_string(e.family)}, {"what", e.what}});
  }
  for (const BenchEngine& e : bench_engines()) {
    if (!e.missing.empty()) missing.push_back({{"engine", e.name}, {"reason", e.missing}});
  }
  const std::string head = fmt::format(
      "{:.4g} s; errors against {} (its own: {:.1e} m), levels as shares of the clearance {:.3g} "
      "mm",
      bench.scene.run.end, bench.reference.source, bench.reference.error,
      kMilli * bench.clearance());
  Section section{
      "scenes/#",
      {Data{"",
            {{"scene", bench.scene.name},
             {"scene_hash", scene::scene_hash(bench.scene)},
             {"clearance", bench.clearance()},
             {"reference", reference_json(bench.reference)},
             {"engines", engines},
             {"missing_engines", missing},
             {"points", points},
             {"interrupted", bench.interrupted}}},
       Sentence{.text = head, .lead = scene::printable(bench.scene.name) + ": ", .indent = 2},
       page_text(std::string("The reference settles to: ") +
                 rotorub::to_string(settled(bench.reference.trajectory).attractor)),
       page_heading("Fastest at each level of error"), Sentence{}, levels_table(bench), Sentence{},
       // The page has this sentence at its top.
       Sentence{.text = verdict_text(bench.levels),
                .lead = "  ",
                .place = "verdict",
                .seen = result::kNotPage},
       page_heading("Engines and settings"), Sentence{}, series_table(bench)},
      result::kAll,
      bench.scene.name};
  section.add(series_notes(bench));
  if (bench.stability) {
    section.add({Data{"stability", stability_json(*bench.stability)}});
    section.add(stability_parts(*bench.stability));
  }
  return section;
}

Section result_of(const Machine& machine, const std::vector<SceneBench>& benches,
                  const std::vector<RestitutionRow>& restitution) {
  Section result{.parts = {Data{"machine",
                                {{"processor", machine.processor},
                                 {"threads", machine.threads},
                                 {"instructions", machine.instructions},
                                 {"compiler", machine.compiler},
                                 {"mujoco_version", machine.mujoco}}},
                           Data{"scenes", json::array()}}};
  for (const SceneBench& bench : benches) result.add({scene_section(bench)});
  if (!restitution.empty())
    result.add(
        {Data{"restitution", restitution_json(restitution)}, restitution_section(restitution)});
  result.add({engines_section()});
  return result;
}

std::string missing_text() {
  std::string text;
  for (const BenchEngine& engine : bench_engines()) {
    if (!engine.missing.empty()) {
      text += fmt::format("{} is left out: {}\n", engine.name, engine.missing);
    }
  }
  return text;
}

}  // namespace rotorub::bench
