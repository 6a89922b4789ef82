#include "compare/sweep/study_statistics.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/sweep/point_result.h"
#include "compare/sweep/study_file.h"
#include "compare/sweep/study_reader.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using scene::TomlNode;

std::vector<std::string_view> figure_names() {
  std::vector<std::string_view> names{"status"};
  for (const ResultColumn& column : result_columns()) names.push_back(column.name);
  return names;
}

// The strings of a list; each must be in `known`.
std::vector<std::string> words_of(const StudyTable& table, const char* key,
                                  const std::vector<std::string_view>& known) {
  const TomlNode* list = table.find(key);
  std::vector<std::string> words;
  if (list == nullptr) return words;
  if (list->kind != TomlNode::Kind::kArray || list->items.empty()) {
    table.fail(key, "expected a list; accepted: " + scene::join(known));
    return words;
  }
  for (const TomlNode& item : list->items) {
    if (item.kind == TomlNode::Kind::kString &&
        std::find(known.begin(), known.end(), item.text) != known.end()) {
      words.push_back(item.text);
    } else {
      table.fail(key, fmt::format("{}; accepted: {}",
                                  item.kind == TomlNode::Kind::kString
                                      ? "`" + scene::printable(item.text) + "`"
                                      : std::string(kind_name(item.kind)),
                                  scene::join(known)));
    }
  }
  return words;
}

// A number in (0, 1).
std::optional<double> share_at(const StudyTable& table, const char* key, const TomlNode& node) {
  const auto share = table.number(node, key, scene::kPure);
  if (share && *share > 0.0 && *share < 1.0) return share;
  if (share) table.fail(key, "expected numbers above 0 and below 1");
  return std::nullopt;
}

// Whether a key takes few values, so that several points share one.
bool makes_groups(const Study& study, const Vary& vary) {
  return !is_drawn(study.kind) || !vary.values.empty() || vary.whole;
}

}  // namespace

Statistics read_statistics(const TomlNode& node, const Study& study,
                           std::vector<scene::Diagnostic>& diagnostics) {
  const StudyTable table(node, "statistics", {"figures", "by", "quantiles", "confidence"},
                         diagnostics);
  Statistics out;
  if (table.has("figures")) out.figures = words_of(table, "figures", figure_names());
  std::vector<std::string_view> keys;
  for (const Vary& vary : study.vary) keys.push_back(vary.key);
  for (const std::string& key : words_of(table, "by", keys)) {
    const auto k =
        static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
    if (!makes_groups(study, study.vary[k])) {
      table.fail("by", key +
                           " is drawn from a range, so that each point would be a group; "
                           "accepted: keys with `values`, or of whole numbers");
    }
    out.by.push_back(k);
  }
  if (const TomlNode* list = table.find("quantiles")) {
    out.quantiles.clear();
    if (list->kind != TomlNode::Kind::kArray)
      table.fail("quantiles", "expected a list of numbers above 0 and below 1");
    for (const TomlNode& item : list->items) {
      if (const auto p = share_at(table, "quantiles", item)) out.quantiles.push_back(*p);
    }
  }
  if (const TomlNode* value = table.find("confidence"))
    out.confidence = share_at(table, "confidence", *value).value_or(out.confidence);
  return out;
}

}  // namespace rotorub::sweep
