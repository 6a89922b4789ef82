#include "native_model/trajectory/output.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/part_file.h"

namespace rotorub {
namespace {

// 17 significant digits: reads back to the same bits.
void append(std::string& text, double value) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 17);
  text.append(buffer, end.ptr);
}

void append_row(std::string& text, std::initializer_list<double> values) {
  bool first = true;
  for (double value : values) {
    if (!first) text += ',';
    first = false;
    append(text, value);
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
        text += to_string(static_cast<Mode>(static_cast<int>(column.values[row])));
      } else {
        append(text, column.values[row]);
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
    append(text, e.t);
    text += ',';
    text += to_string(e.kind);
    text += last_column(several, e.contact);
  }
  write_whole(file, text);
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  namespace fs = std::filesystem;
  std::error_code none;
  // What a link leads to is written, not put in the place of the link; nor is a device or a pipe,
  // which takes the text as it comes.
  const bool exists = fs::exists(file, none), regular = fs::is_regular_file(file, none);
  const fs::path target = regular ? fs::canonical(file, none) : file;
  const bool aside = !exists || regular;
  const fs::path written = aside ? part_of(target) : target;
  const auto fail = [&](const char* what, int error) {
    if (aside) fs::remove(written, none);
    const std::error_code code(error, std::generic_category());
    const std::string said =
        "cannot " + std::string(what) + " " + file.string() + ": " + code.message();
    // A place that takes no file was badly chosen; one that is full was not.
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
    out.close();  // with what was still held back
    if (!out) fail("write", errno);
  }
  if (!aside) return;
  std::error_code error;
  fs::rename(written, target, error);
  if (error) fail("rename to", error.value());
}

}  // namespace rotorub
