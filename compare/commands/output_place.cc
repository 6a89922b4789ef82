// Checks of the places that -o names, before a command starts its work.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "compare/commands/command.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_place(const fs::path& place, const std::string& reason) {
  throw UsageError("cannot write to {}: {}", place.string(), reason);
}

// Throws unless the folder, or its nearest existing parent, accepts new files.
void check_folder(const fs::path& folder) {
  std::error_code none;
  fs::path there = fs::absolute(folder.empty() ? "." : folder);
  while (!fs::exists(fs::symlink_status(there, none)) && there.has_relative_path())
    there = there.parent_path();
  if (!fs::is_directory(there, none))
    refuse_place(folder, there.string() + " is a file, not a folder");
  try {
    check_writable(folder);
  } catch (const fs::filesystem_error& error) {
    refuse_place(folder.empty() ? there : folder, error.code().message());
  }
}

// The folder in which the file is first written under another name (write_whole). Empty for a
// device or a pipe, which is written directly.
std::optional<fs::path> folder_of_output(const fs::path& file) {
  std::error_code none;
  if (!file.has_filename() || fs::is_directory(file, none)) {
    throw UsageError("{} is a folder; give the name of a file", file.string());
  }
  if (!fs::exists(file, none)) return file.parent_path();
  if (access(file.c_str(), W_OK) != 0) refuse_place(file, std::generic_category().message(errno));
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  return fs::canonical(file, none).parent_path();
}

// Refuses "result.csv" as the name of a new folder: the user meant a file.
void refuse_file_name(const fs::path& folder) {
  std::error_code none;
  if (fs::exists(folder, none)) return;
  const std::string ending = folder.extension().string();
  for (const char* file : {".csv", ".json", ".html", ".toml", ".xml", ".h5", ".png", ".mp4"}) {
    if (ending != file) continue;
    throw UsageError(
        "-o {}: expected the name of a folder, for several files, but {} is the "
        "ending of a file",
        scene::printable(folder.string()), ending);
  }
}

}  // namespace

void check_ending(const fs::path& file, std::string_view ending) {
  if (!file.has_extension() || file.extension() == ending) return;
  std::error_code none;
  const fs::file_status status = fs::status(file, none);
  if (fs::is_other(status) || fs::is_directory(status)) return;  // /dev/stdout; reported later
  throw UsageError("-o {}: expected the name of a file that ends in {}",
                   scene::printable(file.string()), ending);
}

void check_output_file(const fs::path& file) {
  if (file.empty()) return;
  if (const auto folder = folder_of_output(file)) check_folder(*folder);
}

void check_output_folder(const fs::path& folder, const std::vector<std::string>& files) {
  if (folder.empty()) return;
  refuse_file_name(folder);
  std::set<fs::path> folders{folder};
  for (const std::string& file : files) {
    if (const auto written = folder_of_output(folder / file)) folders.insert(*written);
  }
  for (const fs::path& written : folders) check_folder(written);
}

void write_or_print(const std::string& file, const std::string& text) {
  if (file.empty()) {
    std::cout << text;
  } else {
    check_output_file(file);
    write_whole(file, text);
  }
}

}  // namespace rotorub
