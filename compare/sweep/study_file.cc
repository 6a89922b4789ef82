#include "compare/sweep/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/sweep/study_reader.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using scene::TomlNode;
using Kind = TomlNode::Kind;
using Diagnostics = std::vector<scene::Diagnostic>;

// Shortest text that reads back to the same bits.
std::string number_text(double value) { return fmt::format("{}", value); }

// The value as it would stand behind `key =`.
std::string toml_text(const TomlNode& value) {
  TomlNode table;
  table.entries.emplace_back("v", value);
  std::string text = scene::write_toml(table);
  text.erase(0, text.find('=') + 2);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

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

// Why a value cannot stand in one field of a row, and behind `key =`; empty: it can.
std::string unfit(const TomlNode& node) {
  if (node.kind == Kind::kTable)
    return "expected a value, got a table; a [[vary]] for each of its keys varies them";
  if (node.kind == Kind::kDate) return "expected a value of a scene, got a date or time";
  const bool broken = std::any_of(node.text.begin(), node.text.end(),
                                  [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (broken) return "expected a text on one line, without control characters";
  for (const TomlNode& item : node.items) {
    if (std::string reason = unfit(item); !reason.empty()) return reason;
  }
  return {};
}

Value value_of(const StudyTable& table, const TomlNode& node, const std::string& name,
               const scene::Key* key) {
  const bool number = key != nullptr && (key->type == scene::ValueType::kNumber ||
                                         key->type == scene::ValueType::kWhole);
  if (!number && key != nullptr && !key->words.empty())
    say_old_word(table.path_of(name), node.text);
  if (!number) return {node.kind == Kind::kString ? node.text : toml_text(node), std::nullopt};
  const auto value = table.number(node, name, key->quantity);
  return {value ? number_text(*value) : "", value};
}

void read_values(const StudyTable& table, const TomlNode& node, const scene::Key* key, Vary& vary) {
  for (const char* other : {"from", "to", "count", "spacing"}) {
    if (!table.has(other)) continue;
    table.fail(other, "beside `values`, which says the same; give one of them");
  }
  if (node.kind != Kind::kArray || node.items.empty()) {
    table.fail("values", "expected a list of one value or more");
    return;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string name = "values[" + std::to_string(i) + "]";
    if (const std::string reason = unfit(node.items[i]); !reason.empty())
      table.fail("values", name + ": " + reason);
    vary.values.push_back(value_of(table, node.items[i], name, key));
  }
  vary.count = static_cast<std::int64_t>(vary.values.size());
}

void read_range(const StudyTable& table, const scene::Key* key, SampleKind kind, Vary& vary) {
  if (key == nullptr || key->type != scene::ValueType::kNumber) {
    table.missing("values", "a list of values: " + vary.key +
                                " is not one number, so that there is nothing between from and to");
    return;
  }
  for (const char* end : {"from", "to"}) {
    if (!table.has(end)) table.missing(end, std::string(key->quantity.name) + ", or `values`");
  }
  const auto from = table.number("from", key->quantity), to = table.number("to", key->quantity);
  constexpr std::array<std::string_view, 2> kSpacings{"linear", "log"};
  vary.spacing = table.word<Spacing>("spacing", kSpacings).value_or(Spacing::kLinear);
  if (from && to) {
    vary.from = *from;
    vary.to = *to;
    if (vary.spacing == Spacing::kLog && !(vary.from > 0.0 && vary.to > 0.0)) {
      table.fail("spacing", "log needs `from` and `to` above 0");
    }
    if (!std::isfinite(vary.to - vary.from)) table.fail("to", "too far from `from`");
  }
  if (kind == SampleKind::kGrid) {
    if (!table.has("count")) table.missing("count", "how many values of the grid, 1 or more");
    vary.count = table.whole("count", 1, kMostPoints).value_or(1);
  } else if (table.has("count")) {
    table.fail("count", "belongs to a grid; a Latin hypercube has as many values as [sample] runs");
  }
}

void read_also(const StudyTable& table, Vary& vary) {
  const TomlNode* also = table.find("also");
  if (also == nullptr) return;
  if (also->kind != Kind::kArray) return table.fail("also", "expected a list of keys");
  for (const TomlNode& item : also->items) {
    std::string reason = item.kind == Kind::kString ? "" : "expected a key, as \"drive.speed\"";
    if (reason.empty()) scene_key(item.text, reason);
    if (reason.empty() && item.text == vary.key) reason = "`" + vary.key + "` is the key itself";
    if (!reason.empty()) table.fail("also", reason);
    vary.also.push_back(item.text);
  }
}

Vary read_vary(const TomlNode& node, const std::string& path, SampleKind kind,
               Diagnostics& diagnostics) {
  const StudyTable table(node, path, {"key", "also", "values", "from", "to", "count", "spacing"},
                         diagnostics);
  Vary vary;
  const auto name = table.text("key");
  if (!name) {
    if (!table.has("key")) table.missing("key", "a key of the scene, as contact.friction");
    return vary;
  }
  vary.key = *name;
  std::string reason;
  const scene::Key* key = scene_key(vary.key, reason);
  if (!reason.empty()) {
    table.fail("key", reason);
    return vary;
  }
  if (key != nullptr && key->quantity.unit != "1") vary.unit = key->quantity.unit;
  read_also(table, vary);
  const TomlNode* values = table.find("values");
  if (kind == SampleKind::kLatinHypercube && values != nullptr) {
    table.fail("values", "belongs to a grid or a list; a Latin hypercube takes `from` and `to`");
  } else if (kind == SampleKind::kList && values == nullptr) {
    table.missing("values", "a list: in a list of points each [[vary]] gives all its values");
  } else if (values != nullptr) {
    read_values(table, *values, key, vary);
  } else {
    read_range(table, key, kind, vary);
  }
  return vary;
}

void read_sample(const TomlNode& node, Study& study, Diagnostics& diagnostics) {
  const StudyTable table(node, "sample", {"kind", "runs", "seed"}, diagnostics);
  constexpr std::array<std::string_view, 3> kKinds{"grid", "latin_hypercube", "list"};
  const auto kind = table.word<SampleKind>("kind", kKinds);
  if (!table.has("kind")) table.missing("kind", "one of " + scene::join(kKinds));
  if (!kind) return;
  study.kind = *kind;
  if (study.kind == SampleKind::kLatinHypercube) {
    if (!table.has("runs")) table.missing("runs", "how many points, 1 or more");
    study.runs = table.whole("runs", 1, kMostPoints).value_or(1);
    study.seed = static_cast<std::uint64_t>(table.whole("seed", 0, INT64_MAX).value_or(0));
    return;
  }
  for (const char* key : {"runs", "seed"}) {
    if (table.has(key)) table.fail(key, "belongs to kind = \"latin_hypercube\"");
  }
}

void read_all_vary(const TomlNode& root, Study& study, Diagnostics& diagnostics) {
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
    Vary vary = read_vary(node, path, study.kind, diagnostics);
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

enum class FiguresKept { kEnsemble, kAll };

void read_run(const TomlNode& node, Study& study, Diagnostics& diagnostics) {
  const StudyTable table(node, "run", {"engine", "integrator", "contact", "figures", "step", "end"},
                         diagnostics);
  constexpr std::array<std::string_view, 2> kEngines{"native", "mujoco"};
  constexpr std::array<std::string_view, 4> kIntegrators{"event", "midpoint", "verlet", "euler"};
  constexpr std::array<std::string_view, 2> kFigures{"ensemble", "all"};
  static const auto kContacts = scene::contact_words<std::vector<std::string_view>>();
  study.engine = table.word<EngineKind>("engine", kEngines).value_or(EngineKind::kNative);
  study.integrator = table.word<scene::Integrator>("integrator", kIntegrators);
  study.contact = table.word<scene::ContactModel>("contact", kContacts);
  study.all_figures = table.word<FiguresKept>("figures", kFigures) == FiguresKept::kAll;
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

}  // namespace

bool Study::varies(const std::string& key) const {
  return std::any_of(vary.begin(), vary.end(), [&](const Vary& v) {
    return v.key == key || std::find(v.also.begin(), v.also.end(), key) != v.also.end();
  });
}

Study read_study(const std::filesystem::path& file) {
  Study study;
  Diagnostics diagnostics;
  study.text = scene::file_text(file);
  const auto root = scene::parse_toml(study.text, file.string(), diagnostics);
  if (!root) throw scene::SceneError(std::move(diagnostics));

  const StudyTable top(*root, "", {"scene", "sample", "vary", "run"}, diagnostics);
  if (const auto scene = top.text("scene")) {
    study.scene = file.parent_path() / *scene;  // an absolute path stays one
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
  read_sample(table_of(*root, "sample", none, diagnostics), study, diagnostics);
  read_all_vary(*root, study, diagnostics);
  check_size(study, *root, diagnostics);
  read_run(table_of(*root, "run", none, diagnostics), study, diagnostics);
  if (!diagnostics.empty()) throw scene::SceneError(std::move(diagnostics));
  return study;
}

}  // namespace rotorub::sweep
