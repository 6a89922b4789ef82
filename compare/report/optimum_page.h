// The page of `rotorub optimise`: the scenes that were tried as maps over their keys, and the best.
#pragma once

#include <string>

#include "compare/optimise/optimiser.h"

namespace rotorub {

// `best`: the scene's text with the best values; empty: there is none.
std::string optimum_page(const std::string& name, const optimise::Task& task,
                         const optimise::Optimum& optimum, const std::string& best);

}  // namespace rotorub
