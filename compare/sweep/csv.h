// results.csv: the rows of a store as text, in the study's order.
#pragma once

#include <filesystem>

#include "compare/sweep/store.h"

namespace rotorub::sweep {

// A header line, then one line a point, 17 significant digits; fields with commas, quotes or line
// breaks in double quotes (RFC 4180), nothing where there is no value. Whole or not at all.
void write_csv(Store& store, const std::filesystem::path& file);

}  // namespace rotorub::sweep
