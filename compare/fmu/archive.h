// A ZIP archive, as FMI 2.0 and 3.0 ask for it (FMI 3.0, 2.5): deflated, of version 2.0.
#pragma once

#include <string>
#include <vector>

namespace rotorub::fmi {

struct ArchiveFile {
  std::string path, content;
};

// Its bytes: the same for the same files. Throws std::runtime_error.
std::string archive(const std::vector<ArchiveFile>& files);

}  // namespace rotorub::fmi
