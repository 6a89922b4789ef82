#include "compare/measured/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "compare/measured/header.h"
#include "native_model/scene/printable.h"
#include "native_model/scene/regular_file.h"

namespace rotorub {
namespace {

using scene::Diagnostic;
using scene::printable;

constexpr double kLargestValue = 1e60;  // SI; sums of squares stay finite

// One file in the reading.
class MeasuredFile {
 public:
  MeasuredFile(std::string_view text, const std::string& file) : text_(text) { record_.file = file; }

  MeasuredRecord read() {
    check_encoding();
    int line = 0;
    for (std::size_t at = 0; at < text_.size() && wrong_.size() < kMostFaults;) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      take_line(text_.substr(at, end - at), ++line);
      at = end + 1;
    }
    if (header_.columns.empty() && wrong_.empty()) refuse(0, "", "is empty; accepted is a header and a line a sample");
    if (wrong_.empty() && record_.t.size() < kLeastSamples) {
      refuse(0, "",
             fmt::format("{} samples, too few to tell anything by; accepted are {} or more", record_.t.size(),
                         kLeastSamples));
    }
    if (wrong_.empty()) check_columns();
    if (!wrong_.empty()) throw scene::SceneError(std::move(wrong_));
    finish();
    return std::move(record_);
  }

 private:
  void refuse(int line, const std::string& key, std::string reason) {
    wrong_.push_back({record_.file, line, key, std::move(reason)});
  }

  void check_encoding() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    const bool wide = text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF");
    if (!wide && text_.find('\0') == std::string_view::npos) return;
    refuse(0, "", wide ? "is UTF-16; accepted is text in UTF-8" : "is no text; accepted is text in UTF-8");
    throw scene::SceneError(std::move(wrong_));
  }

  void take_line(std::string_view line, int number) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos || line[line.find_first_not_of(" \t")] == '#') return;
    if (header_.columns.empty()) {
      separator_ = separator_of(line);
      header_ = read_header(csv_fields(line, separator_), record_.file, number, wrong_);
      if (!wrong_.empty()) throw scene::SceneError(std::move(wrong_));  // what its fields are is not known
      start_columns();
      return;
    }
    const auto fields = csv_fields(line, separator_);
    if (fields.size() != header_.columns.size()) {
      refuse(number, "", fmt::format("{} fields where the header has {}", fields.size(), header_.columns.size()));
      return;
    }
    take_sample(fields, number);
  }

  void start_columns() {
    for (const HeaderColumn& c : header_.columns) {
      if (c.what) record_.columns.push_back({c.what, c.text, {}, {}});
      if (!c.read()) record_.left_out.push_back(c.text);
    }
    record_.has_units = header_.has_units;
  }

  void take_sample(const std::vector<std::string>& fields, int number) {
    std::size_t column = 0;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const HeaderColumn& head = header_.columns[k];
      if (!head.read()) continue;
      double value = 0.0;
      const bool missing = fields[k].empty();
      if (missing && head.is_time) {
        refuse(number, "t", "is empty; accepted is a time in every line");
      } else if (!missing) {
        value = number_of(fields[k], head, number);
      }
      if (head.is_time) {
        take_time(value, fields[k], number);
      } else {
        record_.columns[column].value.push_back(value);
        record_.columns[column].sample.push_back(missing ? Sample::kMissing : Sample::kGood);
        ++column;
      }
    }
  }

  void take_time(double t, const std::string& field, int number) {
    if (!record_.t.empty() && wrong_.empty() && !(t > record_.t.back())) {
      refuse(
          number, "t",
          fmt::format("{} is not after the time of the line before; accepted are times that ascend", printable(field)));
    }
    record_.t.push_back(t);
  }

  // SI.
  double number_of(const std::string& field, const HeaderColumn& head, int line) {
    const auto fail = [&](const std::string& reason) {
      refuse(line, printable(head.text), fmt::format("`{}` {}", printable(field), reason));
      return 0.0;
    };
    std::string text = field;
    if (text.starts_with('+')) text.erase(0, 1);
    const char mark = text.find(',') != std::string::npos ? ',' : text.find('.') != std::string::npos ? '.' : '\0';
    if (mark == ',' && separator_ != ',') {
      text[text.find(',')] = '.';
      if (text.find(',') != std::string::npos) return fail("is not a number");
    }
    if (mark != '\0' && decimal_ != '\0' && mark != decimal_) {
      return fail(fmt::format("has a decimal {}, lines before it have the other mark; accepted is one of the two",
                              mark == ',' ? "comma" : "point"));
    }
    if (mark != '\0') decimal_ = mark;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end == text.data() + text.size();
    const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
    if (error == std::errc::invalid_argument || !whole || (error == std::errc() && !std::isfinite(value))) {
      const bool has_digits = error == std::errc() && !rest.empty() && std::isfinite(value);
      return fail(has_digits ? "is not a number alone; units stand in the header"
                             : "is not a number; an empty field is a gap in the record");
    }
    value *= head.factor;
    if (error != std::errc() || std::abs(value) > kLargestValue)
      return fail("is too large or too small to be measured");
    return value;
  }

  void check_columns() {
    for (const MeasuredColumn& c : record_.columns) {
      if (c.count(Sample::kGood) == 0) {
        refuse(0, printable(c.header), "has no value in any line; accepted is a column less, or one with values");
      }
    }
  }

  void finish() {
    std::vector<double> apart;
    for (std::size_t i = 1; i < record_.t.size(); ++i) apart.push_back(record_.t[i] - record_.t[i - 1]);
    const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
    std::nth_element(apart.begin(), middle, apart.end());
    record_.interval = *middle;
  }

  std::string_view text_;
  MeasuredRecord record_;
  MeasuredHeader header_;
  char separator_ = ',';
  char decimal_ = '\0';  // mark of the file's numbers, once one has it
  std::vector<Diagnostic> wrong_;
};

}  // namespace

MeasuredRecord parse_measured(std::string_view text, const std::string& file) {
  return MeasuredFile(text, file).read();
}

MeasuredRecord read_measured(const std::filesystem::path& file) {
  std::string text;
  try {
    text = scene::regular_file_text(file);
  } catch (const std::runtime_error& error) {
    throw scene::SceneError(
        {{file.string(), 0, "", std::string(error.what()) + "; accepted is a text file with a header"}});
  }
  return parse_measured(text, file.string());
}

}  // namespace rotorub
