// A ZIP archive as required by FMI 2.0 and 3.0 (FMI 3.0, 2.5): deflated, version 2.0.
#pragma once

#include <string>
#include <vector>

namespace rotorub::fmi {

struct ArchiveFile {
  std::string path, content;
};

// The bytes of the archive; equal for equal files. Throws std::runtime_error.
std::string archive(const std::vector<ArchiveFile>& files);

}  // namespace rotorub::fmi
