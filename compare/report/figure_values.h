// The tables of figures in the report, as rounded texts in rows of cells. Each cell belongs to a
// column of the page (page_columns in page_values.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/base/palette.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

const char* tone_class(Tone tone);  // the class of its elements: "", "good", "part", "bad"

nlohmann::json column_values(const SceneComparison& c);  // the headings of the columns
nlohmann::json figure_rows(const SceneComparison& c,
                           bool judged_only);  // with the labels of their deviations
// Model gap and step error: of the splits that converge, or of the others.
nlohmann::json split_rows(const SceneComparison& c, bool valid);
nlohmann::json residual_rows(const SceneComparison& c);  // of the contact laws
nlohmann::json cost_rows(const SceneComparison& c);      // time per step
nlohmann::json ladder_values(const SceneComparison& c);  // modes kept; null without a ladder

}  // namespace rotorub
