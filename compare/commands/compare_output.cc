#include "compare/commands/compare_output.h"

#include <nlohmann/json.hpp>

#include "compare/base/columns.h"
#include "compare/base/json.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/json.h"
#include "native_model/trajectory/output.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
using std::filesystem::path;

void write_runs(const path& folder, const SceneComparison& comparison, hdf5::ImageOf hdf5) {
  const auto times = output_times(comparison.scene.run);
  const auto write = [&](const std::string& name, const Side& side) {
    write_run(folder / comparison.scene.name / name, comparison.scene,
              rows_at(side.trajectory, times), hdf5);
  };
  for (const Side& side : comparison.sides) write(side.label, side);
  if (comparison.interrupted) return;
  if (comparison.shadow.side) write(kShadowFolder, *comparison.shadow.side);
  for (std::size_t k = 0; k < comparison.natives.size(); ++k) {
    write("native-" + comparison.sides[k + 2].label, comparison.natives[k]);
  }
}

void write_report(const path& folder, const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages, const Beside& beside) {
  std::filesystem::create_directories(folder);
  write_whole(folder / "compare.json", json_text(comparisons_json(comparisons)));
  write_whole(folder / kColumnsFile, columns_text(compare_columns_json()));
  if (!pages.empty()) write_whole(folder / "report.html", report_page(pages, beside));
}

}  // namespace rotorub
