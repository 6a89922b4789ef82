#include "compare/report/linear_maps.h"

#include "compare/base/json.h"
#include "compare/modes/rub_analysis.h"
#include "compare/report/plot_points.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::RubKind;
using rub::RubPoint;
using rub::StandingRub;

template <RubKind kind, class Value>
json of_leading(const RubPoint& point, Value value) {
  const StandingRub* leading = point.leading(kind);
  return leading ? number_or_null(value(*leading)) : json();
}

double growth(const StandingRub& r) { return r.stability.growth; }
double pair_frequency(const StandingRub& r) { return r.stability.frequency; }
double force(const StandingRub& r) { return r.rub.normal_force; }
double whirl(const StandingRub& r) { return r.rub.whirl; }

struct RubFigure {
  const char* name;
  json (*value)(const RubPoint&);
};
constexpr RubFigure kRubFigures[] = {
    {"attractors", [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    {"rub_growth", [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
    {"rub_frequency",
     [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, pair_frequency); }},
    {"rub_force", [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, force); }},
    {"whip_growth", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, growth); }},
    {"whip_whirl", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, whirl); }},
    {"whip_force", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, force); }},
    {"rolling_force", [](const RubPoint& p) { return of_leading<RubKind::kRolling>(p, force); }},
    {"free_orbit",
     [](const RubPoint& p) { return p.orbit ? number_or_null(*p.orbit / p.clearance) : json(); }},
};

}  // namespace

json rub_columns(const std::vector<std::optional<RubPoint>>& points) {
  json columns = json::object();
  for (const RubFigure& figure : kRubFigures) {
    columns[figure.name] = list_of(points, [&](const std::optional<RubPoint>& point) {
      return point ? figure.value(*point) : json();
    });
  }
  return columns;
}

}  // namespace rotorub
