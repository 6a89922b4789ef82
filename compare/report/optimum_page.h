// The page of `rotorub optimise`: maps of the evaluated scenes over their keys, and the best scene.
#pragma once

#include <string>

#include "compare/optimise/optimiser.h"

namespace rotorub {

// best: the scene's text with the best values. Empty if no best values were found.
std::string optimum_page(const std::string& name, const optimise::Task& task,
                         const optimise::Optimum& optimum, const std::string& best);

}  // namespace rotorub
