#include "native_model/trajectory/part_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part-";
constexpr int kMostAttempts = 100;

// Of the processes that a number tells apart: those of one machine, or one container on it.
std::string machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  std::error_code none;
  const std::string whole =
      std::string(name.data()) + fs::read_symlink("/proc/self/ns/pid", none).string();
  return scene::text_hash(whole).substr(0, 8);
}

std::string random_name() {
  std::random_device device;
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned>(device()));
  return digits.data();
}

// The process of this machine whose part of the file with this name it is; 0: none.
pid_t writer_of(const std::string& part, const std::string& name) {
  const std::string mark = name + kPart;
  if (!part.starts_with(mark)) return 0;
  pid_t process = 0;
  const char* last = part.data() + part.size();
  const auto [end, error] = std::from_chars(part.data() + mark.size(), last, process);
  const bool ours =
      end == last ||
      std::string_view(end, static_cast<std::size_t>(last - end)).starts_with("-" + machine());
  return error == std::errc() && ours && process > 0 ? process : 0;
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
  // Made here and by nobody before: what a link of that name leads to is not written.
  const std::string mark = kPart + std::to_string(::getpid()) + "-" + machine() + "-";
  for (int attempt = 0;; ++attempt) {
    fs::path part = file;
    part += mark + random_name();
    const int made =
        ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (made >= 0) ::close(made);
    if (made >= 0 || errno != EEXIST || attempt == kMostAttempts)
      return part;  // who opens it learns why it cannot be
  }
}

void check_writable(const fs::path& folder) {
  std::error_code none;
  fs::path there = fs::absolute(folder.empty() ? "." : folder);
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  const bool is_folder = fs::is_directory(there, none);
  if (is_folder && access(there.c_str(), W_OK | X_OK) == 0) return;
  const int error = is_folder ? errno : ENOTDIR;
  throw fs::filesystem_error("cannot write to", folder,
                             std::error_code(error, std::generic_category()));
}

}  // namespace rotorub
