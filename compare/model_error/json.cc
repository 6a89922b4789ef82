#include "compare/model_error/json.h"

#include <nlohmann/json.hpp>

#include "compare/base/json.h"

namespace rotorub {

using nlohmann::json;

json model_error_json(const ModelError& error) {
  json all = {{"modes", error.modes}};
  if (!error.reason.empty()) {
    all["reason"] = error.reason;
    return all;
  }
  json by_figure = json::object();
  for (const FigureLimit& f : error.figures) {
    all[f.figure->key] = number_or_null(f.error);
    by_figure[f.figure->key] = {{"values", f.values},
                                {"convergence", to_string(f.convergence)},
                                {"last_change", f.last_change},
                                {"left", number_or_null(f.left)},
                                {"error", number_or_null(f.error)}};
  }
  all["figures"] = by_figure;
  return all;
}

}  // namespace rotorub
