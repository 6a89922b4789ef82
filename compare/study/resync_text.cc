#include "compare/study/resync_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/format.h"

namespace rotorub {
namespace {

std::string onsets_text(const Resync& r) {
  return fmt::format("{} {}", r.onsets.size(), r.onsets.size() == 1 ? "onset" : "onsets");
}

std::string failure_text(const Resync& r, const std::string& of = {}) {
  return fmt::format("{}{} predictions did not end well, the first: {}", r.failed, of, r.failure);
}

nlohmann::json contact_json(const ContactResult& c) {
  nlohmann::json all;
  for (const ResyncFigure& f : resync_figures()) all[f.key] = c.*f.value;
  return all;
}

nlohmann::json onset_json(const PredictedOnset& o) {
  return {{"touch", o.touch},
          {"closing", o.closing},
          {"end", o.end},
          {"lasts", o.lasts},
          {"status", to_string(o.status)},
          {"native", contact_json(o.native)},
          {"other", contact_json(o.mujoco)}};
}

// In % with three digits: "0.52", "<0.001".
std::string percents(double share) {
  const double p = 100.0 * std::abs(share);
  if (p > 0.0 && p < 1e-3) return "<0.001";
  return p < 1000.0 ? fmt::format("{:.3g}", p) : fmt::format("{:.0f}", p);
}

// A signed share with three digits: "-0.52 %", "+<0.001 %".
std::string signed_percent(double share) {
  const char* sign = share > 0.0 ? "+" : share < 0.0 ? "-" : "";
  return sign + percents(share) + " %";
}

}  // namespace

std::string why(const Resync& r, double tolerance) {
  if (r.failed > 0) return failure_text(r, fmt::format(" of {}", r.onsets.size()));
  if (r.rows.empty()) return r.touches ? "contact, but no onset of it" : "nothing touches";
  std::vector<std::string> far, near;
  for (const ResyncRow& row : r.rows) {
    if (row.verdict == FigureVerdict::kOutside) {
      far.push_back(fmt::format("{} {}", row.figure->label, signed_percent(row.worst_signed)));
    } else {
      near.push_back(row.figure->label);
    }
  }
  std::string text = fmt::format("the worst of {}", onsets_text(r));
  if (far.empty()) return fmt::format("{} within {}", text, percent_text(tolerance));
  text += fmt::format(": {}", fmt::join(far, ", "));
  if (near.empty()) return text;
  return fmt::format("{}; within {}: {}", text, percent_text(tolerance), fmt::join(near, ", "));
}

std::string resync_headline(const std::string& contact, const Resync& r, double tolerance) {
  const std::string within = percent_text(tolerance);
  if (r.failed > 0) {
    return fmt::format("MuJoCo's {} contact: {} of {} could not be predicted.", contact, r.failed,
                       onsets_text(r));
  }
  if (r.rows.empty()) {
    return r.touches
               ? fmt::format("MuJoCo's {} contact has no onset: there is nothing to predict.",
                             contact)
               : fmt::format("Nothing touches in MuJoCo ({}): there is no contact to predict.",
                             contact);
  }
  const ResyncRow& off =
      *std::max_element(r.rows.begin(), r.rows.end(),
                        [](const ResyncRow& a, const ResyncRow& b) { return a.worst < b.worst; });
  const std::string worst = fmt::format("{} {} at t = {:.5g} s", off.figure->label,
                                        signed_percent(off.worst_signed), off.worst_time);
  switch (r.trust) {
    case Trust::kYes:
      return fmt::format(
          "MuJoCo's {} contact: each of {} comes out as the native model predicts it from "
          "MuJoCo's own state, within {}.",
          contact, onsets_text(r), within);
    case Trust::kAveragesOnly:
      return fmt::format(
          "MuJoCo's {} contact: on the mean of {} as the native model predicts them, within {}; "
          "single ones are not: {}.",
          contact, onsets_text(r), within, worst);
    case Trust::kNo:
    case Trust::kUndecidable:
      break;
  }
  return fmt::format(
      "MuJoCo's {} contact is outside {} of what the native model predicts from MuJoCo's own "
      "state, "
      "onset by onset: {}.",
      contact, within, worst);
}

std::vector<std::string> resync_reasons(const std::string& contact, const Resync& r) {
  std::vector<std::string> all;
  if (!r.rows.empty()) {
    const ResyncRow& impulse = r.rows.front();
    all.push_back(fmt::format(
        "impulse over {}: half of them within {} %, nine in ten within {} %, the worst {} (at t = "
        "{:.5g} s); the sum {}",
        onsets_text(r), percents(impulse.median), percents(impulse.ninetieth),
        signed_percent(impulse.worst_signed), impulse.worst_time, signed_percent(impulse.bias)));
  }
  if (r.left_out > 0) {
    all.push_back(fmt::format(
        "{} of {}'s contacts began while the rotor still lay in the ring, and are left out",
        r.left_out, contact));
  }
  if (r.failed > 0) {
    all.push_back(failure_text(r));
  }
  return all;
}

std::vector<result::Part> resync_parts(const SceneComparison& c) {
  using result::Sentence;
  std::vector<result::Part> parts{Sentence{
      .text = "  by onset; off by, in %       native    MuJoCo  median    90 %   worst    at, s",
      .wraps = false,
      .seen = result::kTerminal}};
  for (const ComparedModel& m : c.models) {
    const std::string& label = m.run.label;
    const Resync& r = *m.resync;
    result::Table table{"figures/{row}/{column}",
                        {{"", "", -27, result::kAll, "figure"},
                         {"native", "", 10, result::kAll, "native, mean"},
                         {"other", "", 10, result::kAll, "MuJoCo, mean"},
                         {"median", "", 8, result::kAll, "median off by, %"},
                         {"ninetieth", "", 8, result::kAll, "90 % within, %"},
                         {"worst", "", 8, result::kNotPage},
                         {"", "", 8, result::kPage, "worst"},
                         {"worst_time", "", 9, result::kAll, "at, s"}}};
    for (const ResyncRow& row : r.rows) {
      const ResyncFigure& f = *row.figure;
      table.rows.push_back(
          {.key = f.key,
           .items = {{figure_label(f), "", Tone::kPlain,
                      fmt::format("{} Differences: shares of {}.", f.meaning, f.relative_to)},
                     {row.native, figure_value(f, row.native)},
                     {row.mujoco, figure_value(f, row.mujoco)},
                     {row.median, percents(row.median)},
                     {row.ninetieth, percents(row.ninetieth)},
                     {row.worst, percents(row.worst)},
                     {.text = signed_percent(row.worst_signed),
                      .tone = tone_of(row.verdict),
                      .note = to_string(row.verdict)},
                     {row.worst_time, fmt::format("{:.4g}", row.worst_time)}},
           .lead = row.verdict == FigureVerdict::kOutside ? "!   " : "    ",
           .data = {{"relative_to", f.relative_to},
                    {"bias", row.bias},
                    {"worst_signed", row.worst_signed},
                    {"verdict", to_string(row.verdict)},
                    {"within", row.verdict == FigureVerdict::kWithin}}});
    }
    nlohmann::json onsets = nlohmann::json::array();
    for (const PredictedOnset& onset : r.onsets) onsets.push_back(onset_json(onset));
    parts.emplace_back(result::Section{
        "differences/" + label + "/resync",
        {result::line(fmt::format("  {}: {}", label, onsets_text(r)), result::Role::kCaption),
         std::move(table),
         result::Data{"",
                      {{"onsets", onsets},
                       {"left_out", r.left_out},
                       {"failed", r.failed},
                       {"failure", r.failure},
                       {"shortest_flight_steps", kShortestFlight},
                       {"largest_impact", r.largest_impact}}}}});
  }
  std::string judged = fmt::format(
      "  judged: the worst of each figure (!: beyond {}); values are means over the\n"
      "  onsets; differences are shares of\n",
      percent_text(c.tolerance));
  for (const ResyncFigure& f : resync_figures())
    judged += fmt::format("    {:<16} {}\n", f.label, f.relative_to);
  parts.emplace_back(
      Sentence{.text = std::move(judged), .wraps = false, .seen = result::kTerminal});
  return parts;
}

}  // namespace rotorub
