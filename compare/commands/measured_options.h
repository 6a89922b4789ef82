// The options of a measured run: --measured, --measured-column, --measured-probes,
// --measured-shift, --measured-angle.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/measured/alignment.h"
#include "compare/measured/record.h"
#include "native_model/scene/text.h"

namespace rotorub {

// As given by the user; empty if not given.
struct MeasuredArguments {
  std::string measured, measured_shift, measured_angle, measured_probes;
  std::vector<std::string> measured_columns;
};

// beside: what the record is compared with, for the help. Returns --measured.
Option add_measured_options(CLI::App& command, MeasuredArguments& arguments, const char* beside);

// The record and how to align it.
struct MeasuredInput {
  std::shared_ptr<const MeasuredRecord> record;  // may be null
  AlignmentOptions alignment;
};
// Throws UsageError that names the option, its value and what is accepted, and scene::SceneError
// with all errors in the file.
MeasuredInput measured_of(const MeasuredArguments& arguments);

// Returns what `work` with the record does. Throws UsageError, with the record's file, where it
// throws MeasuredError.
template <class Work>
auto with_record(const MeasuredInput& measured, const Work& work) {
  try {
    return work();
  } catch (const MeasuredError& error) {
    throw UsageError("{}: {}", scene::printable(measured.record->file), error.what());
  }
}

}  // namespace rotorub
