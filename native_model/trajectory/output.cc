#include "native_model/trajectory/output.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

namespace {

namespace fs = std::filesystem;

void append_row(std::string& text, std::initializer_list<double> values) {
  bool first = true;
  for (double value : values) {
    if (!first) text += ',';
    first = false;
    append_number(text, value);
  }
}

std::string header(std::span<const ColumnMeaning> columns) {
  std::string text;
  for (const ColumnMeaning& column : columns)
    text += (text.empty() ? "" : ",") + std::string(column.name);
  return text + '\n';
}

std::string last_column(bool several, int contact) {
  return several ? "," + std::to_string(contact + 1) + "\n" : "\n";
}

}  // namespace

void append_number(std::string& text, double value) {
  if (value == 0.0) value = 0.0;
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general);
  text.append(buffer, end.ptr);
}

void write_series(const Trajectory& trajectory, const std::filesystem::path& file) {
  std::string text;
  text.reserve(trajectory.rows() * trajectory.series.size() * 24);
  for (const Column& column : trajectory.series) {
    if (!text.empty()) text += ',';
    text += column.name;
  }
  text += '\n';
  for (std::size_t row = 0; row < trajectory.rows(); ++row) {
    bool first = true;
    for (const Column& column : trajectory.series) {
      if (!first) text += ',';
      first = false;
      if (contact_of_column(column.name).second == "mode") {
        text += to_string(static_cast<ContactMode>(static_cast<int>(column.values[row])));
      } else {
        append_number(text, column.values[row]);
      }
    }
    text += '\n';
  }
  write_whole(file, text);
}

void write_impacts(const Trajectory& trajectory, const std::filesystem::path& file) {
  const bool several = trajectory.contacts > 1;
  std::string text = header(impact_columns(several));
  for (const Impact& i : trajectory.impacts) {
    append_row(text, {i.t, i.normal_impulse, i.friction_impulse, i.gap_rate_before,
                      i.gap_rate_after, i.slip_before, i.slip_after, i.energy_change});
    text += last_column(several, i.contact);
  }
  write_whole(file, text);
}

void write_events(const Trajectory& trajectory, const std::filesystem::path& file) {
  const bool several = trajectory.contacts > 1;
  std::string text = header(event_columns(several));
  for (const Event& e : trajectory.events) {
    append_number(text, e.t);
    text += ',';
    text += to_string(e.kind);
    text += last_column(several, e.contact);
  }
  write_whole(file, text);
}

void write_keyphasor(const Trajectory& trajectory, const std::filesystem::path& file) {
  std::string text = header(keyphasor_columns());
  for (const KeyphasorPass& pass : trajectory.keyphasor) {
    append_row(text, {pass.t, pass.x, pass.y, pass.spin_speed});
    text += '\n';
  }
  write_whole(file, text);
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  std::error_code none;
  // The target of a link is written, and the link is not replaced. A device or a pipe is not
  // replaced either; it receives the text directly.
  const bool exists = fs::exists(file, none), regular = fs::is_regular_file(file, none);
  const fs::path target = regular ? fs::canonical(file, none) : file;
  const bool aside = !exists || regular;
  const fs::path written = aside ? part_of(target) : target;
  const auto fail = [&](const char* what, int error) {
    if (aside) fs::remove(written, none);
    const std::error_code code(error, std::generic_category());
    const std::string said =
        "cannot " + std::string(what) + " " + file.string() + ": " + code.message();
    // With these four errors the place is suitable, but the disk is full or failing.
    if (error != ENOSPC && error != EDQUOT && error != EIO && error != EFBIG)
      throw UnwritablePlace(said);
    throw std::runtime_error(said);
  };
  if (fs::is_directory(file, none)) fail("write", EISDIR);
  errno = 0;
  {
    std::ofstream out(written, std::ios::binary | std::ios::trunc);
    if (!out) fail("open", errno);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();  // flushes the buffer
    if (!out) fail("write", errno);
  }
  if (!aside) return;
  std::error_code error;
  fs::rename(written, target, error);
  if (error) fail("rename to", error.value());
}

namespace {

constexpr const char* kPart = ".part-";
constexpr int kMostAttempts = 100;

// Identifies the set of processes whose numbers are unique: those of one machine, or of one
// container on it.
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

// The process of this machine that owns `part`, a temporary file of the file `name`; 0: none.
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
  fs::create_directories(folder, none);  // if this fails, so does writing there
  std::vector<fs::path> left;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    const pid_t process = writer_of(at->path().filename().string(), file.filename().string());
    if (process > 0 && !is_running(process)) left.push_back(at->path());
  }
  for (const fs::path& part : left) fs::remove(part, none);
  // O_EXCL: the file must be new, so that nothing is written through a link of that name.
  const std::string mark = kPart + std::to_string(::getpid()) + "-" + machine() + "-";
  for (int attempt = 0;; ++attempt) {
    fs::path part = file;
    part += mark + random_name();
    const int made =
        ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (made >= 0) ::close(made);
    if (made >= 0 || errno != EEXIST || attempt == kMostAttempts)
      return part;  // opening it will report the reason
  }
}

void check_writable(const fs::path& folder) {
  std::error_code none;
  fs::path there = fs::absolute(folder.empty() ? "." : folder);
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  int error = ENOTDIR;
  if (fs::is_directory(there, none)) {
    // Tries it out, since the file system may refuse what the permissions of the folder allow.
    const fs::path probe = part_of(there / "rotorub");
    error = errno;
    if (fs::remove(probe, none)) return;
  }
  throw fs::filesystem_error("cannot write to", folder,
                             std::error_code(error, std::generic_category()));
}

}  // namespace rotorub
