// The folder of a run, as a command is given it.
#pragma once

#include <string>

#include "compare/run_files/run_directory.h"

namespace rotorub {

// Throws UsageError for a folder that is none of a run, or of a broken one: a mistake of who named
// it.
StoredRun stored_run(const std::string& folder);

}  // namespace rotorub
