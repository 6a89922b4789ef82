// The result of a resync, in words and as parts of the comparison's result.
#pragma once

#include <string>
#include <vector>

#include "compare/result/result.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// Half a sentence, like why() in trust.h.
std::string why(const Resync& resync, double tolerance);

// The verdict on one contact model in one sentence, and the reasons behind it.
std::string resync_headline(const std::string& contact, const Resync& resync, double tolerance);
std::vector<std::string> resync_reasons(const std::string& contact, const Resync& resync);

// One row per contact model and figure; in JSON at "differences/<contact>/resync".
std::vector<result::Part> resync_parts(const SceneComparison& comparison);

}  // namespace rotorub
