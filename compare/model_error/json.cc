#include "compare/model_error/json.h"

#include <nlohmann/json.hpp>

namespace rotorub {

using nlohmann::json;

json model_error_json(const ModelError& error) {
  const auto or_null = [](const std::optional<double>& v) { return v ? json(*v) : json(nullptr); };
  json all = {{"modes", error.modes}};
  if (!error.reason.empty()) {
    all["reason"] = error.reason;
    return all;
  }
  json by_figure = json::object();
  for (const FigureLimit& f : error.figures) {
    all[f.figure->key] = or_null(f.error);
    by_figure[f.figure->key] = {{"values", f.values},
                                {"convergence", to_string(f.convergence)},
                                {"last_change", f.last_change},
                                {"left", or_null(f.left)},
                                {"error", or_null(f.error)}};
  }
  all["figures"] = by_figure;
  return all;
}

}  // namespace rotorub
