#include "native_model/trajectory/part_file.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>
#include <vector>

namespace rotorub {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part-";

// The process whose part of the file with this name it is; 0: none.
pid_t writer_of(const std::string& part, const std::string& name) {
  const std::string mark = name + kPart;
  if (!part.starts_with(mark)) return 0;
  pid_t process = 0;
  const auto [end, error] = std::from_chars(part.data() + mark.size(), part.data() + part.size(), process);
  return error == std::errc() && end == part.data() + part.size() && process > 0 ? process : 0;
}

bool is_running(pid_t process) { return kill(process, 0) == 0 || errno != ESRCH; }

}  // namespace

fs::path part_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code none;
  std::vector<fs::path> left;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    const pid_t process = writer_of(at->path().filename().string(), file.filename().string());
    if (process > 0 && !is_running(process)) left.push_back(at->path());
  }
  for (const fs::path& part : left) fs::remove(part, none);
  fs::path part = file;
  part += kPart + std::to_string(::getpid());
  return part;
}

void check_writable(const fs::path& folder) {
  std::error_code none;
  fs::path there = fs::absolute(folder.empty() ? "." : folder);
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  const bool is_folder = fs::is_directory(there, none);
  if (is_folder && access(there.c_str(), W_OK | X_OK) == 0) return;
  const int error = is_folder ? errno : ENOTDIR;
  throw fs::filesystem_error("cannot write to", folder, std::error_code(error, std::generic_category()));
}

}  // namespace rotorub
