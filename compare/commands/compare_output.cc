#include "compare/commands/compare_output.h"

#include <nlohmann/json.hpp>

#include "compare/study/json.h"
#include "compare/study/run_directory.h"
#include "native_model/trajectory/output.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
using std::filesystem::path;

void write_runs(const path& folder, const SceneComparison& comparison) {
  const auto times = output_times(comparison.scene.run);
  for (const Side& side : comparison.sides) {
    write_run(folder / comparison.scene.name / side.label, comparison.scene,
              rows_at(side.trajectory, times));
  }
}

void write_report(const path& folder, const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages) {
  std::filesystem::create_directories(folder);
  write_whole(folder / "compare.json", json_text(comparisons_json(comparisons)));
  if (!pages.empty()) write_whole(folder / "report.html", report_page(pages));
}

}  // namespace rotorub
