// rotorub compare: compares scenes in MuJoCo and in the native model.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>

#include "compare/commands/command.h"
#include "compare/commands/compare_output.h"
#include "compare/commands/measured_options.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/commands/tune_command.h"
#include "compare/own/own_machine.h"
#include "compare/result/result.h"
#include "compare/study/result.h"
#include "native_model/scene/overrides.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct CompareArguments : CommonOptions, MeasuredArguments {
  std::vector<std::string> scenes, with;
  std::string mode = "lockstep", tolerance = "1%", contact, folder = "runs/compare", format = "csv";
  int twins = kDefaultTwins, jobs = 0;
  bool no_video = false, all_films = false, modes_ladder = true, tune = false;
};

// Shares of the films in the total time, for the progress bar.
constexpr double kFilmShare = 0.15;  // one film per scene
constexpr double kEveryFilmShare = 0.5;

double film_share(const CompareArguments& options) {
  if (options.no_video) return 0.0;
  return options.all_films ? kEveryFilmShare : kFilmShare;
}

constexpr std::string_view kPluginLead = "rotorub: ";  // prefix of the plugin's error messages

// A scene, or the twin of a user's own machine.
struct Subject {
  scene::Scene scene;
  std::shared_ptr<const OwnMachine> own;
};

// The message with the file in the place of the plugin's prefix, in every line.
std::string with_file(const std::string& file, const std::string& reason) {
  std::istringstream lines(reason);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kPluginLead)) line.erase(0, kPluginLead.size());
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", file, line);
  }
  return text;
}

Subject read_subject(const std::string& file, const CompareArguments& options) {
  if (std::filesystem::path(file).extension() != ".xml")
    return {read_scene(file, options), nullptr};
  const OwnRun run = own_run(options);
  scene::file_text(file);  // reports a file that cannot be read, as for a scene
  try {
    const auto own = std::make_shared<const OwnMachine>(file, run);
    return {own->scene(), own};
  } catch (const scene::SceneError& error) {
    std::vector<scene::Diagnostic> wrong = error.diagnostics();
    for (scene::Diagnostic& d : wrong) {
      const bool law = d.key.starts_with("controller");
      d.file = !law ? file : options.controller.empty() ? scene::kOverrideFile : "--controller";
      if (!law) d.key.clear();  // the file has no keys of a scene
    }
    throw scene::SceneError(wrong);
  } catch (const std::runtime_error& error) {
    throw UsageError("{}", with_file(file, error.what()));
  }
}

// Reads all of them, or throws one SceneError with the errors of all scenes.
std::vector<Subject> read_subjects(const CompareArguments& options) {
  std::vector<Subject> subjects;
  read_each(options.scenes,
            [&](const std::string& file) { subjects.push_back(read_subject(file, options)); });
  for (std::size_t a = 0; a < subjects.size(); ++a) {
    for (std::size_t b = a + 1; b < subjects.size(); ++b) {
      if (subjects[a].scene.name == subjects[b].scene.name) {
        throw UsageError(
            "{} and {} have the same name, so their results would overwrite each other; rename one",
            options.scenes[a], options.scenes[b]);
      }
    }
  }
  return subjects;
}

// Refuses --tune where it would have no effect.
void check_tune(const CompareArguments& options, const std::vector<Subject>& subjects) {
  if (!options.tune) return;
  for (std::size_t k = 0; k < subjects.size(); ++k) {
    if (subjects[k].own) {
      throw UsageError(
          "{}: --tune works on scenes (.toml) only. For a machine of your own, compare several "
          "steps: --step 5us, --step 2us",
          options.scenes[k]);
    }
    if (!subjects[k].scene.has_contact()) {
      throw UsageError("{}: --tune needs a [contact], but this scene has none", options.scenes[k]);
    }
  }
}

MeasuredInput one_measured(const CompareArguments& options) {
  if (!options.measured.empty() && options.scenes.size() > 1) {
    throw UsageError("--measured takes a single scene, but {} are given", options.scenes.size());
  }
  return measured_of(options);
}

// The scenes of the page, with or without films. A failed film must not prevent the report.
std::vector<PageScene> pages_of(const CompareArguments& options,
                                const std::vector<SceneComparison>& comparisons,
                                const std::function<void(double)>& progress) {
  std::vector<PageScene> pages;
  for (const SceneComparison& c : comparisons) pages.push_back({&c, {}, "interrupted."});
  if (options.no_video) {
    for (PageScene& page : pages) page.no_films = "switched off by --no-video.";
    return pages;
  }
  auto films = write_films(options.folder, comparisons, options.all_films, interrupted(), progress);
  for (std::size_t k = 0; k < pages.size(); ++k) {
    pages[k].films = std::move(films[k].films);
    if (films[k].failure.empty() || interrupted()) continue;
    pages[k].no_films = films[k].failure;
    print_message(fmt::format("{}: the film could not be made: {}",
                              scene::printable(comparisons[k].scene.name), films[k].failure));
  }
  return pages;
}

// Finds the setting that the page recommends beside the verdicts.
void find_settings(const CompareArguments& options, double tolerance,
                   const std::vector<Subject>& subjects, ProgressBar& bar,
                   std::vector<PageScene>& pages) {
  for (std::size_t k = 0; k < pages.size() && !interrupted(); ++k) {
    const Subject& subject = subjects[k];
    if (subject.own || !subject.scene.has_contact()) continue;
    if (!options.tune) {
      pages[k].setting =
          fmt::format("`{} --tolerance {}` finds the fastest one that can be trusted",
                      command_text("tune", options.scenes[k], options), options.tolerance);
      continue;
    }
    pages[k].setting =
        setting_sentence(tuned(options.scenes[k], subject.scene, options, tolerance, options.twins,
                               "", bar.part(0, 1, subject.scene.name)));
    bar.clear();
    say(options, fmt::format("\n{}: setting to use: {}\n", scene::printable(subject.scene.name),
                             pages[k].setting));
  }
}

// Says which runs failed, and the text of a law that failed in several of them only once.
void say_failures(const SceneComparison& c) {
  std::vector<const Side*> failed;
  std::string laws;
  for (const Side* side : c.sides()) {
    const bool law = side->trajectory.status == Status::kControllerFailed;
    if (law) laws += (laws.empty() ? "" : ", ") + side->label;
    if (law ? laws == side->label : side->trajectory.status != Status::kOk) failed.push_back(side);
  }
  for (const Side* side : failed) {
    const bool law = side->trajectory.status == Status::kControllerFailed;
    say_failure(c.scene, (law ? laws : side->label) + ": ", side->trajectory);
  }
}

int exit_code(const std::vector<SceneComparison>& comparisons) {
  if (interrupted()) throw Interrupted();
  int code = kDone;
  for (const SceneComparison& c : comparisons) {
    const int run = exit_code_of(c.status());
    if (run != kDone) {
      say_failures(c);
      return run;
    }
    if (!c.within()) code = kOutside;
  }
  return code;
}

// Runs and compares the scenes one by one, and writes and prints each. An interrupted comparison is
// saved but not returned.
std::vector<SceneComparison> compare_all(const CompareArguments& options, double tolerance,
                                         const std::vector<Subject>& subjects,
                                         const MeasuredInput& measured, hdf5::ImageOf hdf5,
                                         ProgressBar& bar) {
  std::vector<SceneComparison> comparisons;
  const double work = 1.0 - film_share(options);
  for (std::size_t k = 0; k < subjects.size() && !interrupted(); ++k) {
    const scene::Scene& scene = subjects[k].scene;
    CompareOptions how;
    how.own = subjects[k].own;
    how.mode = compare_mode_of(options.mode);
    how.tolerance = tolerance;
    how.contact = !options.contact.empty() ? scene::contact_model(options.contact).value()
                  : scene.is_compliant()   ? scene::ContactModel::kCoulomb
                                           : kDefaultContact;
    how.twins = options.twins;
    how.jobs = options.jobs;
    how.modes_ladder = options.modes_ladder;
    how.measured = measured.record;
    how.alignment = measured.alignment;
    how.interrupt = &interrupted();
    how.progress = [&](double share, const std::string& what) {
      bar.show(work * (static_cast<double>(k) + share) / static_cast<double>(subjects.size()),
               scene.name + ": " + what);
    };
    SceneComparison c = with_record(measured, [&] { return compare_scene(scene, how); });
    bar.clear();
    write_runs(options.folder, c, hdf5);
    if (c.interrupted) break;
    say(options, (k > 0 ? "\n" : "") + result::text_of(comparison_result(c), palette_of(stdout),
                                                       result::units_of(options.units)));
    comparisons.push_back(std::move(c));
  }
  return comparisons;
}

// Reports errors in --with before hours of runs.
Beside beside_of(const CompareArguments& options) {
  try {
    return read_beside(options.with);
  } catch (const std::runtime_error& error) {
    throw UsageError("--with {}", error.what());
  }
}

int compare(const CompareArguments& options) {
  check_twins(options.twins);
  const double tolerance = tolerance_of(options.tolerance);
  const hdf5::ImageOf hdf5 = hdf5_of(options.format);
  const auto subjects = read_subjects(options);
  check_tune(options, subjects);
  const MeasuredInput measured = one_measured(options);
  const Beside beside = beside_of(options);
  for (const Subject& subject : subjects) {
    if (!subject.own) check_sample_times(subject.scene, options);
  }
  for (const Subject& subject : subjects)
    check_output_folder(options.folder,
                        compare_files(options.folder, subject.scene, subject.own != nullptr));
  ProgressBar bar(options.quiet);

  const auto comparisons = compare_all(options, tolerance, subjects, measured, hdf5, bar);
  auto pages = pages_of(options, comparisons, [&](double share) {
    bar.show(1.0 - film_share(options) * (1.0 - share), "films");
  });
  bar.clear();
  find_settings(options, tolerance, subjects, bar, pages);
  result::Section told{.parts = {comparisons_result(comparisons)}};
  write_report(options.folder, told, pages, beside);
  if (!pages.empty()) {
    told.add(
        {result::line(fmt::format("\nreport: {}/report.html", printable_path(options.folder)))});
  }
  finish(told, options);
  return exit_code(comparisons);
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  auto options = std::make_shared<CompareArguments>();
  CLI::App& app =
      add_command(program, "compare",
                  "Run scenes in MuJoCo and in the native model, and judge how far they differ");
  add_option(app, "SCENE", options->scenes,
             "Scene files (.toml), or machines of your own (.xml): MJCF models that name their rub "
             "(plugin/README.md)")
      .required();
  add_option(app, "--mode", options->mode,
             "How the two sides are coupled: lockstep (each closes its own loop), replay "
             "(native under the commands that MuJoCo used), resync (native restarts from "
             "MuJoCo's state at every onset of contact and predicts it)")
      .one_of({"lockstep", "replay", "resync"})
      .shows_default();
  add_value(app, "--tolerance", options->tolerance, "SHARE",
            "Largest difference that passes, e.g. 1% or 0.01. It applies to averages (mean normal "
            "force, lasting contact, total impulse, friction work, whirl, spin, ring speed, "
            "control force; least gap if nothing touches) and to single moments (largest impact "
            "or impulse, hard impacts, rms gap rate)")
      .shows_default();
  add_option(app, "--contact", options->contact,
             "Contact model whose verdict sets the exit code; all are shown (default: rigid, or "
             "coulomb with a compliant contact)")
      .one_of(scene::contact_words<std::vector<std::string>>());
  add_value(app, "--twins", options->twins, "N",
            "Largest number of twins, further runs whose starts differ by a few units in the last "
            "place. They show how precisely a difference is known, and stop as soon as the verdict "
            "is settled. If the native runs scatter, the contact model that decides gets twins too")
      .shows_default();
  add_flag(app, "--modes-ladder,!--no-modes-ladder", options->modes_ladder,
           "Estimate the error of the bending modes kept, by native runs with up to twice as "
           "many (default: on; geometry form only)");
  add_value(app, "--jobs", options->jobs, "N",
            "Number of threads (default: one for each processor); it does not affect the results")
      .between(1, 4096);
  add_value(app, "-o,--output", options->folder, "DIR", "Folder of the results").shows_default();
  add_value(app, "--with", options->with, "DIR",
            "Also show the results in this folder in the report: what bench, check or sweep wrote "
            "with -o, or a folder of such folders; may be repeated")
      .repeats();
  add_measured_options(app, *options, "to show beside its runs");
  add_format_option(app, options->format);
  add_flag(app, "--tune", options->tune,
           "Also find the fastest setting that can be trusted for each scene (rotorub tune), "
           "and show it beside the verdicts");
  add_flag(app, "--all-films", options->all_films,
           "Make a film of every run (default: one film, of MuJoCo alone beside the native run)")
      .excludes(add_flag(app, "--no-video", options->no_video, "Make no films"));
  add_run_options(app, *options);
  add_controller_option(app, *options);
  add_units_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return compare(*options); }};
}

}  // namespace rotorub
