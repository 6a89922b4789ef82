// What a resync found, in words and as a table.
#pragma once

#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Half a sentence, as why() of trust.h.
std::string why(const Resync& resync, double tolerance);

// Of one contact model: its verdict in one sentence, and what is behind it.
std::string resync_headline(const std::string& contact, const Resync& resync, double tolerance);
std::vector<std::string> resync_reasons(const std::string& contact, const Resync& resync);

// One row a contact model and figure, at most 80 columns.
std::string resync_table(const SceneComparison& comparison);

// In %, three digits: "0.52", "<0.001".
std::string percents(double share);
// "-0.52 %": a share with its sign, three digits; "+<0.001 %".
std::string signed_percent(double share);

}  // namespace rotorub
