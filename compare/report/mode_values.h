// The page's values of what the modes of compare and the shadow add.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The columns of the page's tables: native, its shadow where there is one, MuJoCo's.
struct PageColumn {
  const Side* side = nullptr;
  // Of each figure against native: as figures(); empty for native itself.
  std::vector<JudgedFigure> figures;
  bool judged = false;  // its differences carry verdicts
};
std::vector<PageColumn> page_columns(const SceneComparison& comparison);

// What the shadow is, or why there is none: a sentence.
std::string shadow_sentence(const SceneComparison& comparison);

// One row a contact model and figure; empty but in resync.
nlohmann::json resync_rows(const SceneComparison& comparison);

}  // namespace rotorub
