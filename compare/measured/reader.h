// Reads a measured run: a text file with a header and one line per sample.
//
//   t [ms], rotor_x [um], rotor_y [um], force [N]
//   0.00,   12.1,         -3.0,         0.4
//
// - Fields are separated by commas, semicolons or tabs (as in the header). UTF-8 with or without a
//   byte order mark; lines end with LF or CRLF. Names and numbers may be in double quotes. Empty
//   lines, lines that begin with #, and what an instrument writes before the header are skipped.
// - Columns: `t` (or `time`, `Time`) and any of measurables(), each at most once, in any order.
//   Each name is followed by a unit in [ ] or ( ), as in a scene. If no column has a unit, all
//   values are in SI, as in the program's series.csv. Other columns of that file are ignored; any
//   other name is refused.
// - Numbers have a decimal point or, if fields are separated by semicolons or tabs, a decimal
//   comma; one of the two per file.
// - An empty field is a gap in the record; t has no gaps and ascends strictly.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/measured/record.h"

namespace rotorub {

// The meaning of a column with another name: {"CH1 X", "rotor_x [mil]"}. Without a unit here, the
// unit in the file applies.
struct ColumnName {
  std::string in_file, meant;
};

// If names are given, columns that neither they nor the program knows are ignored.
//
// Throws scene::SceneError with all errors, at most kMostFaults of them (file, line, column,
// reason, what is accepted). Clipped samples are not marked yet; see mark_clipped().
MeasuredRecord read_measured(const std::filesystem::path& file,
                             const std::vector<ColumnName>& names = {});
MeasuredRecord parse_measured(std::string_view text, const std::string& file,
                              const std::vector<ColumnName>& names = {});

inline constexpr std::size_t kMostFaults = 20;

}  // namespace rotorub
