#include "native_model/scene/regular_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace rotorub::scene {

std::string regular_file_text(const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(file, none);
  if (std::filesystem::is_directory(status))
    throw std::runtime_error("is a folder; expected a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw std::runtime_error("is a device or a pipe; expected a file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  std::string text(static_cast<std::size_t>(std::filesystem::file_size(file)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

}  // namespace rotorub::scene
