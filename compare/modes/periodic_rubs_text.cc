#include "compare/modes/periodic_rubs_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;
using periodic::ContactFigures;
using result::Item, result::line, result::number, result::Role;

json figures_json(const ContactFigures& f, const std::string& name) {
  return {{"name", name.empty() ? json(nullptr) : json(name)},
          {"whirl", f.whirl},
          {"mean_force", f.mean_force},
          {"largest_force", f.largest_force},
          {"largest_impulse", f.largest_impulse},
          {"impacts", f.impacts},
          {"contact_share", f.contact_share},
          {"stuck_share", f.stuck_share}};
}

constexpr double kAngleRoundOff = 1e-6;  // rad, of a whirl in one period

std::string kind_text(const PeriodicRub& rub) {
  if (rub.settled.motion.frame != 0.0) return rub.kind + ", seen in the frame of its loads";
  if (rub.settled.order < 2) return rub.kind;
  return fmt::format("{}, sub-harmonic 1/{}", rub.kind, rub.settled.order);
}

result::Table rubs_table(const PeriodicRubs& all) {
  result::Table table{.place = "rubs/#/{column}"};
  const auto add = column_adder(table, all.rubs);
  const auto main = [](const PeriodicRub& r) -> const ContactFigures& {
    return r.figures[r.contact];
  };
  add({"kind", "periodic rub", -19}, [](auto& r) { return Item{r.kind, kind_text(r)}; });
  add({"period", "period / ms", 12},
      [](auto& r) { return number(r.settled.motion.period, 7, kMilli); });
  add({"whirl", "whirl rad/s", 13}, [&](auto& r) {
    const double whirl = main(r).whirl;
    const bool goes_around = std::abs(whirl) * r.settled.motion.period > kAngleRoundOff;
    return Item{whirl, goes_around ? number(whirl, 6).text : "0"};
  });
  add({"mean_force", "force / N", 11}, [&](auto& r) { return number(main(r).mean_force, 6); });
  add({"largest_force", "largest force / N", 19},
      [&](auto& r) { return number(main(r).largest_force, 5); });
  add({"contact_share", "contact %", 11},
      [&](auto& r) { return number(main(r).contact_share, 4, 100.0); });
  add({"impacts", "impacts", 9}, [&](auto& r) {
    return Item{main(r).impacts, std::to_string(main(r).impacts)};
  });
  add({"multiplier", "multiplier", 12}, [](auto& r) { return number(r.largest_multiplier(), 4); });
  add({"stable"}, [](auto& r) {
    const bool stable = r.settled.motion.stable;
    return Item{stable, stable ? "  stable" : "  unstable"};
  });
  add({.key = "residual", .seen = result::kJson},
      [](auto& r) { return Item{r.settled.motion.residual}; });
  add({.key = "return_error", .seen = result::kJson},
      [](auto& r) { return Item{r.settled.return_error}; });
  add({.key = "run_time", .seen = result::kJson}, [](auto& r) { return Item{r.settled.run_time}; });
  add({.key = "largest_impulse", .seen = result::kJson},
      [&](auto& r) { return Item{main(r).largest_impulse}; });
  add({.key = "stuck_share", .seen = result::kJson},
      [&](auto& r) { return Item{main(r).stuck_share}; });
  add({.key = "order", .seen = result::kJson},
      [](auto& r) { return Item{r.settled.order > 0 ? json(r.settled.order) : json(nullptr)}; });
  add({.key = "frame", .seen = result::kJson},
      [](auto& r) { return Item{r.settled.motion.frame}; });
  add({.key = "multipliers", .seen = result::kJson}, [](auto& r) {
    json pairs = json::array();
    for (const std::complex<double>& m : r.settled.motion.multipliers)
      pairs.push_back({m.real(), m.imag()});
    return Item{pairs};
  });
  add({.key = "source", .seen = result::kJson}, [](auto& r) {
    return Item{fmt::format("shooting from a run: {}", fmt::join(r.starts, ", "))};
  });
  add({.key = "starts", .seen = result::kJson}, [](auto& r) { return Item{r.starts}; });
  add({.key = "contact", .seen = result::kJson}, [&](auto& r) {
    const std::string& name = all.contacts[r.contact];
    return Item{name.empty() ? json(nullptr) : json(name)};
  });
  for (std::size_t k = 0; k < all.rubs.size(); ++k) {
    json contacts = json::array();
    for (std::size_t j = 0; j < all.contacts.size(); ++j)
      contacts.push_back(figures_json(all.rubs[k].figures[j], all.contacts[j]));
    table.rows[k].data = {{"contacts", contacts}};
    std::string words = fmt::format("start{}: {}", all.rubs[k].starts.size() > 1 ? "s" : "",
                                    fmt::join(all.rubs[k].starts, ", "));
    if (!all.contacts[all.rubs[k].contact].empty())
      words += fmt::format("; contact \"{}\"", all.contacts[all.rubs[k].contact]);
    table.rows[k].note = {.text = words, .lead = "    "};
  }
  return table;
}

}  // namespace

result::Section periodic_rubs_result(const PeriodicRubs& all) {
  result::Section section{
      "", {line("\nperiodic motions to which runs settle", Role::kHeading), rubs_table(all)}};
  if (all.rubs.empty())
    section.add({result::Sentence{
        .text = all.refused.empty() ? "none" : "none can be found: " + all.refused, .lead = "  "}});
  if (!all.sampling.empty()) section.add({result::Sentence{.text = all.sampling, .lead = "  "}});
  json without = json::array();
  for (const UnsettledStart& start : all.without) {
    without.push_back({{"start", start.start}, {"reason", start.why}});
    section.add({result::Sentence{.text = fmt::format("From {}: {}.", start.start, start.why),
                                  .lead = "  "}});
  }
  const json refused = all.refused.empty() ? json(nullptr) : json(all.refused);
  section.add({result::Section{
      "periodic_rubs",
      {result::Data{"refused", refused}, result::Data{"without", without},
       result::Data{"sampling", all.sampling.empty() ? json(nullptr) : json(all.sampling)}}}});
  return section;
}

}  // namespace rotorub
