// rotorub check: checks scenes on every engine against the rules in their files.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "compare/base/json.h"
#include "compare/check/output.h"
#include "compare/check/scene_check.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/report/beside.h"
#include "compare/result/result.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct CheckArguments : CommonOptions {
  std::vector<std::string> places;
  std::string folder;
};

// The named scene files, and those in the named folders, sorted by name within a folder.
std::vector<std::string> scene_files(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const std::string& place : places) {
    if (!std::filesystem::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      if (entry.path().extension() == ".toml") inside.push_back(entry.path().string());
    }
    if (inside.empty()) throw UsageError(place + ": no scene (.toml) in this folder");
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

struct CheckedScene {
  scene::Scene scene;
  std::vector<scene::Rule> rules;
  std::string refusal;  // the reason why it cannot be read, if its rules expect that
};

// A file that cannot be read as a scene, for the reason in `error`, and whose rules expect that.
std::optional<CheckedScene> refused_scene(const std::string& file, const scene::SceneError& error) {
  CheckedScene one;
  one.scene.name = std::filesystem::path(file).stem().string();
  one.scene.text = scene::file_text(file);
  one.rules = scene::read_rules(one.scene);
  one.refusal = error.what();
  const bool expected = std::any_of(one.rules.begin(), one.rules.end(), [](const scene::Rule& r) {
    return r.expect == scene::Expect::kRefused;
  });
  const auto& wrong = error.diagnostics();
  const bool in_rules = std::any_of(wrong.begin(), wrong.end(), [](const scene::Diagnostic& d) {
    return d.key.starts_with("check");
  });
  if (!expected || in_rules) return std::nullopt;
  return one;
}

// Reports the errors of all scenes before the first runs.
std::vector<CheckedScene> checked_scenes(const CheckArguments& options) {
  std::vector<CheckedScene> all;
  read_each(scene_files(options.places), [&](const std::string& file) {
    try {
      CheckedScene one{read_scene(file, options), {}, ""};
      for (const NamedLibrary& library : libraries_of(one.scene)) library_path(one.scene, library);
      one.rules = check::rules_of(one.scene);
      all.push_back(std::move(one));
    } catch (const scene::SceneError& error) {
      auto refused = refused_scene(file, error);
      if (!refused) throw;
      all.push_back(std::move(*refused));
    }
  });
  return all;
}

int run_check(const CheckArguments& options) {
  check_output_folder(options.folder, {kCheckFile});
  const std::vector<CheckedScene> scenes = checked_scenes(options);
  ProgressBar bar(options.quiet);
  std::vector<check::Case> cases;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const CheckedScene& one = scenes[k];
    std::vector<check::Case> own =
        one.refusal.empty()
            ? check::check_scene(one.scene, one.rules, bar.part(k, scenes.size(), one.scene.name),
                                 &interrupted())
            : check::refused_cases(one.scene, one.rules, one.refusal);
    cases.insert(cases.end(), own.begin(), own.end());
    if (interrupted()) throw Interrupted();
  }
  bar.clear();
  const result::Section result = check::result_of(cases);
  if (!options.folder.empty()) {
    write_whole(std::filesystem::path(options.folder) / kCheckFile, json_text(json_of(result)));
  }
  return finish(result, options, check::holds(cases) ? kDone : kOutside);
}

}  // namespace

Command add_check_command(CLI::App& program) {
  auto options = std::make_shared<CheckArguments>();
  CLI::App& app =
      add_command(program, "check",
                  "Run scenes on every engine and check the rules in their files ([[check]])");
  add_option(app, "SCENE", options->places, "Scene files (.toml), or folders of them")
      .required()
      .type("SCENE|DIR");
  add_value(app, "-o,--output", options->folder, "DIR",
            "Write check.json, as --json prints it, to this folder, for `compare --with`");
  add_allow_library_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run_check(*options); }};
}

}  // namespace rotorub
