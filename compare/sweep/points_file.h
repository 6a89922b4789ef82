// The points of a study in a file: a header with the names of the columns, and one line per point.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::sweep {

// A header field may include a unit, as in "clearance [um]", for the numbers of its column. Fields
// are separated by commas, semicolons or tabs; empty lines and lines that begin with # are skipped.
class PointsFile {
 public:
  PointsFile() = default;
  // Throws scene::SceneError.
  explicit PointsFile(const std::filesystem::path& file);

  bool empty() const { return heads_.empty(); }
  const std::filesystem::path& file() const { return file_; }
  const std::string& text() const { return text_; }
  std::vector<std::string_view> names() const { return {heads_.begin(), heads_.end()}; }
  // The texts of a column as strings of a study; empty if there is no such column.
  std::optional<std::vector<scene::TomlNode>> column(std::string_view name) const;

 private:
  void take_header(const std::vector<std::string>& fields);

  std::filesystem::path file_;
  std::string text_;
  std::vector<std::string> heads_, units_;
  std::vector<int> lines_;                       // line number of each point in the file
  std::vector<std::vector<std::string>> cells_;  // [point][column]
};

}  // namespace rotorub::sweep
