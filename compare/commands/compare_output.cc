#include "compare/commands/compare_output.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/columns.h"
#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/figures/contact_kind.h"
#include "compare/run_files/run_directory.h"
#include "compare/run_files/summary.h"
#include "compare/study/answer.h"
#include "compare/study/result.h"
#include "native_model/trajectory/output.h"
#include "native_model/trajectory/recorder.h"
#include "renders/film.h"

namespace rotorub {

using std::filesystem::path;

namespace {

constexpr const char* kCompareFile = "compare.json";
constexpr const char* kReportFile = "report.html";

path film_of(const scene::Scene& scene, const std::string& run) {
  return path(scene.name) / (run + ".mp4");
}

// The native run under the commands of a contact model, in replay.
std::string native_of(const std::string& contact) { return "native-" + contact; }

}  // namespace

std::vector<std::string> compare_files(const path& folder, const scene::Scene& scene,
                                       bool own_machine) {
  std::vector<std::string> files{kCompareFile, kColumnsFile, kReportFile};
  std::vector<std::string> runs{"native", kShadowFolder};
  for (const ContactKind& kind : kContactKinds) {
    runs.emplace_back(kind.label);
    runs.push_back(native_of(kind.label));
  }
  for (const std::string& run : runs) {
    files.push_back(film_of(scene, run).string());
    for (std::string& file : run_files(folder, (path(scene.name) / run).string(), own_machine))
      files.push_back(std::move(file));
  }
  return files;
}

void write_runs(const path& folder, const SceneComparison& comparison, hdf5::ImageOf hdf5) {
  const auto times = output_times(comparison.scene.run);
  const auto write = [&](const std::string& name, const Side& side) {
    const Trajectory rows = rows_at(side.trajectory, times);
    write_run(folder / comparison.scene.name / name, comparison.scene, rows,
              summary_json(comparison.scene, rows), hdf5);
  };
  for (const Side* side : comparison.sides()) write(side->label, *side);
  if (comparison.interrupted) return;
  if (comparison.shadow.side) write(kShadowFolder, *comparison.shadow.side);
  for (const ComparedModel& m : comparison.models)
    if (m.native) write(native_of(m.run.label), *m.native);
}

void write_report(const path& folder, const result::Section& result,
                  const std::vector<PageScene>& pages, const Beside& beside) {
  write_whole(folder / kCompareFile, json_text(result::json_of(result)));
  write_whole(folder / kColumnsFile, columns_text(compare_columns_json()));
  if (!pages.empty()) write_whole(folder / kReportFile, report_page(pages, beside));
}

namespace {

// Fast to make and short.
renders::RenderOptions film_options() {
  renders::RenderOptions options;
  options.frames_per_second = 25.0;
  options.duration = 6.0;
  return options;
}

// The path from the page's folder, percent-encoded for a URL (RFC 3986).
std::string link_to(const std::string& scene, const std::filesystem::path& file) {
  std::string link;
  for (const char c : scene + "/" + file.filename().string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        std::isalnum(byte) || std::string_view("-._~/").find(c) != std::string_view::npos;
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

// A film to make: the native run, or a run of MuJoCo beside the native one.
struct Job {
  const SceneComparison* comparison = nullptr;
  const ComparedModel* model = nullptr;  // null: native
  std::filesystem::path file;
  const Side& run() const { return model ? model->run : comparison->native; }
};

// The films of one scene: the first completed run in reading order (MuJoCo alone, shown beside the
// native run), or the native run if there is no other. With `every`: all completed runs.
std::vector<Job> jobs_of(const std::filesystem::path& folder, const SceneComparison& c,
                         bool every) {
  std::vector<Job> jobs;
  for (const ComparedModel* m : reading_order(c)) jobs.push_back({&c, m, {}});
  jobs.insert(every ? jobs.begin() : jobs.end(), Job{&c, nullptr, {}});
  std::erase_if(jobs, [](const Job& job) { return job.run().trajectory.status != Status::kOk; });
  if (!every && jobs.size() > 1) jobs.resize(1);
  for (Job& job : jobs) job.file = folder / film_of(c.scene, job.run().label);
  return jobs;
}

std::string caption(const std::string& label, bool beside, const renders::Framing& framing) {
  return fmt::format("{}{}; {}, {}", label, beside ? " beside native" : "", framing.clock.text(),
                     framing.magnification_text(renders::FilmView::kRig));
}

// The scales cover all runs of the scene, so that its films can be compared with each other.
Film make(const Job& job, const std::function<void(double)>& progress) {
  const SceneComparison& c = *job.comparison;
  renders::RenderOptions options = film_options();
  options.progress = progress;
  const bool beside = job.model && c.native.trajectory.status == Status::kOk;
  if (beside) options.beside = &c.reference(*job.model).trajectory;
  for (const Side* side : c.sides()) {
    if (side->trajectory.status == Status::kOk) options.scaled_with.push_back(&side->trajectory);
  }
  const auto made = renders::render(c.scene, job.run().trajectory, options, job.file);
  return Film{link_to(c.scene.name, job.file), caption(job.run().label, beside, made.framing)};
}

}  // namespace

std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons, bool every,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress) {
  std::vector<SceneFilms> all(comparisons.size());
  std::vector<Job> jobs;
  for (const SceneComparison& c : comparisons)
    for (Job& job : jobs_of(folder, c, every)) jobs.push_back(std::move(job));
  for (std::size_t k = 0; k < jobs.size() && !interrupt; ++k) {
    SceneFilms& scene = all[static_cast<std::size_t>(jobs[k].comparison - comparisons.data())];
    try {
      scene.films.push_back(make(jobs[k], [&](double share) {
        if (interrupt) throw Interrupted();
        if (progress) {
          progress((static_cast<double>(k) + share) / static_cast<double>(jobs.size()));
        }
      }));
    } catch (const Interrupted&) {
      break;
    } catch (const std::exception& error) {
      if (scene.failure.empty()) scene.failure = error.what();
    }
  }
  return all;
}

}  // namespace rotorub
