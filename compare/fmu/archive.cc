#include "compare/fmu/archive.h"

#include <zip.h>

#include <stdexcept>

namespace rotorub::fmi {
namespace {

constexpr time_t kTime = 1577880000;  // 1 January 2020, for every file

void check(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("the archive cannot be made: ") + what);
}

// All bytes written to the source.
std::string bytes_of(zip_source_t* source) {
  zip_stat_t about;
  check(zip_source_stat(source, &about) == 0 && zip_source_open(source) == 0, "not readable");
  std::string bytes(about.size, '\0');
  const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  check(got == static_cast<zip_int64_t>(bytes.size()), "not read to its end");
  return bytes;
}

}  // namespace

std::string archive(const std::vector<ArchiveFile>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  check(target, "no memory");
  zip_source_keep(target);
  zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  check(zip, zip_error_strerror(&error));
  for (const ArchiveFile& file : files) {
    zip_source_t* from = zip_source_buffer(zip, file.content.data(), file.content.size(), 0);
    const zip_int64_t at = zip_file_add(zip, file.path.c_str(), from, ZIP_FL_ENC_UTF_8);
    check(at >= 0, zip_strerror(zip));
    const auto index = static_cast<zip_uint64_t>(at);
    check(zip_set_file_compression(zip, index, ZIP_CM_DEFLATE, 0) == 0 &&
              zip_file_set_mtime(zip, index, kTime, 0) == 0,
          zip_strerror(zip));
  }
  check(zip_close(zip) == 0, zip_strerror(zip));
  std::string bytes = bytes_of(target);
  zip_source_free(target);
  return bytes;
}

}  // namespace rotorub::fmi
