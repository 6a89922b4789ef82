// A file that is read whole.
#pragma once

#include <filesystem>
#include <string>

namespace rotorub::scene {

// Throws std::runtime_error, with the reason alone ("cannot be read: ...", "is a folder ..."), for
// what is no regular file: a device, to which a link may lead, has no end.
std::string regular_file_text(const std::filesystem::path& file);

}  // namespace rotorub::scene
