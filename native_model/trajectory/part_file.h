// The place beside a file where it is written until it is whole.
#pragma once

#include <filesystem>

namespace rotorub {

// `<file>.part-<process>-<machine>-<random>`, a file that was not there and is empty now. What
// ended processes of this machine left of the same file is removed.
std::filesystem::path part_of(const std::filesystem::path& file);

// That files can be made there: the folder, or the nearest one above it that exists, is one and
// lets itself be written to. Throws std::filesystem::filesystem_error, so that hours of computing
// do not end with it.
void check_writable(const std::filesystem::path& folder);

}  // namespace rotorub
