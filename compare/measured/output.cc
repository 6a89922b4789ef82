#include "compare/measured/output.h"

#include <fmt/format.h>

#include <deque>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/figures/contact_kind.h"

namespace rotorub {
namespace {

using nlohmann::json;

const char* word_of(AngleFrom from) {
  constexpr const char* kWords[] = {"given", "found", "no pair", "circle"};
  return kWords[static_cast<int>(from)];
}

std::vector<ColumnMeaning> make_measured_keys() {
  static std::deque<std::string> names;  // storage for the keys' names
  std::vector<ColumnMeaning> keys = {
      {"file", "", "the file given to --measured", ""},
      {"samples", "", "number of samples in the record", ""},
      {"interval", "s", "median time between samples", ""},
      {"alignment.shift", "s", "scene time minus record time", ""},
      {"alignment.shift_from", "", "found or given", ""},
      {"alignment.shift_error", "s", "standard deviation; null: given", ""},
      {"alignment.angle", "rad", "angle of the sensors' x axis in the scene, positive from x to y",
       ""},
      {"alignment.angle_from", "",
       "found, given, no pair (x and y are not both measured) or circle (uncertain)", ""},
      {"alignment.angle_error", "rad", "as shift_error; null: not found", ""},
      {"alignment.turn_for_shift", "rad/s",
       "turn of the frame that compensates a shift of a circle; or null", ""},
      {"alignment.by", "", "quantities that were fitted", ""},
      {"alignment.correlation", "", "correlation with the native run; null: nothing moves", ""},
      {"alignment.residual", "", "rms of record less run, divided by the run's rms", ""},
      {"alignment.gain", "", "rms of the record divided by the run's; null: nothing moves", ""},
      {"alignment.next", "", "shift and correlation of the second-best shift; null: none", ""},
      {"alignment.ambiguous", "",
       "the second-best shift leaves less than twice the residual, or less than 5 %", ""},
      {"alignment.other_size", "",
       "shift, correlation and gain of a better match except for size; or null", ""},
      {"alignment.mirrored", "",
       "shift, angle, residual and option (flag) if y reversed leaves less than half; or null", ""},
      {"columns.<name>.good", "", "samples compared", ""},
      {"columns.<name>.missing", "", "samples without a value", ""},
      {"columns.<name>.clipped", "", "samples at the sensor's limit", ""},
      {"columns.<name>.runs.<run>.rms", "as the column", "rms of record less run about its mean",
       ""},
      {"columns.<name>.runs.<run>.offset", "as the column", "mean of record less run", ""},
      {"columns.<name>.runs.<run>.share", "",
       "that rms divided by the run's; null: the run does not move", ""},
      {"figures.<name>.measured", "as the figure", "value of the record; absent if not measured",
       ""},
      {"figures.<name>.bound", "", "at least or at most, if the sensor was at its limit", ""},
      {"figures.<name>.runs.<run>", "as the figure", "value of the run at the record's samples",
       ""},
  };
  for (const FigureText& f : measured_figures()) {
    names.push_back(fmt::format("figures.{}", f.key));
    keys.push_back({names.back(), figure_si_unit(f), f.meaning, ""});
  }
  keys.push_back({"remarks", "", "what was left out, and why", ""});
  return keys;
}

// Text of a cell with a blank before it, so that long numbers do not run together.
std::string apart(const std::string& text) { return " " + text; }

// A table with a column for the record and one for each run. With native and four contact models it
// has 80 columns.
result::Table record_table(const MeasuredRun& run, std::string place, std::string heading,
                           result::Column record) {
  record.width = 9;
  result::Table table{std::move(place), {{"", std::move(heading), -29}, std::move(record)}};
  for (const std::string& label : run.labels) {
    const ContactKind* kind = contact_kind(label);
    const std::string name = kind ? kind->heading : label;
    table.columns.push_back({"runs/" + label, apart(name), 8,
                             name.empty() ? result::kNotTerminal : result::kAll, label});
  }
  return table;
}

// The unit of a quantity in texts; written value = SI value * per_unit.
struct WrittenUnit {
  const char* unit;
  double per_unit;
};
WrittenUnit written_unit(const Measurable& what) {
  if (what.unit() == "m") return {"µm", 1e6};
  if (what.unit() == "rad/s") return {"rpm", kRpm};
  return {what.unit() == "N" ? "N" : "A", 1.0};
}

// The difference of a column from a run, and the same relative to the run's deviation: "4.1 %".
std::string residual_text(const Measurable& what, double value) {
  return short_number(value * written_unit(what).per_unit);
}
std::string share_text(const ColumnResidual& residual) {
  return residual.share ? fmt::format("{:.3g} %", 100.0 * *residual.share) : std::string("–");
}

}  // namespace

json alignment_json(const Alignment& a) {
  json next = nullptr, other = nullptr, mirrored = nullptr;
  if (a.next) next = {{"shift", a.next->shift}, {"correlation", a.next->correlation}};
  if (a.other_size) {
    other = {{"shift", a.other_size->shift},
             {"correlation", a.other_size->correlation},
             {"gain", a.other_size->gain}};
  }
  if (a.mirrored) {
    mirrored = {{"shift", a.mirrored->shift},
                {"angle", a.mirrored->angle},
                {"residual", a.mirrored->residual},
                {"flag", a.mirrored->flag}};
  }
  return {{"shift", a.shift},
          {"shift_from", a.shift_found ? "found" : "given"},
          {"shift_error", number_or_null(a.shift_error)},
          {"angle", a.angle},
          {"angle_from", word_of(a.angle_from)},
          {"angle_error", number_or_null(a.angle_error)},
          {"turn_for_shift", number_or_null(a.turn_for_shift)},
          {"by", a.by},
          {"correlation", number_or_null(a.correlation)},
          {"residual", number_or_null(a.residual)},
          {"gain", number_or_null(a.gain)},
          {"next", next},
          {"ambiguous", a.ambiguous()},
          {"other_size", other},
          {"mirrored", mirrored}};
}

std::span<const ColumnMeaning> measured_keys() {
  static const std::vector<ColumnMeaning> keys = make_measured_keys();
  return keys;
}

std::string measured_value(const MeasuredFigure& f) {
  const char* sign = f.bound == Bound::kAtLeast ? "≥ " : f.bound == Bound::kAtMost ? "≤ " : "";
  return sign + figure_value(f, f.measured);
}

result::Section measured_section(const MeasuredRun& run) {
  result::Table figures = record_table(run, "figures/{row}/{column}", "at the record's samples",
                                       {"measured", apart("measured")});
  if (run.figures.empty()) figures.seen = result::kJson;
  figures.columns.push_back({.heading = "what it means", .seen = result::kPage});
  for (const MeasuredFigure& f : run.figures) {
    result::Row row{.key = f.key,
                    .items = {{figure_label(f)}, {f.measured, apart(measured_value(f))}},
                    .lead = "    ",
                    .data = {{"bound", to_string(f.bound)}}};
    for (const double value : f.runs) row.items.push_back({value, apart(figure_value(f, value))});
    row.items.push_back({.text = f.meaning});
    figures.rows.push_back(std::move(row));
  }
  // The offset is relative to the native run. The rms is taken about the offset, because a sensor's
  // zero is unknown.
  result::Table columns = record_table(run, "columns/{row}/{column}", "record less run, rms",
                                       {"", apart("offset"), 0, result::kAll, "mean, of native"});
  for (const auto& [key, title] : {std::pair{"good", "samples"}, std::pair{"missing", "missing"},
                                   std::pair{"clipped", "at the limit"}})
    columns.columns.push_back({key, "", 8, result::kNotTerminal, title});
  for (const ColumnFit& c : run.columns) {
    result::Row row{.key = std::string(c.what->name),
                    .items = {{fmt::format("{}, {}", c.what->name, written_unit(*c.what).unit)},
                              {apart(residual_text(*c.what, c.runs.front().offset))}},
                    .lead = "    "};
    result::Row shares{
        .items = {{"of its deviation"}, {}}, .lead = "      ", .seen = result::kPeople};
    for (const ColumnResidual& r : c.runs) {
      row.items.push_back(
          {{{"rms", r.rms}, {"offset", r.offset}, {"share", number_or_null(r.share)}},
           apart(residual_text(*c.what, r.rms))});
      shares.items.push_back({apart(share_text(r))});
    }
    for (const std::size_t samples : {c.good, c.missing, c.clipped})
      row.items.push_back({samples, fmt::format("{}", samples)});
    columns.rows.insert(columns.rows.end(), {std::move(row), std::move(shares)});
  }
  result::Section section{"measured",
                          {result::Data{"",
                                        {{"file", run.file},
                                         {"samples", run.samples},
                                         {"interval", run.interval},
                                         {"alignment", alignment_json(run.alignment)},
                                         {"remarks", run.remarks}}},
                           result::Sentence{fmt::format("{}, {} samples, {} apart", run.file,
                                                        run.samples, time_text(run.interval)),
                                            "  measured: "},
                           result::Sentence{alignment_text(run.alignment), "    "},
                           std::move(figures), std::move(columns)}};
  section.title = "The measured run";
  for (const std::string& remark : run.remarks) section.add({result::Sentence{remark, "    - "}});
  return section;
}

}  // namespace rotorub
