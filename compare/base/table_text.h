// Tables as text: a header with the names of the columns and then one line per row, as written by
// spreadsheets and instruments.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

using Fields = std::vector<std::string>;

// Fields are separated by tabs or semicolons if the header contains one, otherwise by commas, and
// have neither surrounding blanks nor double quotes. A separator within quotes does not count,
// nor does one at the end of a row.
// Empty lines and lines that begin with # are skipped.
class TableText {
 public:
  // The header is the first line whose fields fit `is_header`; what an instrument writes before it
  // is skipped. Without such a line, it is the first line. The text must outlive this.
  explicit TableText(std::string_view text,
                     const std::function<bool(const Fields&)>& is_header = {});

  const Fields& header() const { return header_; }  // empty: the text has no lines
  char separator() const { return separator_; }

  // Reads the next row; false at the end.
  bool next();
  const Fields& row() const { return row_; }
  int line() const { return line_; }  // of the row, or of the header before the first row; from 1
  // "3 fields where the header has 2"; empty if they are equally many.
  std::string row_fault() const;

 private:
  bool next_line(std::string_view& line);

  std::string_view rest_;
  Fields header_, row_;
  char separator_ = ',';
  int line_ = 0;
};

}  // namespace rotorub
