#include "compare/base/module_file.h"

namespace rotorub {

std::filesystem::path module_file(const std::string& name) {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  for (const char* folder : {"lib", ROTORUB_INSTALL_LIBDIR}) {
    const auto file = program.parent_path().parent_path() / folder / name;
    if (std::filesystem::exists(file, failed)) return file;
  }
  return {};
}

}  // namespace rotorub
