#include "compare/commands/measured_options.h"

#include <fmt/format.h>

#include <boost/algorithm/string/trim.hpp>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/measured/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// "CH1 X = rotor_x [mil]". The name in the file may contain an equals sign, its meaning does not.
std::vector<ColumnName> names_of(const std::vector<std::string>& texts) {
  std::vector<ColumnName> names;
  for (const std::string& text : texts) {
    const std::size_t at = text.rfind('=');
    ColumnName name;
    if (at != std::string::npos)
      name = {boost::trim_copy(text.substr(0, at)), boost::trim_copy(text.substr(at + 1))};
    if (name.in_file.empty() || name.meant.empty()) {
      refuse("--measured-column", scene::printable(text),
             "NAME=COLUMN, for example \"CH1 X = rotor_x [mil]\"");
    }
    names.push_back(std::move(name));
  }
  return names;
}

// "45deg,135deg"
void turn_probes(const std::string& text, MeasuredRecord& record) {
  const std::string accepted =
      "the directions of two probes in the scene, for example 45deg,135deg";
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError("--measured-probes {}: expected {}", scene::printable(text), accepted);
  const auto angle = [&](const std::string& part) {
    return quantity_of("--measured-probes", part, scene::kAngle, accepted);
  };
  const double first = angle(text.substr(0, comma)), second = angle(text.substr(comma + 1));
  try {
    resolve_probes(record, first, second);
  } catch (const MeasuredError& error) {
    throw UsageError("--measured-probes: {}", error.what());
  }
}

}  // namespace

MeasuredInput measured_of(const MeasuredArguments& options) {
  MeasuredInput input;
  if (options.measured.empty()) {
    if (options.measured_shift.empty() && options.measured_angle.empty() &&
        options.measured_probes.empty() && options.measured_columns.empty())
      return input;
    throw UsageError(
        "--measured-shift, --measured-angle, --measured-probes and --measured-column belong to "
        "--measured, which is missing; give the file of the record with it");
  }
  if (!options.measured_probes.empty() && !options.measured_angle.empty()) {
    throw UsageError(
        "--measured-probes and --measured-angle exclude each other, because the directions of the "
        "probes determine the angle; give one of them");
  }
  if (const std::string& shift = options.measured_shift; !shift.empty())
    input.alignment.shift = quantity_of("--measured-shift", shift, scene::kTime);
  if (const std::string& angle = options.measured_angle; !angle.empty())
    input.alignment.angle = quantity_of("--measured-angle", angle, scene::kAngle);
  auto record = std::make_shared<MeasuredRecord>(
      read_measured(options.measured, names_of(options.measured_columns)));
  if (!options.measured_probes.empty()) {
    turn_probes(options.measured_probes, *record);
    input.alignment.angle = 0.0;
  }
  input.record = std::move(record);
  return input;
}

Option add_measured_options(CLI::App& command, MeasuredArguments& arguments, const char* beside) {
  const Option measured = add_value(
      command, "--measured", arguments.measured, "CSV",
      fmt::format("A measured run of this scene, {}: a CSV file with a header that names t and any "
                  "of rotor, "
                  "ring, gap, force and current with their units, e.g. `t [ms], rotor_x [um]` "
                  "(compare/README.md)",
                  beside));
  add_value(
      command, "--measured-column", arguments.measured_columns, "NAME=COLUMN",
      "Meaning of a column, for a file with other names, e.g. \"CH1 X = rotor_x [mil]\"; may be "
      "repeated. Columns without a meaning are then left out")
      .repeats();
  add_value(
      command, "--measured-probes", arguments.measured_probes, "ANGLE,ANGLE",
      "Directions in which the probes measure rotor_x and rotor_y, from the scene's x axis to "
      "its y axis, e.g. 45deg,135deg (default: x and y of one frame)");
  add_value(
      command, "--measured-shift", arguments.measured_shift, "TIME",
      "Time to add to the times of the record, e.g. 12.5ms (default: found by least squares)");
  add_value(command, "--measured-angle", arguments.measured_angle, "ANGLE",
            "Angle of the sensors' x axis in the scene, from x to y, e.g. 30deg (default: found "
            "if x and y are measured)");
  return measured;
}

}  // namespace rotorub
