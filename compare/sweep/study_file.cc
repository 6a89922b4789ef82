#include "compare/sweep/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/sweep/point_result.h"
#include "compare/sweep/study_reader.h"
#include "compare/sweep/study_vary.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using scene::TomlNode;
using Kind = TomlNode::Kind;
using Diagnostics = std::vector<scene::Diagnostic>;

const TomlNode& table_of(const TomlNode& root, const std::string& name, const TomlNode& none,
                         Diagnostics& diagnostics) {
  const TomlNode* node = root.find(name);
  if (node == nullptr) return none;
  if (node->kind == Kind::kTable) return *node;
  diagnostics.push_back(
      {node->file, node->line, name,
       fmt::format("expected one table [{}], got {}", name, kind_name(node->kind))});
  return none;
}

void read_sample(const TomlNode& node, const std::filesystem::path& folder, Study& study,
                 PointsFile& points, Diagnostics& diagnostics) {
  const StudyTable table(node, "sample", {"kind", "runs", "seed", "file"}, diagnostics);
  constexpr std::array<std::string_view, 5> kSamples{"grid", "latin_hypercube", "list", "random",
                                                     "sobol"};
  const auto kind = table.word<SampleKind>("kind", kSamples);
  if (!table.has("kind")) table.missing("kind", "one of " + scene::join(kSamples));
  if (!kind) return;
  study.kind = *kind;
  if (table.has("file") && study.kind != SampleKind::kList)
    table.fail("file", "belongs to kind = \"list\"");
  if (const auto file = table.text("file"); file && study.kind == SampleKind::kList) {
    try {
      points = read_points(folder / *file);
      study.points = points.text;
    } catch (const scene::SceneError& error) {
      table.fail("file", error.what());
    }
  }
  if (is_drawn(study.kind)) {
    if (!table.has("runs")) table.missing("runs", "how many points, 1 or more");
    study.runs = table.whole("runs", 1, kMostPoints).value_or(1);
    study.seed = static_cast<std::uint64_t>(table.whole("seed", 0, INT64_MAX).value_or(0));
    return;
  }
  for (const char* key : {"runs", "seed"}) {
    if (table.has(key))
      table.fail(key,
                 "belongs to kind = \"random\", \"latin_hypercube\" or \"sobol\", whose points are "
                 "drawn");
  }
}

void read_all_vary(const TomlNode& root, const PointsFile& points, Study& study,
                   Diagnostics& diagnostics) {
  const TomlNode* list = root.find("vary");
  if (list == nullptr || list->kind != Kind::kArray || list->items.empty()) {
    diagnostics.push_back({root.file, list ? list->line : 0, "vary",
                           "missing: expected one table [[vary]] or more, each with a key"});
    return;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const TomlNode& node = list->items[i];
    const std::string path = "vary[" + std::to_string(i) + "]";
    if (node.kind != Kind::kTable) {
      diagnostics.push_back({node.file, node.line, path, "expected a table [[vary]]"});
      continue;
    }
    Vary vary = read_vary(node, path, study.kind, points, diagnostics);
    const auto refuse = [&](std::string reason) {
      diagnostics.push_back({node.file, node.line, path, std::move(reason)});
    };
    std::vector<std::string> keys{vary.key};
    keys.insert(keys.end(), vary.also.begin(), vary.also.end());
    for (const std::string& key : keys) {
      if (!key.empty() && study.varies(key)) refuse("`" + key + "` varies twice");
    }
    const auto first = std::find_if(study.vary.begin(), study.vary.end(),
                                    [](const Vary& v) { return v.count > 0; });
    if (study.kind == SampleKind::kList && first != study.vary.end() && vary.count > 0 &&
        vary.count != first->count) {
      refuse(fmt::format("{} values where vary[{}] has {}; in a list of points all have one length",
                         vary.count, first - study.vary.begin(), first->count));
    }
    study.vary.push_back(std::move(vary));
  }
}

// Checks the ranges of an optimisation.
void check_ranges(const TomlNode& root, const Study& study, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < study.vary.size(); ++k) {
    const Vary& vary = study.vary[k];
    if (vary.values.empty() && !vary.whole && !vary.distribution && vary.from < vary.to) continue;
    diagnostics.push_back({root.file, 0, fmt::format("vary[{}]", k),
                           "an optimisation takes a range of numbers: `from`, and `to` above it"});
  }
}

void check_size(const Study& study, const TomlNode& root, Diagnostics& diagnostics) {
  if (study.kind != SampleKind::kGrid) return;
  double points = 1.0;
  for (const Vary& vary : study.vary) {
    points *= static_cast<double>(std::max<std::int64_t>(vary.count, 1));
  }
  if (points <= static_cast<double>(kMostPoints)) return;
  diagnostics.push_back({root.file, 0, "vary",
                         fmt::format("the grid has {:.3g} points; accepted: at most {:.3g}", points,
                                     static_cast<double>(kMostPoints))});
}

void read_run(const TomlNode& node, Study& study, Diagnostics& diagnostics) {
  const StudyTable table(node, "run", {"engine", "integrator", "contact", "figures", "step", "end"},
                         diagnostics);
  constexpr std::array<std::string_view, 2> kEngines{"native", "mujoco"};
  constexpr std::array<std::string_view, 3> kIntegrators{"event", "verlet", "euler"};
  static const auto kContacts = scene::contact_words<std::vector<std::string_view>>();
  study.engine = table.word<EngineKind>("engine", kEngines).value_or(EngineKind::kNative);
  study.integrator = table.word<scene::Integrator>("integrator", kIntegrators);
  study.contact = table.word<scene::ContactModel>("contact", kContacts);
  if (table.has("figures")) {
    fmt::print(stderr,
               "note: {}: every point has all figures now; the key is accepted until version 0.4\n",
               table.path_of("figures"));
  }
  if (study.integrator) {
    if (study.engine == EngineKind::kMujoco) {
      table.fail("integrator", "belongs to engine = \"native\"; MuJoCo's is mujoco.integrator");
    }
    if (study.varies("run.integrator")) table.fail("integrator", "run.integrator varies");
  }
  if (study.contact) {
    if (study.engine == EngineKind::kNative && *study.contact != scene::ContactModel::kRigid) {
      table.fail("contact", "belongs to engine = \"mujoco\"; the native engine accepts: rigid");
    }
    if (study.varies("mujoco.contact")) table.fail("contact", "mujoco.contact varies");
  }
  for (const char* key : {"step", "end"}) {
    const auto value = table.number(key, scene::kTime);
    if (!value) continue;
    if (!(*value > 0.0)) table.fail(key, "expected a time above 0");
    const std::string name = std::string("run.") + key;
    if (study.varies(name)) table.fail(key, name + " varies");
    study.overrides.push_back(name + "=" + number_text(*value));
  }
}

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

// Call it after the varied keys were read.
Statistics read_statistics(const TomlNode& node, const Study& study, Diagnostics& diagnostics) {
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

}  // namespace

bool Study::varies(const std::string& key) const {
  return std::any_of(vary.begin(), vary.end(), [&](const Vary& v) {
    return v.key == key || std::find(v.also.begin(), v.also.end(), key) != v.also.end();
  });
}

std::string study_identity(const std::string& text) {
  Diagnostics none;
  auto root = scene::parse_toml(text, "", none);
  if (!root) return text;
  std::erase_if(root->entries, [](const auto& entry) {
    return entry.first == "statistics" || entry.first == "optimise";
  });
  return scene::write_toml(*root);
}

Study read_study(const std::filesystem::path& file, StudyUse use) {
  Study study;
  Diagnostics diagnostics;
  study.text = scene::file_text(file);
  const auto root = scene::parse_toml(study.text, file.string(), diagnostics);
  if (!root) throw scene::SceneError(std::move(diagnostics));

  const StudyTable top(*root, "", {"scene", "sample", "vary", "run", "statistics", "optimise"},
                       diagnostics);
  if (const auto scene = top.text("scene")) {
    study.scene = file.parent_path() / *scene;  // an absolute path stays absolute
    try {
      scene::file_text(study.scene);
    } catch (const scene::SceneError& error) {
      top.fail("scene", error.what());
    }
  } else if (!top.has("scene")) {
    top.missing("scene", "a scene file, beside the study or absolute");
  }
  TomlNode none;
  none.file = file.string();
  PointsFile points;
  // An optimisation chooses its own points.
  study.kind = SampleKind::kRandom;
  if (use == StudyUse::kSweep || root->find("sample") != nullptr) {
    read_sample(table_of(*root, "sample", none, diagnostics), file.parent_path(), study, points,
                diagnostics);
  }
  read_all_vary(*root, points, study, diagnostics);
  if (use == StudyUse::kOptimise) check_ranges(*root, study, diagnostics);
  check_size(study, *root, diagnostics);
  read_run(table_of(*root, "run", none, diagnostics), study, diagnostics);
  if (root->find("statistics") != nullptr)
    study.statistics =
        read_statistics(table_of(*root, "statistics", none, diagnostics), study, diagnostics);
  if (!diagnostics.empty()) throw scene::SceneError(std::move(diagnostics));
  study.identity = study_identity(study.text) + study.points;
  return study;
}

}  // namespace rotorub::sweep
