#include "compare/report/rub_figures.h"

#include <array>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/modes/rub_analysis.h"
#include "compare/report/map_page.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::RubKind;
using rub::RubPoint;
using rub::StandingRub;

template <RubKind kind, class Value>
json of_leading(const RubPoint& point, Value value) {
  const StandingRub* leading = point.leading(kind);
  return leading ? map_number(value(*leading)) : json(nullptr);
}

double growth(const StandingRub& r) { return r.stability.growth; }
double pair_frequency(const StandingRub& r) { return r.stability.frequency * kHz; }
double force(const StandingRub& r) { return r.rub.normal_force; }
double whirl(const StandingRub& r) { return r.rub.whirl * kHz; }

struct RubFigure {
  const char *name, *unit, *meaning;
  bool word, is_signed;
  json (*value)(const RubPoint&);
};

const std::array kRubFigures = {
    RubFigure{kLinearAttractors, "", "what is stable by its eigenvalues, and so may coexist", true,
              false, [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    RubFigure{kLinearGrowth, "1/s",
              "synchronous rub, of its least stable pair: below 0 it is stable", false, true,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
    RubFigure{"linear: rub, frequency", "Hz",
              "synchronous rub, of that pair, seen from the turning frame", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, pair_frequency); }},
    RubFigure{"linear: rub, normal force", "N", "synchronous rub", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, force); }},
    RubFigure{"linear: whip, growth rate", "1/s",
              "backward whip that slips, load left out: below 0 it is stable", false, true,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, growth); }},
    RubFigure{"linear: whip, whirl", "Hz", "backward whip, its speed", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, whirl); }},
    RubFigure{"linear: whip, normal force", "N", "backward whip", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, force); }},
    RubFigure{"linear: rolling, normal force", "N",
              "backward rolling at the spin's pace, load left out", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kRolling>(p, force); }},
    RubFigure{"linear: free orbit", "", "of the clearance, without contact", false, false,
              [](const RubPoint& p) {
                return p.orbit ? map_number(*p.orbit / p.clearance) : json(nullptr);
              }},
};

}  // namespace

json rub_figures() {
  json all = json::array();
  for (const RubFigure& f : kRubFigures) {
    all.push_back(map_figure(f.name, f.unit, f.meaning, f.word, f.is_signed));
  }
  return all;
}

std::vector<json> rub_values(const RubPoint& point) {
  std::vector<json> values;
  for (const RubFigure& f : kRubFigures) values.push_back(f.value(point));
  return values;
}

json figure_choices(const std::vector<std::string>& first) {
  constexpr std::array kWhich = {"first", "second", "third", "fourth"};
  json maps = json::array();
  for (std::size_t k = 0; k < first.size(); ++k) {
    maps.push_back({{"first", first[k]}, {"which", kWhich.at(k)}});
  }
  return maps;
}

}  // namespace rotorub
