#include "compare/measured/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <charconv>
#include <cmath>

#include "compare/base/table_text.h"
#include "compare/measured/column_head.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using scene::printable;

constexpr double kLargestValue = 1e60;  // SI; keeps sums of squares finite
// Reads one file.
class MeasuredFile {
 public:
  MeasuredFile(std::string_view text, const std::string& file, const std::vector<ColumnName>& names)
      : text_(text), names_(names) {
    record_.file = file;
  }

  MeasuredRecord read() {
    check_encoding();
    // The first line with a column of times is the header. Without such a line, the first line is
    // the header, and its errors are reported.
    TableText table(text_, [&](const Fields& fields) {
      return fields.size() > 1 && std::ranges::any_of(fields, [&](const std::string& field) {
               return ColumnHead(meant(field)).is_time();
             });
    });
    if (table.header().empty()) {
      refuse(0, "", "is empty; expected a header and a line for each sample");
    } else {
      take_header(table.header(), table.line());
    }
    while (wrong_.size() < kMostFaults && table.next()) {
      if (const std::string fault = table.row_fault(); !fault.empty()) {
        refuse(table.line(), "", fault);
      } else {
        take_sample(table);
      }
    }
    if (wrong_.empty() && record_.t.size() < kLeastSamples) {
      refuse(0, "",
             fmt::format("{} samples are too few; {} or more are needed", record_.t.size(),
                         kLeastSamples));
    }
    for (const MeasuredColumn& c : record_.columns) {
      if (!wrong_.empty() || c.count(Sample::kGood) > 0) continue;
      refuse(0, printable(c.header), "has no value in any line; remove the column, or give values");
    }
    if (!wrong_.empty()) throw scene::SceneError(std::move(wrong_));
    std::vector<double> apart;
    for (std::size_t i = 1; i < record_.t.size(); ++i) {
      apart.push_back(record_.t[i] - record_.t[i - 1]);
    }
    const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
    std::nth_element(apart.begin(), middle, apart.end());
    record_.interval = *middle;
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
    refuse(0, "", fmt::format("is {}; expected text in UTF-8", wide ? "UTF-16" : "not text"));
    throw scene::SceneError(std::move(wrong_));
  }

  void take_header(const Fields& fields, int line) {
    const bool time_is_told = std::ranges::any_of(
        names_, [](const ColumnName& name) { return ColumnHead(name.meant).is_time(); });
    for (const std::string& field : fields) {
      ColumnHead head(meant(field));
      head.text = field;
      // Another Time beside the column that is given as t.
      if (time_is_told && head.is_time() && meant(field) == field &&
          boost::istarts_with(field, "time"))
        head.name = field;
      heads_.push_back(std::move(head));
    }
    check_names(fields, line);
    const auto any = [&](auto is) { return std::any_of(heads_.begin(), heads_.end(), is); };
    record_.has_units = any([](const ColumnHead& h) { return h.has_unit; });
    for (std::size_t k = 0; k < heads_.size(); ++k) {
      const ColumnHead& head = heads_[k];
      const std::string reason = fault_of(k);
      const std::string key = head.name.empty() ? fmt::format("column {}", k + 1) : head.name;
      if (!reason.empty()) refuse(line, printable(key), reason);
      if (head.what) record_.columns.push_back({head.what, head.text, {}, {}});
      if (!head.read()) record_.left_out.push_back(head.text);
    }
    if (!any([](const ColumnHead& h) { return h.is_time(); })) {
      refuse(line, "t",
             "no such column in the header: a record needs its times, as t [ms]; --measured-column "
             "\"Time = t [ms]\" says which column of another name they are");
    }
    if (record_.columns.empty() && wrong_.empty()) {
      refuse(line, "", "nothing measured beside t; choose from " + accepted_names());
    }
    if (!wrong_.empty())
      throw scene::SceneError(std::move(wrong_));  // the meaning of the fields is unknown
  }

  static bool is_called(const std::string& field, const ColumnName& name) {
    const std::string plain = boost::trim_copy(field.substr(0, field.find_first_of("[(")));
    return field == name.in_file || plain == name.in_file;
  }

  // The meaning of a column of the file: name and unit.
  std::string meant(const std::string& field) const {
    for (const ColumnName& name : names_) {
      if (!is_called(field, name)) continue;
      const bool has_unit = ColumnHead(name.meant).has_unit;
      const std::size_t unit = field.find_first_of("[(");
      return has_unit || unit == std::string::npos ? name.meant
                                                   : name.meant + " " + field.substr(unit);
    }
    return field;
  }

  // Refuses a given name whose column does not exist or whose meaning is unknown.
  void check_names(const Fields& fields, int line) {
    for (const ColumnName& name : names_) {
      const ColumnHead head(name.meant);
      if (!head.read()) refuse(line, printable(name.meant), unknown_reason(head.name));
      if (std::any_of(fields.begin(), fields.end(),
                      [&](const std::string& field) { return is_called(field, name); }))
        continue;
      refuse(line, printable(name.in_file),
             fmt::format("no such column; the header has {}",
                         printable(fmt::format("{}", fmt::join(fields, ", ")))));
    }
  }

  // The error in a column's header; if it is empty, the column's factor is set.
  std::string fault_of(std::size_t k) {
    ColumnHead& head = heads_[k];
    if (head.name.empty()) return "has no name; choose from " + accepted_names();
    if (!head.read())
      return is_own_column(head.name) || !names_.empty() ? ""
                                                         : foreign_reason(head.name, head.unit);
    for (std::size_t before = 0; before < k; ++before) {
      if (heads_[before].read() && heads_[before].what == head.what) {
        return "appears twice in the header; remove one of them";
      }
    }
    const scene::Quantity& quantity = head.quantity();
    if (!head.has_unit && record_.has_units) {
      return fmt::format("has no unit, but other columns have; write {} [{}] with one of {}",
                         head.name, quantity.unit, quantity.examples);
    }
    if (!head.has_unit) return {};
    if (!head.closed) {
      return "the bracket is not closed after the unit; write a header as rotor_x [um]";
    }
    if (head.unit.empty()) {
      return fmt::format("the brackets hold no unit; choose from {}", quantity.examples);
    }
    if (!counted_unit(head.unit).empty()) {
      const std::string own = head.text.substr(0, head.text.find_first_of("[("));
      return fmt::format(
          "`{}` is the unit of an amplitude, but a record needs the value at each instant; if the "
          "column does hold instantaneous values, give --measured-column \"{} = {} [{}]\"",
          printable(head.unit), printable(boost::trim_copy(own)), head.name,
          printable(std::string(counted_unit(head.unit))));
    }
    const auto one = scene::parse_quantity(fmt::format("1 {}", head.unit), quantity);
    if (!one.error.empty()) return one.error;
    head.factor = one.value;
    const bool is_unit = head.factor > 0.0 && std::isfinite(head.factor);
    return is_unit ? "" : "its unit is not a unit of measurement";
  }

  void take_sample(const TableText& table) {
    std::size_t column = 0;
    for (std::size_t k = 0; k < heads_.size(); ++k) {
      const ColumnHead& head = heads_[k];
      const std::string& field = table.row()[k];
      const bool missing = field.empty();
      if (!head.read()) continue;
      const double value = missing ? 0.0 : number_of(field, head, table);
      if (head.is_time()) {
        take_time(value, field, table.line());
      } else {
        record_.columns[column].value.push_back(value);
        record_.columns[column].sample.push_back(missing ? Sample::kMissing : Sample::kGood);
        ++column;
      }
    }
  }

  void take_time(double t, const std::string& field, int line) {
    if (field.empty()) {
      refuse(line, "t", "is empty; expected a time in every line");
    } else if (!record_.t.empty() && wrong_.empty() && !(t > record_.t.back())) {
      refuse(line, "t",
             fmt::format("{} is not later than the time of the line before; times must ascend",
                         printable(field)));
    }
    record_.t.push_back(t);
  }

  // The value in SI.
  double number_of(const std::string& field, const ColumnHead& head, const TableText& table) {
    const auto fail = [&](const std::string& reason) {
      refuse(table.line(), printable(head.text), fmt::format("`{}` {}", printable(field), reason));
      return 0.0;
    };
    std::string text = field.starts_with('+') ? field.substr(1) : field;
    const std::size_t at = text.find_first_of(table.separator() == ',' ? "." : ".,");
    if (at != std::string::npos) {
      if (decimal_ != '\0' && text[at] != decimal_) {
        return fail(fmt::format(
            "has a decimal {}, but lines before it have the other mark; use one of the two",
            text[at] == ',' ? "comma" : "point"));
      }
      decimal_ = text[at];
      text[at] = '.';
    }
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool whole = stop == end;
    if (error == std::errc::invalid_argument || !whole || !std::isfinite(value)) {
      const bool is_number = error == std::errc() && !whole && std::isfinite(value);
      return fail(is_number ? "is not a number alone; units stand in the header"
                            : "is not a number; an empty field is a gap in the record");
    }
    value *= head.factor;
    if (error != std::errc() || std::abs(value) > kLargestValue) {
      return fail("is too large or too small to be measured");
    }
    return value;
  }

  std::string_view text_;
  const std::vector<ColumnName>& names_;
  MeasuredRecord record_;
  std::vector<ColumnHead> heads_;
  char decimal_ = '\0';  // decimal mark of the file, once it is known
  std::vector<scene::Diagnostic> wrong_;
};

}  // namespace

MeasuredRecord parse_measured(std::string_view text, const std::string& file,
                              const std::vector<ColumnName>& names) {
  return MeasuredFile(text, file, names).read();
}

MeasuredRecord read_measured(const std::filesystem::path& file,
                             const std::vector<ColumnName>& names) {
  std::string text;
  try {
    text = scene::regular_file_text(file);
  } catch (const std::runtime_error& error) {
    const std::string reason = error.what();
    throw scene::SceneError(
        {{file.string(), 0, "", reason + "; expected a text file with a header"}});
  }
  return parse_measured(text, file.string(), names);
}

}  // namespace rotorub
