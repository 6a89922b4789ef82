// The figures of a comparison as tables: values, differences and their causes.
#pragma once

#include "compare/result/result.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The figures of all runs, their differences, the split of each difference, and the error of the
// modes left out. On a terminal, resync shows none of them.
result::Section figure_section(const SceneComparison& comparison);

}  // namespace rotorub
