#include "compare/optimise/goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "compare/run_files/summary.h"
#include "compare/sweep/study_reader.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::optimise {
namespace {

using scene::TomlNode;
using sweep::StudyTable;
using Diagnostics = std::vector<scene::Diagnostic>;
using nlohmann::json;

const json* element_of(const json& list, const std::string& part) {
  std::size_t k = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), k);
  const bool whole = error == std::errc() && end == part.data() + part.size();
  return whole && k < list.size() ? &list[k] : nullptr;
}

// Appends the numbers at the path to `numbers`. Returns false if some branch does not end at a
// number.
bool gather(const json& at, std::span<const std::string> parts, std::vector<double>& numbers) {
  if (parts.empty()) {
    if (!at.is_number() || !std::isfinite(at.get<double>())) return false;
    numbers.push_back(at.get<double>());
    return true;
  }
  const std::string& part = parts.front();
  if (at.is_array() && part == "*") {
    return std::all_of(at.begin(), at.end(),
                       [&](const json& item) { return gather(item, parts.subspan(1), numbers); });
  }
  const json* next = at.is_array()                         ? element_of(at, part)
                     : at.is_object() && at.contains(part) ? &at.at(part)
                                                           : nullptr;
  return next != nullptr && gather(*next, parts.subspan(1), numbers);
}

// The first part of a run's figure is checked before any run, because a typing error would waste
// all runs.
void check_name(const FigurePath& path) {
  if (path.source != Source::kRun) return;
  std::vector<std::string_view> known{"contacts", "residuals"};  // their contents are not checked
  for (const ColumnMeaning& key : summary_keys())
    known.push_back(key.name.substr(0, key.name.find('.')));
  if (std::ranges::find(known, path.parts.front()) != known.end()) return;
  const std::string_view meant = scene::nearest(path.parts.front(), known);
  throw std::invalid_argument(
      fmt::format("a run has no figure `{}`{} Give a key of its summary.json, or `modes.` and the "
                  "place of a number in the output of `rotorub modes --json`",
                  scene::printable(path.text),
                  meant.empty() ? "." : fmt::format(", did you mean `{}`?", meant)));
}

std::optional<FigurePath> figure_of(const StudyTable& table, const char* key) {
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  try {
    const FigurePath path = parse_figure(*text);
    check_name(path);
    return path;
  } catch (const std::invalid_argument& error) {
    table.fail(key, error.what());
    return std::nullopt;
  }
}

// The limit is in SI, because the text of a figure does not determine its unit.
void read_constraint(const StudyTable& table, Goal& goal) {
  const auto figure = figure_of(table, "figure");
  if (!table.has("figure")) table.missing("figure", "a figure, as `minimise` takes it");
  if (table.has("min") == table.has("max")) {
    table.fail(
        table.has("min") ? "max" : "figure",
        table.has("min")
            ? "cannot be given together with `min`; give each limit its own [[optimise.constraint]]"
            : "has no limit; give `min` or `max` in SI units");
    return;
  }
  const bool is_max = table.has("max");
  const auto limit = table.number(is_max ? "max" : "min", scene::kPure);
  if (figure && limit) goal.constraints.push_back({*figure, *limit, is_max});
}

Goal read_goal(TomlNode& node, Diagnostics& diagnostics) {
  const StudyTable table(
      node, "optimise",
      {"minimise", "maximise", "algorithm", "evaluations", "tolerance", "constraint"}, diagnostics);
  Goal goal;
  goal.maximise = table.has("maximise");
  if (goal.maximise == table.has("minimise"))
    table.fail("minimise", "expected exactly one of `minimise` and `maximise`, with a figure");
  if (const auto figure = figure_of(table, goal.maximise ? "maximise" : "minimise"))
    goal.figure = *figure;
  goal.algorithm =
      table.word<Algorithm>("algorithm", {"cobyla", "bobyqa", "nelder_mead", "subplex", "direct"})
          .value_or(goal.algorithm);
  goal.evaluations =
      static_cast<int>(table.whole("evaluations", 1, 1'000'000).value_or(goal.evaluations));
  goal.tolerance = table.number("tolerance", scene::kPure).value_or(goal.tolerance);
  if (!(goal.tolerance > 0.0 && goal.tolerance < 1.0))
    table.fail("tolerance", "expected a share of the keys' ranges, above 0 and below 1");
  TomlNode* list = node.find("constraint");
  if (list == nullptr) return goal;
  if (list->kind != TomlNode::Kind::kArray) {
    table.fail("constraint", "expected tables [[optimise.constraint]]");
    return goal;
  }
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    if (list->items[k].kind != TomlNode::Kind::kTable) {
      table.fail("constraint", "expected tables [[optimise.constraint]]");
      continue;
    }
    read_constraint(StudyTable(list->items[k], fmt::format("optimise.constraint[{}]", k),
                               {"figure", "min", "max"}, diagnostics),
                    goal);
  }
  const bool takes = goal.algorithm == Algorithm::kCobyla || goal.algorithm == Algorithm::kDirect;
  if (!takes && !goal.constraints.empty())
    table.fail("algorithm", "does not support constraints; choose cobyla or direct");
  return goal;
}

}  // namespace

bool Goal::needs(Source source) const {
  return figure.source == source ||
         std::any_of(constraints.begin(), constraints.end(),
                     [&](const Constraint& c) { return c.figure.source == source; });
}

FigurePath parse_figure(const std::string& text) {
  FigurePath path;
  path.text = text;
  boost::split(path.parts, text, boost::is_any_of("."));
  if (path.parts.front() == "modes") {
    path.source = Source::kModes;
    path.parts.erase(path.parts.begin());
  }
  const bool empty =
      path.parts.empty() || std::any_of(path.parts.begin(), path.parts.end(),
                                        [](const std::string& part) { return part.empty(); });
  if (empty) {
    throw std::invalid_argument(
        "expected a figure of the run, for example \"peak_force\" or \"settled.spin_speed\", or a "
        "number of `rotorub modes --json`, for example \"modes.speeds.0.modes.*.damping_ratio\"");
  }
  return path;
}

std::optional<double> figure_value(const FigurePath& path, const json& all, bool largest) {
  std::vector<double> numbers;
  if (!gather(all, path.parts, numbers) || numbers.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return largest ? *high : *low;
}

Task read_task(const std::filesystem::path& file) {
  Task task{sweep::read_study(file, sweep::StudyUse::kOptimise), {}};
  Diagnostics diagnostics;
  auto root = scene::parse_toml(task.study.text, file.string(), diagnostics);
  TomlNode* node = root ? root->find("optimise") : nullptr;
  if (node == nullptr || node->kind != TomlNode::Kind::kTable) {
    diagnostics.push_back({file.string(), node ? node->line : 0, "optimise",
                           "missing: expected a table [optimise] with `minimise` or `maximise`"});
  } else {
    task.goal = read_goal(*node, diagnostics);
  }
  if (!diagnostics.empty()) throw scene::SceneError(std::move(diagnostics));
  return task;
}

}  // namespace rotorub::optimise
