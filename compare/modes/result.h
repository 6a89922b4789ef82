// The result of `rotorub modes`: the analysis of a rotor and of its lasting rubs. README.md
// describes its JSON, which is public; people read it in Hz and rpm.
#pragma once

#include <string>

#include "compare/modes/rotor_analysis.h"
#include "compare/result/result.h"

namespace rotorub {

result::Section modes_result(const std::string& name, const RotorAnalysis& analysis);

}  // namespace rotorub
