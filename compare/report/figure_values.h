// The tables of figures in the report: texts, already worded and rounded. Rows of cells, one a
// column of the page (page_columns of page_values.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/study/scene_comparison.h"

namespace rotorub {

nlohmann::json column_values(const SceneComparison& c);  // heads of the columns
nlohmann::json figure_rows(const SceneComparison& c,
                           bool judged_only);  // with the chips of their deviations
// Model gap and step error: of the splits that converge, or of those that say nothing.
nlohmann::json split_rows(const SceneComparison& c, bool valid);
nlohmann::json residual_rows(const SceneComparison& c);  // of the laws
nlohmann::json cost_rows(const SceneComparison& c);      // time of a step
nlohmann::json ladder_values(
    const SceneComparison& c);  // modes kept; null where there is no ladder to show

}  // namespace rotorub
