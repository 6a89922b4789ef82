#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "compare/base/columns.h"
#include "compare/engine/engine.h"
#include "compare/figures/figure.h"
#include "compare/measured/output.h"
#include "compare/run_files/summary.h"
#include "compare/sweep/point_result.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using nlohmann::json;

Trajectory short_run(const scene::Scene& scene) {
  return native_engine(scene::Integrator::kVerlet)->run(scene, {});
}

// Unit and meaning of a row, after its name.
std::string cells_of(const ColumnMeaning& column) {
  std::string text(column.meaning);
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return fmt::format(" | {} | {}{} |\n", column.unit, text,
                     column.present.empty() ? "" : fmt::format(" ({})", column.present));
}

// Neighbours that differ only in their names share a row.
std::string columns_table(std::span<const ColumnMeaning> columns) {
  std::string text = "| name | unit | meaning |\n| --- | --- | --- |\n", before;
  for (const ColumnMeaning& c : columns) {
    const std::string cells = cells_of(c);
    text += cells == before ? ", `" : before + "| `";
    text += fmt::format("{}`", c.name);
    before = cells;
  }
  return text + before;
}

// The metrics of compare.json that the summary lacks, or defines differently.
std::vector<ColumnMeaning> metrics_beyond_the_summary() {
  std::vector<ColumnMeaning> beyond;
  for (const ColumnMeaning& key : metric_keys()) {
    const bool in_summary = std::ranges::any_of(summary_keys(), [&](const ColumnMeaning& other) {
      return other.name == key.name && other.meaning == key.meaning;
    });
    if (!in_summary) beyond.push_back(key);
  }
  return beyond;
}

// The reference in compare/study/README.md: a section with a table for each file that the commands
// write.
constexpr const char* kColumnsBegin = "<!-- columns: begin (from the program) -->\n";
constexpr const char* kColumnsEnd = "<!-- columns: end -->\n";
std::string columns_markdown() {
  const std::vector<ColumnMeaning> beyond = metrics_beyond_the_summary();
  struct File {
    const char *name, *introduction;
    std::span<const ColumnMeaning> columns;
  };
  const File files[] = {{"series.csv", "", series_columns()},
                        {"impacts.csv", "", impact_columns()},
                        {"events.csv", "", event_columns()},
                        {"keyphasor.csv", "", keyphasor_columns()},
                        {"summary.json", "", summary_keys()},
                        {"compare.json: metrics of a run",
                         "The keys of `summary.json` from `mean_force` on, and:\n\n", beyond},
                        {"compare.json: a measured run", "", measured_keys()}};
  std::string text;
  for (const File& file : files) {
    text += fmt::format("### `{}`\n\n{}{}\n", file.name, file.introduction,
                        columns_table(file.columns));
  }
  return text;
}

std::string sweep_columns_markdown() {
  sweep::Study study;
  study.vary.emplace_back();
  study.vary.front().key = "<key>";
  study.vary.front().unit = "SI";
  std::vector<ColumnMeaning> own = sweep::csv_columns(study);
  own.resize(own.size() - sweep::result_columns().size());
  own[1].present = "one for each key";
  std::string whole_run, settled;
  for (const sweep::ResultColumn& column : sweep::result_columns()) {
    std::string& names = column.name == column.key ? whole_run : settled;
    names += fmt::format("{}`{}`", names.empty() ? "" : ", ", column.name);
  }
  return columns_table(own) +
         fmt::format(
             "\nThe other columns are keys of [summary.json](../study/README.md#summaryjson): {}; "
             "and, from `settled`, {}.\n",
             whole_run, settled);
}

// The text between the marks comes from the program; ROTORUB_UPDATE_REFERENCE=1 in the environment
// writes it.
void expect_in_readme(const std::string& file, const std::string& text) {
  const std::string path = std::string(ROTORUB_SOURCE_DIR) + "/" + file;
  std::stringstream content;
  content << std::ifstream(path).rdbuf();
  std::string readme = content.str();
  const std::size_t begin = readme.find(kColumnsBegin), end = readme.find(kColumnsEnd);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << "no marks in " << path;
  const std::size_t first = begin + std::string(kColumnsBegin).size();
  if (std::getenv("ROTORUB_UPDATE_REFERENCE") != nullptr) {
    std::ofstream(path) << readme.replace(first, end - first, "\n" + text);
    return;
  }
  EXPECT_EQ(readme.substr(first, end - first), "\n" + text)
      << path << " is behind the program; run this test with ROTORUB_UPDATE_REFERENCE=1";
}

TEST(ColumnFiles, StandInTheReadmesAsTheProgramHasThem) {
  expect_in_readme("compare/study/README.md", columns_markdown());
  expect_in_readme("compare/sweep/README.md", sweep_columns_markdown() + "\n");
}

const std::string kTwoRings =
    std::string(ROTORUB_SOURCE_DIR) + "/tests/native_model/event/two_rings/moving.toml";
const std::vector<std::string> kShort{"run.end=2e-5", "run.step=1e-5", "run.output_step=1e-5",
                                      "run.output_times=none"};

// Leaves of an object, as "contact_mass.kept", "contacts[].name".
void collect(const json& object, const std::string& prefix, std::set<std::string>& keys) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      collect(value, prefix + key + ".", keys);
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      collect(value.front(), prefix + key + "[].", keys);
    } else {
      keys.insert(prefix + key);
    }
  }
}

std::set<std::string> names_of(std::span<const ColumnMeaning> columns) {
  std::set<std::string> names;
  for (const ColumnMeaning& column : columns) {
    EXPECT_TRUE(names.emplace(column.name).second) << column.name << " stands twice";
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
  return names;
}

// Every key that is written is documented, and no other.
TEST(ColumnFiles, NameTheKeysOfSummaryAndMetrics) {
  std::set<std::string> written;
  for (const char* name : {"paper_passive", "touchdown_ball_bearing"}) {
    const scene::Scene scene = test::shipped(name, {"run.end=1e-3"});
    collect(summary_json(scene, short_run(scene)), "", written);
  }
  const scene::Scene several = scene::read_scene(kTwoRings, kShort);
  collect(summary_json(several, short_run(several)), "", written);
  written.erase("contact_mass");  // null: modal data
  written.erase("above_modes");
  EXPECT_EQ(written, names_of(summary_keys()));
  std::set<std::string> metrics;
  collect(metrics_json({}), "", metrics);
  EXPECT_EQ(metrics, names_of(metric_keys()));
}

// Each column of a run by its own name, in the order of the file, with the unit that the recorder
// gave it.
TEST(ColumnFiles, NameEveryColumnOfEveryShippedScene) {
  std::set<std::string_view> met;
  std::vector<std::filesystem::path> files{kTwoRings};
  for (const auto& entry : std::filesystem::directory_iterator(ROTORUB_MJCF_DIR)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  for (const std::filesystem::path& file : files) {
    const scene::Scene scene = scene::read_scene(file, kShort);
    const Trajectory run = native_engine(scene.run.integrator)->run(scene, {});
    const auto series = run_columns_json(run).at("series.csv");
    ASSERT_EQ(series.size(), run.series.size());
    for (std::size_t k = 0; k < series.size(); ++k) {
      const ColumnMeaning& meaning = series_column(run.series[k].name);
      met.insert(meaning.name);
      EXPECT_EQ(series[k].at("name"), run.series[k].name);
      EXPECT_EQ(series[k].at("unit"), run.series[k].unit);
      const bool further = contact_of_column(run.series[k].name).first > 0;
      if (further) met.insert("contact<k>_<column>");
      if (meaning.name != "control_<name>") {
        EXPECT_EQ(run.series[k].unit, meaning.unit) << run.series[k].name;
      }
    }
  }
  for (const ColumnMeaning& column : series_columns()) {
    EXPECT_TRUE(met.contains(column.name)) << "no shipped scene has " << column.name;
  }
}

TEST(ColumnFiles, NumberedColumnsAreToldApart) {
  EXPECT_EQ(series_column("torsion_12").unit, "rad");
  EXPECT_EQ(series_column("torsion_speed_1").unit, "rad/s");
  EXPECT_EQ(series_column("x_3").name, "x_<n>");
  EXPECT_EQ(series_column("control_x").unit, "N");
  EXPECT_EQ(series_column("control_x_1").name, "control_<name>") << "a law's own";
}

// A sentence a figure in SI, whatever unit it is shown in.
TEST(ColumnFiles, FiguresAreInSi) {
  const std::set<std::string_view> units{
      "", "s", "m", "m/s", "N", "N s", "J", "rad/s", "us"};  // us_per_step has it in its name
  for (const ColumnMeaning& key : metric_keys())
    EXPECT_TRUE(units.contains(key.unit)) << key.name << ": " << key.unit;
  for (const Figure& f : figures()) {
    const std::string_view shown = f.unit;
    const bool pure = shown.empty() || shown == "%" || shown == "ppm";
    EXPECT_EQ(figure_si_unit(f).empty(), pure) << f.key;
  }
}

}  // namespace
}  // namespace rotorub
