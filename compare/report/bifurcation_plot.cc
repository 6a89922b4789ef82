#include "compare/report/bifurcation_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/units.h"
#include "compare/report/plot_points.h"

namespace rotorub {
namespace {

using nlohmann::json;
using sweep::BranchPoint;

constexpr double kMicronsOfSection = 1e6;  // um per m

json points_json(const std::vector<BranchPoint>& points, const sweep::Sample& sample,
                 double per_si) {
  constexpr int kPlaceDigits = 5;
  return list_of(points, [&](const BranchPoint& point) -> json {
    const std::size_t shown =
        point.period > 0
            ? std::min<std::size_t>(static_cast<std::size_t>(point.period), point.places.size())
            : point.places.size();
    std::vector<double> x, y;
    for (std::size_t k = point.places.size() - shown; k < point.places.size(); ++k) {
      x.push_back(point.places[k].real());
      y.push_back(point.places[k].imag());
    }
    return {{"value", rounded(per_si * *sample.at(point.point).front().number)},
            {"refused", point.refused},
            {"continued", point.continued},
            {"x", rounded_list(x, kMicronsOfSection, kPlaceDigits)},
            {"y", rounded_list(y, kMicronsOfSection, kPlaceDigits)},
            {"period", point.period},
            {"exponent", point.exponent ? json(rounded(*point.exponent, kPlaceDigits)) : json()}};
  });
}

std::string note_of(const sweep::Bifurcation& diagram) {
  if (!diagram.not_continued.empty())
    return fmt::format("Each value begins at the scene's own start: {}.", diagram.not_continued);
  const auto begun = [](const std::vector<BranchPoint>& points) {
    return std::count_if(points.begin(), points.end(), [](const BranchPoint& point) {
      return point.refused.empty() && !point.continued;
    });
  };
  const auto refused = std::count_if(diagram.up.begin(), diagram.up.end(),
                                     [](const BranchPoint& p) { return !p.refused.empty(); });
  std::string note = "Each value begins where the one before it ended";
  const auto again = begun(diagram.up) + begun(diagram.down) - 2;
  if (again > 0)
    note += fmt::format(", but for {} that could not and began at the scene's own start", again);
  if (refused > 0) note += fmt::format("; {} of {} values have no run", refused, diagram.up.size());
  return note + ".";
}

}  // namespace

json bifurcation_data(const sweep::Study& study, const sweep::Sample& sample,
                      const sweep::Bifurcation& diagram) {
  const sweep::Vary& vary = study.vary.front();
  const ShownUnit unit = shown_unit(vary.unit);
  return {
      {"key",
       {{"name", vary.key}, {"unit", unit.name}, {"log", vary.spacing == sweep::Spacing::kLog}}},
      {"up", points_json(diagram.up, sample, unit.per_si)},
      {"down", points_json(diagram.down, sample, unit.per_si)},
      {"note", note_of(diagram)}};
}

}  // namespace rotorub
