#include "compare/sweep/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>

#include "compare/base/separated.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int line, std::string reason) {
  throw scene::SceneError({{file.string(), line, "", std::move(reason)}});
}

}  // namespace

PointsFile::PointsFile(const std::filesystem::path& file)
    : file_(file), text_(scene::file_text(file)) {
  std::string_view rest = text_;
  char separator = ',';
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string line = boost::trim_copy(std::string(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.starts_with('#')) continue;
    if (heads_.empty()) {
      separator = separator_of(line);
      take_header(fields_of(line, separator));
      continue;
    }
    std::vector<std::string> fields = fields_of(line, separator);
    if (fields.size() != heads_.size())
      refuse(file, number,
             fmt::format("{} fields where the header has {}", fields.size(), heads_.size()));
    cells_.push_back(std::move(fields));
    lines_.push_back(number);
  }
  if (cells_.empty()) refuse(file, 0, "no points: expected a header and a line a point");
}

void PointsFile::take_header(const std::vector<std::string>& fields) {
  for (const std::string& field : fields) {
    // A key may itself contain brackets, as in force[0].amplitude; the unit is the last pair.
    const std::size_t open = field.rfind(" [");
    const bool unit = open != std::string::npos && field.ends_with(']');
    heads_.push_back(boost::trim_copy(unit ? field.substr(0, open) : field));
    units_.push_back(unit ? field.substr(open + 2, field.size() - open - 3) : "");
  }
}

std::optional<std::vector<scene::TomlNode>> PointsFile::column(std::string_view name) const {
  const auto found = std::find(heads_.begin(), heads_.end(), name);
  if (found == heads_.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(found - heads_.begin());
  std::vector<scene::TomlNode> column;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    scene::TomlNode& node = column.emplace_back();
    node.kind = scene::TomlNode::Kind::kString;
    node.file = file_.string();
    node.line = lines_[i];
    node.text = units_[k].empty() ? cells_[i][k] : cells_[i][k] + " " + units_[k];
  }
  return column;
}

}  // namespace rotorub::sweep
