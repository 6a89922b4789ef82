// The flags of a measured run: --measured, --measured-column, --measured-probes, --measured-shift,
// --measured-angle.
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

// As the user wrote them; empty: not given.
struct MeasuredArguments {
  std::string measured, measured_shift, measured_angle, measured_probes;
  std::vector<std::string> measured_columns;
};

// beside: what the record is laid beside, for the help.
void add_measured_options(CLI::App& command, MeasuredArguments& arguments, const char* beside);

// What a record is laid in by.
struct MeasuredInput {
  std::shared_ptr<const MeasuredRecord> record;  // null: none
  AlignmentOptions alignment;
};
// Throws UsageError naming the flag, what was given and what is accepted, and scene::SceneError
// with all that is wrong in the file.
MeasuredInput measured_of(const MeasuredArguments& arguments);

}  // namespace rotorub
