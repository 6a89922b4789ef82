#include "compare/sweep/study_file.h"

#include <fmt/format.h>

#include <algorithm>

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
  if (list->kind != Kind::kArray || list->items.empty()) {
    table.fail(key, "expected a list of these words: " + scene::join(known));
    return words;
  }
  for (const TomlNode& item : list->items) {
    if (item.kind == Kind::kString &&
        std::find(known.begin(), known.end(), item.text) != known.end()) {
      words.push_back(item.text);
    } else {
      table.fail(key, item.kind == Kind::kString
                          ? "unknown word `" + scene::printable(item.text) + "`" +
                                scene::suggestion(item.text, known)
                          : "expected words in quotes, got " + std::string(kind_name(item.kind)) +
                                "; choose from " + scene::join(known));
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

class StudyReader {
 public:
  explicit StudyReader(const std::filesystem::path& file) : file_(file) {
    study_.text = scene::file_text(file);
    auto root = scene::parse_toml(study_.text, file.string(), diagnostics_);
    if (!root) throw scene::SceneError(std::move(diagnostics_));
    root_ = std::move(*root);
  }

  Study read(StudyUse use) {
    refuse_scene();
    const StudyTable top(root_, "", {"scene", "sample", "vary", "run", "statistics", "optimise"},
                         diagnostics_);
    read_scene(top);
    // An optimisation chooses its own points.
    study_.kind = SampleKind::kRandom;
    const bool is_known = (use != StudyUse::kSweep && !top.has("sample")) || read_sample(top);
    // Which keys [[vary]] may have depends on the kind of [sample].
    if (is_known) {
      read_all_vary();
      if (use == StudyUse::kOptimise) check_ranges();
      check_size();
    }
    read_run(top);
    if (is_known && top.has("statistics")) read_statistics(top);
    if (!diagnostics_.empty()) throw scene::SceneError(std::move(diagnostics_));
    study_.identity = study_identity(study_.text) + study_.points;
    return std::move(study_);
  }

 private:
  void fail(int line, const std::string& key, std::string reason) {
    diagnostics_.push_back({root_.file, line, key, std::move(reason)});
  }

  // Refuses a scene with one sentence, because none of its keys belongs to a study.
  void refuse_scene() {
    const TomlNode* rotor = root_.find("rotor");
    if (rotor == nullptr || root_.find("scene") != nullptr || root_.find("vary") != nullptr) return;
    fail(rotor->line, "rotor",
         "this file is a scene, not a study; give it to `rotorub run`, or write a study with "
         "`scene = \"" +
             file_.filename().string() + "\"` (compare/sweep/README.md)");
    throw scene::SceneError(std::move(diagnostics_));
  }

  void read_scene(const StudyTable& top) {
    if (!top.has("scene"))
      top.missing("scene", "the name of a scene file, relative to the study or absolute");
    const auto scene = top.text("scene");
    if (!scene) return;
    study_.scene = file_.parent_path() / *scene;  // an absolute path stays absolute
    try {
      scene::file_text(study_.scene);
    } catch (const scene::SceneError& error) {
      top.fail("scene", error.what());
    }
  }

  // Returns false if the kind is missing or unknown.
  bool read_sample(const StudyTable& top) {
    const StudyTable table = top.table("sample", {"kind", "runs", "seed", "file"});
    const std::vector<std::string_view> kinds{"grid", "latin_hypercube", "list", "random", "sobol"};
    const auto kind = table.word<SampleKind>("kind", kinds);
    if (!table.has("kind")) {
      table.fail("kind",
                 "is missing. Add [sample] kind = \"grid\", or choose list, random, "
                 "latin_hypercube or sobol.");
    }
    if (!kind) return false;
    study_.kind = *kind;
    if (table.has("file") && study_.kind != SampleKind::kList)
      table.fail("file", "belongs to kind = \"list\"; remove it, or change the kind");
    if (const auto file = table.text("file"); file && study_.kind == SampleKind::kList) {
      try {
        points_ = read_points(file_.parent_path() / *file);
        study_.points = points_.text;
      } catch (const scene::SceneError& error) {
        table.fail("file", error.what());
      }
    }
    if (is_drawn(study_.kind)) {
      if (!table.has("runs")) table.missing("runs", "the number of points, 1 or more");
      study_.runs = table.whole("runs", 1, kMostPoints).value_or(1);
      study_.seed = static_cast<std::uint64_t>(table.whole("seed", 0, INT64_MAX).value_or(0));
      return true;
    }
    for (const char* key : {"runs", "seed"}) {
      if (table.has(key))
        table.fail(key,
                   "belongs to kind = \"random\", \"latin_hypercube\" or \"sobol\", whose points "
                   "are drawn");
    }
    return true;
  }

  void read_all_vary() {
    TomlNode* list = root_.find("vary");
    if (list == nullptr || list->kind != Kind::kArray || list->items.empty())
      return fail(list ? list->line : 0, "vary",
                  "missing: expected at least one table [[vary]] with a key");
    for (TomlNode& node : list->items) {
      const std::string path = scene::list_element("vary", &node - list->items.data());
      if (node.kind != Kind::kTable) {
        fail(node.line, path, "expected a table [[vary]]");
        continue;
      }
      Vary vary = read_vary(node, path, study_.kind, points_, diagnostics_);
      std::vector<std::string> keys{vary.key};
      keys.insert(keys.end(), vary.also.begin(), vary.also.end());
      for (const std::string& key : keys) {
        if (!key.empty() && study_.varies(key)) fail(node.line, path, "`" + key + "` varies twice");
      }
      const auto first = std::find_if(study_.vary.begin(), study_.vary.end(),
                                      [](const Vary& v) { return v.count > 0; });
      if (study_.kind == SampleKind::kList && first != study_.vary.end() && vary.count > 0 &&
          vary.count != first->count) {
        fail(node.line, path,
             fmt::format(
                 "has {} values, but vary[{}] has {}; in a list of points, give all keys the same "
                 "number of values",
                 vary.count, first - study_.vary.begin(), first->count));
      }
      study_.vary.push_back(std::move(vary));
    }
  }

  // Checks the ranges of an optimisation.
  void check_ranges() {
    for (std::size_t k = 0; k < study_.vary.size(); ++k) {
      const Vary& v = study_.vary[k];
      if (v.values.empty() && !v.whole && !v.distribution && v.from < v.to) continue;
      fail(0, scene::list_element("vary", k),
           "an optimisation needs a range of numbers; give `from`, and `to` above it");
    }
  }

  void check_size() {
    if (study_.kind != SampleKind::kGrid) return;
    double points = 1.0;
    for (const Vary& vary : study_.vary)
      points *= static_cast<double>(std::max<std::int64_t>(vary.count, 1));
    if (points <= static_cast<double>(kMostPoints)) return;
    fail(0, "vary",
         fmt::format("the grid has {:.3g} points, but at most {:.3g} are accepted; lower a `count`",
                     points, static_cast<double>(kMostPoints)));
  }

  void read_run(const StudyTable& top) {
    const StudyTable table =
        top.table("run", {"engine", "integrator", "contact", "figures", "step", "end"});
    study_.engine =
        table.word<EngineKind>("engine", {"native", "mujoco"}).value_or(EngineKind::kNative);
    study_.integrator = table.word<scene::Integrator>("integrator", {"event", "verlet", "euler"});
    study_.contact = table.word<scene::ContactModel>(
        "contact", scene::contact_words<std::vector<std::string_view>>());
    if (table.has("figures")) {
      fmt::print(
          stderr,
          "note: {}: this key has no effect, because every point has all figures; it is accepted "
          "until version 0.4\n",
          table.path_of("figures"));
    }
    if (study_.integrator) {
      if (study_.engine == EngineKind::kMujoco)
        table.fail("integrator",
                   "belongs to engine = \"native\"; for MuJoCo set mujoco.integrator in the scene");
      if (study_.varies("run.integrator"))
        table.fail("integrator", "cannot be set, because run.integrator varies; remove one");
    }
    if (study_.contact) {
      if (study_.engine == EngineKind::kNative && *study_.contact != scene::ContactModel::kRigid)
        table.fail("contact", "belongs to engine = \"mujoco\"; the native engine has only rigid");
      if (study_.varies("mujoco.contact"))
        table.fail("contact", "cannot be set, because mujoco.contact varies; remove one");
    }
    for (const std::string key : {"step", "end"}) {
      const auto value = table.number(key, scene::kTime);
      if (!value) continue;
      if (!(*value > 0.0)) table.fail(key, "expected a time above 0");
      if (study_.varies("run." + key))
        table.fail(key, "cannot be set, because run." + key + " varies; remove one");
      study_.overrides.push_back("run." + key + "=" + number_text(*value));
    }
  }

  void read_statistics(const StudyTable& top) {
    const StudyTable table = top.table("statistics", {"figures", "by", "quantiles", "confidence"});
    Statistics& out = study_.statistics.emplace();
    if (table.has("figures")) out.figures = words_of(table, "figures", figure_names());
    std::vector<std::string_view> keys;
    for (const Vary& vary : study_.vary) keys.push_back(vary.key);
    for (const std::string& key : words_of(table, "by", keys)) {
      const auto k =
          static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
      if (!makes_groups(study_, study_.vary[k])) {
        table.fail("by", key +
                             " is drawn from a range, so each point would be a group; "
                             "give keys with `values` or with whole numbers");
      }
      out.by.push_back(k);
    }
    if (const TomlNode* list = table.find("quantiles")) {
      out.quantiles.clear();
      if (list->kind != Kind::kArray)
        table.fail("quantiles", "expected a list of numbers above 0 and below 1");
      for (const TomlNode& item : list->items) {
        if (const auto p = share_at(table, "quantiles", item)) out.quantiles.push_back(*p);
      }
    }
    if (const TomlNode* value = table.find("confidence"))
      out.confidence = share_at(table, "confidence", *value).value_or(out.confidence);
  }

  std::filesystem::path file_;
  TomlNode root_;
  Study study_;
  PointsFile points_;
  std::vector<scene::Diagnostic> diagnostics_;
};

}  // namespace

bool Vary::has_numbers() const {
  return std::ranges::all_of(values, [](const Value& value) { return value.number.has_value(); });
}

bool Study::varies(const std::string& key) const {
  return std::any_of(vary.begin(), vary.end(), [&](const Vary& v) {
    return v.key == key || std::find(v.also.begin(), v.also.end(), key) != v.also.end();
  });
}

std::string study_identity(const std::string& text) {
  std::vector<scene::Diagnostic> none;
  auto root = scene::parse_toml(text, "", none);
  if (!root) return text;
  std::erase_if(root->entries, [](const auto& entry) {
    return entry.first == "statistics" || entry.first == "optimise";
  });
  return scene::write_toml(*root);
}

Study read_study(const std::filesystem::path& file, StudyUse use) {
  return StudyReader(file).read(use);
}

}  // namespace rotorub::sweep
