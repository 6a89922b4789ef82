#include "compare/measured/json.h"

#include <fmt/format.h>

#include <deque>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"

namespace rotorub {
namespace {

using nlohmann::json;

const char* word_of(AngleFrom from) {
  switch (from) {
    case AngleFrom::kGiven:
      return "given";
    case AngleFrom::kFound:
      return "found";
    case AngleFrom::kNoPair:
      return "no pair";
    case AngleFrom::kCircle:
      return "circle";
  }
  return "";
}

json alignment_json(const Alignment& a) {
  json next = nullptr;
  if (a.next) next = {{"shift", a.next->shift}, {"correlation", a.next->correlation}};
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
          {"next", next},
          {"ambiguous", a.ambiguous()}};
}

std::string_view si_unit_of(const MeasuredFigure& figure) {
  const std::string_view unit = figure.unit;
  if (unit == "µm") return "m";
  if (unit == "rpm") return "rad/s";
  return unit == "%" ? "" : unit;
}

std::vector<ColumnMeaning> make_measured_keys() {
  static std::deque<std::string> names;  // that the keys point to
  std::vector<ColumnMeaning> keys = {
      {"file", "", "as given to --measured", ""},
      {"samples", "", "samples of the record", ""},
      {"interval", "s", "between its samples: the median", ""},
      {"alignment.shift", "s", "added to the record's times it gives the scene's", ""},
      {"alignment.shift_from", "", "found or given", ""},
      {"alignment.shift_error", "s",
       "standard deviation, if what is left is white noise; null: given", ""},
      {"alignment.angle", "rad", "of the sensors' x axis in the scene, from x to y positive", ""},
      {"alignment.angle_from", "",
       "found, given, no pair (no x with its y is measured: 0) or circle (it cannot be "
       "distinguished from a shift: 0)",
       ""},
      {"alignment.angle_error", "rad", "as shift_error; null: not found", ""},
      {"alignment.turn_for_shift", "rad/s",
       "what a shift is made up by of the angle, in a motion near to a circle; else null", ""},
      {"alignment.by", "", "the quantities that it was found by", ""},
      {"alignment.correlation", "",
       "of them with the native run, means taken off; -1 to 1; null: none moves", ""},
      {"alignment.residual", "",
       "rms of what is left of them over the run's deviation from its mean", ""},
      {"alignment.next", "", "shift and correlation of the next best beyond a valley; null: none",
       ""},
      {"alignment.ambiguous", "",
       "whether it leaves less than twice what the best leaves, or less than 5 %: sqrt(1 - "
       "correlation^2)",
       ""},
      {"columns.<name>.good", "", "samples on the run that are compared", ""},
      {"columns.<name>.missing", "", "samples on the run without a value", ""},
      {"columns.<name>.clipped", "", "samples at the sensor's limit", ""},
      {"columns.<name>.runs.<run>.rms", "as the column",
       "root mean square of record less run, in the sensors' frame", ""},
      {"columns.<name>.runs.<run>.offset", "as the column", "mean of record less run", ""},
      {"columns.<name>.runs.<run>.share", "",
       "that rms over the run's deviation from its mean; null: the run does not move", ""},
  };
  keys.push_back({"figures.<name>.measured", "as the figure",
                  "of the record; a figure stands where its columns are measured", ""});
  keys.push_back({"figures.<name>.bound", "",
                  "at least or at most: the sensor was at its limit; else empty", ""});
  keys.push_back(
      {"figures.<name>.runs.<run>", "as the figure", "of the run at the record's samples", ""});
  for (const MeasuredFigure& f : measured_figures()) {
    names.push_back(fmt::format("figures.{}", f.key));
    keys.push_back({names.back(), si_unit_of(f), f.meaning, ""});
  }
  keys.push_back({"remarks", "", "what was left out, and why", ""});
  return keys;
}

}  // namespace

nlohmann::json measured_json(const MeasuredRun& run) {
  json columns = json::object(), figures = json::object();
  for (const ColumnFit& c : run.columns) {
    json runs = json::object();
    for (std::size_t r = 0; r < c.runs.size(); ++r) {
      runs[run.labels[r]] = {{"rms", c.runs[r].rms},
                             {"offset", c.runs[r].offset},
                             {"share", number_or_null(c.runs[r].share)}};
    }
    columns[std::string(c.what->name)] = {
        {"good", c.good}, {"missing", c.missing}, {"clipped", c.clipped}, {"runs", runs}};
  }
  for (const MeasuredFigure& f : run.figures) {
    json runs = json::object();
    for (std::size_t r = 0; r < f.runs.size(); ++r) runs[run.labels[r]] = f.runs[r];
    figures[f.key] = {{"measured", f.measured}, {"bound", to_string(f.bound)}, {"runs", runs}};
  }
  return {{"file", run.file},         {"samples", run.samples},
          {"interval", run.interval}, {"alignment", alignment_json(run.alignment)},
          {"columns", columns},       {"figures", figures},
          {"remarks", run.remarks}};
}

std::span<const ColumnMeaning> measured_keys() {
  static const std::vector<ColumnMeaning> keys = make_measured_keys();
  return keys;
}

}  // namespace rotorub
