// The options of a measured run: --measured, --measured-column, --measured-probes,
// --measured-shift, --measured-angle.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/measured/alignment.h"
#include "compare/measured/record.h"

namespace CLI {
class App;
}

namespace rotorub {

// As given by the user; empty if not given.
struct MeasuredArguments {
  std::string measured, measured_shift, measured_angle, measured_probes;
  std::vector<std::string> measured_columns;
};

// beside: what the record is compared with, for the help.
void add_measured_options(CLI::App& command, MeasuredArguments& arguments, const char* beside);

// The record and how to align it.
struct MeasuredInput {
  std::shared_ptr<const MeasuredRecord> record;  // may be null
  AlignmentOptions alignment;
};
// Throws UsageError that names the option, its value and what is accepted, and scene::SceneError
// with all errors in the file.
MeasuredInput measured_of(const MeasuredArguments& arguments);

}  // namespace rotorub
