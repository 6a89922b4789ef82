// The result of tune as text for the terminal, and as JSON with the keys of the contract.
#pragma once

#include "compare/result/result.h"
#include "compare/tune/tune.h"

namespace rotorub::tune {

result::Section result_of(const TuneResult& result);

}  // namespace rotorub::tune
