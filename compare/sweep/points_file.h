// The points of a study in a file: a header that names the columns, and a line a point.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::sweep {

// A header field may have a unit, as "clearance [um]", which is then that of its column's numbers.
// Fields are separated by commas, semicolons or tabs; empty lines and those that begin with # are
// left out.
class PointsFile {
 public:
  PointsFile() = default;
  // Throws scene::SceneError.
  explicit PointsFile(const std::filesystem::path& file);

  bool empty() const { return heads_.empty(); }
  const std::filesystem::path& file() const { return file_; }
  const std::string& text() const { return text_; }
  std::vector<std::string_view> names() const { return {heads_.begin(), heads_.end()}; }
  // The texts of a column, as strings of a study; nothing: there is none of this name.
  std::optional<std::vector<scene::TomlNode>> column(std::string_view name) const;

 private:
  void take_header(const std::vector<std::string>& fields);

  std::filesystem::path file_;
  std::string text_;
  std::vector<std::string> heads_, units_;
  std::vector<int> lines_;                       // of each point, in the file
  std::vector<std::vector<std::string>> cells_;  // [point][column]
};

}  // namespace rotorub::sweep
