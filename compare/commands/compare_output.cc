#include "compare/commands/compare_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/study/json.h"
#include "compare/study/run_directory.h"
#include "native_model/trajectory/output.h"
#include "native_model/trajectory/recorder.h"
#include "renders/film.h"

namespace rotorub {
namespace {

using std::filesystem::path;

renders::RenderOptions film_options() {
  renders::RenderOptions options;
  options.width = 800;
  options.height = 450;
  options.duration = 12.0;
  options.quality = 27;
  return options;
}

}  // namespace

void write_runs(const path& folder, const SceneComparison& comparison) {
  const auto times = output_times(comparison.scene.run);
  for (const Side& side : comparison.sides) {
    write_run(folder / comparison.scene.name / side.label, comparison.scene,
              rows_at(side.trajectory, times));
  }
}

std::vector<Film> write_films(const path& folder, const SceneComparison& comparison,
                              const std::function<void(double)>& progress) {
  std::vector<Film> films;
  renders::RenderOptions options = film_options();
  const std::size_t count = comparison.sides.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Side& side = comparison.sides[k];
    if (side.trajectory.status != Status::kOk) continue;
    options.progress = [&](double share) {
      progress((static_cast<double>(k) + share) / static_cast<double>(count));
    };
    const path file = folder / comparison.scene.name / (side.label + ".mp4");
    const auto result = renders::render(comparison.scene, side.trajectory, options, file);
    films.push_back(
        {file, fmt::format("{}{}: slowed down {:.3g} times, displacements magnified {:.3g} times",
                           side.label,
                           options.shadow ? ", with the native run as a ghost" : "",
                           result.framing.slow_motion, result.framing.magnification)});
    // What follows is to be seen beside the first film.
    if (k == 0) {
      options.from = result.framing.from;
      options.to = result.framing.to;
      options.slow_motion = result.framing.slow_motion;
      options.magnification = result.framing.magnification;
      options.shadow = &side.trajectory;
    }
  }
  return films;
}

void write_report(const path& folder, const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages) {
  std::filesystem::create_directories(folder);
  write_whole(folder / "compare.json", comparisons_json(comparisons).dump(2) + "\n");
  if (!pages.empty()) write_whole(folder / "report.html", report_page(pages));
}

}  // namespace rotorub
