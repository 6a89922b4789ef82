// Reads a measured run: text with a header, one line a sample.
//
//   t [ms], rotor_x [um], rotor_y [um], force [N]
//   0.00,   12.1,         -3.0,         0.4
//
// - Separated by commas, semicolons or tabs (what the header has), UTF-8 with or without a mark at
//   its start, lines ended by LF or CRLF; names and numbers may stand in double quotes. Empty
//   lines, lines that begin with #, and what an instrument writes before the header are skipped.
// - Columns: `t` (or `time`, `Time`) and any of measurables(), each at most once, in any order.
// Each
//   name is followed by a unit in [ ] or ( ), as in a scene; in a header without any unit all is
//   SI: the product's own series.csv. Other columns of that series are left out; any other name is
//   refused.
// - Decimal point; with semicolons or tabs a decimal comma too, one of the two in a file.
// - An empty field is a gap in the record; t has none, and ascends strictly.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/measured/record.h"

namespace rotorub {

// What a column of a file with names of its own is: {"CH1 X", "rotor_x [mil]"}; without a unit the
// one that stands behind the file's name.
struct ColumnName {
  std::string in_file, meant;
};

// With such names, columns that neither they nor the product knows are left out.
//
// Throws scene::SceneError with all that is wrong (file, line, column, reason, what is accepted),
// the first kMostFaults of it. Clipped samples are not recognised yet: mark_clipped().
MeasuredRecord read_measured(const std::filesystem::path& file,
                             const std::vector<ColumnName>& names = {});
MeasuredRecord parse_measured(std::string_view text, const std::string& file,
                              const std::vector<ColumnName>& names = {});

inline constexpr std::size_t kMostFaults = 20;

}  // namespace rotorub
