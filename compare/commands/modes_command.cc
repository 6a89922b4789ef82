// rotorub modes: whirl frequencies, critical speeds, stability threshold and mode shapes; the
// lasting rubs of rotor and ring, and their map.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/commands/value_range.h"
#include "compare/modes/page_data.h"
#include "compare/modes/periodic_rubs.h"
#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/modes/rub_branches.h"
#include "compare/modes/rub_branches_text.h"
#include "compare/modes/rub_key_map.h"
#include "compare/modes/rub_map_text.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "compare/sweep/study_reader.h"
#include "native_model/linear/levitation.h"
#include "native_model/linear/rub_map.h"
#include "native_model/model/linear_plant.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/refusal.h"
#include "native_model/scene/overrides.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct ModesArguments : CommonOptions {
  std::string scene, up_to, output;
  std::vector<std::string> speeds;
  bool rub_map = false, feedback_map = false, state_space = false, periodic = false;
  std::string map_feedbacks;
  std::string map_speeds, map_frictions;  // FROM:TO:COUNT; empty if not given
  std::string across, up;                 // KEY=FROM:TO:COUNT; empty if not given
};

// True if the periodic rubs are continued over a key.
bool has_branches(const ModesArguments& options) {
  return options.periodic && !options.across.empty();
}

std::vector<double> given_range(const char* option, const std::string& text,
                                const scene::Quantity& quantity) {
  return text.empty() ? std::vector<double>() : range_values(option, text, quantity);
}

// --up-to; empty if not given.
std::optional<double> range_of(const ModesArguments& options) {
  if (options.up_to.empty()) return std::nullopt;
  const double range = quantity_of("--up-to", options.up_to, scene::kSpin);
  if (!(range > 0.0))
    refuse("--up-to", options.up_to, "a spin speed above 0, for example \"9000 rpm\"");
  return range;
}

// Notes speeds without a unit, which may be meant in another unit.
void note_speeds(const ModesArguments& options) {
  for (const std::string& text : options.speeds) note_unitless_speed("--speed", text);
  note_unitless_speed("--up-to", options.up_to);
  const std::vector<std::string> range = parts_of(options.map_speeds);
  if (range.size() < 2) return;
  note_unitless_speed("--speeds", range[0]);
  note_unitless_speed("--speeds", range[1]);
}

// The page's file: the output itself, or a file in that folder.
std::filesystem::path page_file(const ModesArguments& options) {
  const std::filesystem::path path(options.output);
  if (path.extension() == ".html") return path;
  const char* name = options.rub_map         ? "rub_map.html"
                     : options.feedback_map  ? "feedback_map.html"
                     : has_branches(options) ? "rub_branches.html"
                                             : "modes.html";
  return path / name;
}

// Refuses a name such as modes.json, which would become a folder.
void check_page(const std::filesystem::path& output) {
  for (const char* ending : {".htm", ".json", ".csv", ".pdf", ".png", ".svg", ".toml", ".txt"}) {
    if (output.extension() == ending && !std::filesystem::is_directory(output))
      refuse("-o", scene::printable(output.string()), "a file that ends in .html, or a folder");
  }
}

void say_progress(ProgressBar& bar, double share, const char* what) {
  if (interrupted()) throw Interrupted();
  bar.show(share, what);
}

// Writes the page if there is an output for it, and says where. data: for page_of, besides the
// scene.
std::vector<result::Part> written_page(const ModesArguments& options, const char* kind,
                                       const scene::Scene& scene, const result::Section& shown,
                                       const std::function<nlohmann::json()>& data = {}) {
  if (options.output.empty()) return {};
  nlohmann::json all = data ? data() : nlohmann::json::object();
  all["texts"] = {scene.text};
  write_whole(page_file(options), page_of(kind, scene.name, shown, std::move(all)));
  return {result::line(""), written_to(page_file(options))};
}

// ---------------------------------------------------------------- the map of lasting rubs
// --across and --up: any key that accepts a single number. The default axis if not given.
MapAxis axis_of(const char* option, const std::string& text, MapAxis standard) {
  if (text.empty()) return standard;
  const std::string key = scene::override_key(text);
  if (text.find('=') == std::string::npos) refuse(option, text, "KEY=FROM:TO:COUNT");
  std::string reason;
  const scene::Key* found = sweep::scene_key(key, reason);
  if (reason.empty() && !sweep::takes_number(key, found))
    reason = "`" + key + "` does not take a single number";
  if (!reason.empty()) throw UsageError("{} {}: {}", option, text, reason);
  const scene::Quantity& quantity = found->quantity;
  return {key, quantity.unit == "1" ? "" : std::string(quantity.unit),
          range_values(option, text.substr(text.find('=') + 1), quantity)};
}

// By default around the scene's own speed, with the width of a terminal. speeds, frictions: empty
// if not given.
RubKeyMap rub_map_of(const ModesArguments& options, const scene::Scene& scene,
                     std::vector<double> speeds, std::vector<double> frictions) {
  constexpr int kSpeeds = 60, kFrictions = 20;      // 60 columns and 20 lines fit a terminal
  constexpr double kSlowest = 0.2, kFastest = 2.0;  // shares of the scene's speed
  if (speeds.empty() && options.across.empty()) {
    const double speed = std::abs(scene.rotor.speed);
    if (speed == 0.0)
      throw UsageError(
          "--rub-map: the rotor of this scene does not turn; give the spin speeds with --speeds");
    speeds = even_values(kSlowest * speed, kFastest * speed, kSpeeds);
  }
  if (frictions.empty()) frictions = even_values(0.025, 0.5, kFrictions);
  ProgressBar bar(options.quiet);
  const auto progress = [&](double share) { say_progress(bar, share, "lasting rubs"); };
  if (!options.across.empty() || !options.up.empty()) {
    const MapAxis across = axis_of("--across", options.across, {kSpeedKey, "rad/s", speeds});
    const MapAxis up = axis_of("--up", options.up, {kFrictionKey, "", frictions});
    if (across.key == up.key)
      throw UsageError("--rub-map: " + up.key +
                       " is on both axes; give another key with --across or --up");
    return rub_key_map(scene::Variants(options.scene, overrides_of(options)), across, up, progress);
  }
  return with_place(
      scene, [&] { return rub::rub_map(rub::rub_system(scene), speeds, frictions, progress); });
}

// rotorub modes --periodic --across
int show_branches(const ModesArguments& options) {
  const MapAxis across = axis_of("--across", options.across, {});
  std::optional<MapAxis> up;
  if (!options.up.empty()) up = axis_of("--up", options.up, {});
  if (up && up->key == across.key)
    throw UsageError("--periodic: " + up->key +
                     " is the key of --across and of --up; give two different keys");
  const scene::Scene scene = read_scene(options.scene, options);
  ProgressBar bar(options.quiet || options.json);
  BranchOptions settings;
  settings.interrupt = &interrupted();
  settings.progress = [&](double share) { bar.show(share, "periodic rubs"); };
  const RubBranches all =
      rub_branches(scene::Variants(options.scene, overrides_of(options)), across, up, settings);
  bar.clear();
  if (interrupted()) throw Interrupted();
  result::Section found = rub_branches_result(scene::printable(scene.name), all);
  if (!options.output.empty())
    write_whole(page_file(options).replace_extension(".csv"), rub_branches_csv(all));
  found.add(written_page(options, "branches", scene, found));
  return finish(found, options);
}

// rotorub modes --feedback-map: by default spin speeds from half to one and a half times the
// scene's, and k from 0 to 10 sqrt(mass stiffness) of the ring.
int show_feedback(const ModesArguments& options) {
  constexpr int kSpeeds = 21, kFeedbacks = 81;
  constexpr double kSlowest = 0.5, kFastest = 1.5;  // shares of the scene's speed
  constexpr double kMost = 10.0;                    // of k, relative to sqrt(mass stiffness)
  std::vector<double> speeds = given_range("--speeds", options.map_speeds, scene::kSpin);
  const scene::Scene scene = read_scene(options.scene, options);
  if (speeds.empty()) {
    const double speed = std::abs(scene.rotor.speed);
    if (speed == 0.0)
      throw UsageError(
          "--feedback-map: the rotor of this scene does not turn; give the spin speeds with "
          "--speeds");
    speeds = even_values(kSlowest * speed, kFastest * speed, kSpeeds);
  }
  ProgressBar bar(options.quiet || options.json);
  const rub::FeedbackMap map = with_place(scene, [&] {
    const rub::RubSystem system = rub::rub_system(scene);
    if (!system.ring)
      throw UsageError("--feedback-map: the ring is fixed; give a scene with [stator]");
    const std::vector<double> feedbacks =
        options.map_feedbacks.empty()
            ? even_values(0.0, kMost * std::sqrt(system.ring->mass * system.ring->stiffness),
                          kFeedbacks)
            : range_values("--feedbacks", options.map_feedbacks, scene::kDamping);
    return rub::feedback_map(system, speeds, feedbacks,
                             [&](double share) { say_progress(bar, share, "feedback"); });
  });
  bar.clear();
  result::Section found = feedback_map_result(scene.name, map);
  found.add(written_page(options, "feedback_map", scene, found));
  return finish(found, options);
}

// rotorub modes --state-space: prints JSON regardless of other options. If there are several rings,
// the plant belongs to the first ring that moves; without one, to the magnetic bearings.
int show_state_space(const ModesArguments& options) {
  const scene::Scene scene = read_scene(options.scene, options);
  const Model model = prepare(scene);
  const auto driven = std::ranges::find_if(
      scene.auxiliary, [](const scene::AuxiliaryBearing& at) { return at.stator && at.contact; });
  const auto finished = [](const nlohmann::json& plant) {
    return finish({.parts = {result::Data{"", plant}}}, {.json = true});
  };
  if (driven == scene.auxiliary.end()) {
    const LoopResponse response(model, scene.rotor.speed);
    if (response.ports() > 0) return finished(state_space_json(scene, response.plant()));
    throw UsageError(
        "--state-space needs an input: a ring that moves ([stator] and [contact]), or a magnetic "
        "bearing with [magnetic_bearing.control]");
  }
  const auto bearing = static_cast<std::size_t>(driven - scene.auxiliary.begin());
  const std::string why = beyond_linear_plant(scene, bearing, model);
  if (!why.empty()) throw UsageError("--state-space: " + why);
  return finished(state_space_json(scene, plant_of(model, bearing, scene.rotor.speed)));
}

int modes(const ModesArguments& options) {
  if (!options.map_speeds.empty() && !options.rub_map && !options.feedback_map) {
    throw UsageError(
        "--speeds belongs to --rub-map or --feedback-map; give one of them, or --speed for a "
        "single speed");
  }
  if (!options.up.empty() && !options.rub_map && !has_branches(options))
    throw UsageError("--up belongs to --rub-map, or to --periodic with --across");
  if (!options.across.empty() && !options.rub_map && !options.periodic)
    throw UsageError("--across belongs to --rub-map or --periodic; give one of them");
  if (!options.quiet) note_speeds(options);
  if (has_branches(options)) return show_branches(options);
  if (options.state_space) return show_state_space(options);
  if (options.feedback_map) return show_feedback(options);
  std::vector<double> speeds;
  for (const std::string& text : options.speeds)
    speeds.push_back(quantity_of("--speed", text, scene::kSpin));
  const std::optional<double> range = range_of(options);
  std::vector<double> map_speeds = given_range("--speeds", options.map_speeds, scene::kSpin);
  std::vector<double> frictions = given_range("--frictions", options.map_frictions, scene::kPure);
  const scene::Scene scene = read_scene(options.scene, options);
  RotorAnalysis analysis = analyse_rotor(scene, speeds);
  if (!options.json && !options.rub_map)
    analysis.margin = speed_margin(scene, analysis.critical_speeds);
  if (options.periodic) {
    ShootingOptions shooting;
    shooting.interrupt = &interrupted();
    analysis.periodic_rubs = lasting_rubs_by_shooting(scene, shooting);
    if (interrupted()) throw Interrupted();
  }
  const std::string name = scene::printable(scene.name);
  result::Section found = modes_result(name, analysis);
  if (!options.rub_map) {
    found.add(written_page(options, "modes", scene, found, [&] {
      ProgressBar bar(options.quiet);
      return modes_data(scene, campbell_of(scene, analysis, range, [&](double share) {
                          say_progress(bar, share, "Campbell diagram");
                        }));
    }));
    return finish(found, options);
  }
  const RubKeyMap map = rub_map_of(options, scene, std::move(map_speeds), std::move(frictions));
  // People see the picture alone.
  result::Section picture = rub_map_picture(name, map);
  picture.add(written_page(options, "rub_map", scene, picture, [&]() -> nlohmann::json {
    return {{"rub_map",
             {{"across", axis_json(map.across)},
              {"up", axis_json(map.up)},
              {"columns", rub_columns(map.points)}}}};
  }));
  if (!options.json) return finish(picture, options);
  found.add({result::Data{"rub_map", rub_map_json(map)}});
  return finish(found, options);
}

}  // namespace

Command add_modes_command(CLI::App& program) {
  auto options = std::make_shared<ModesArguments>();
  CLI::App& app = add_command(
      program, "modes",
      "Find whirl frequencies, critical speeds, mode shapes, lasting rubs, and the stability and "
      "sensitivity of magnetic bearings");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  const Option speed =
      add_value(app, "--speed", options->speeds, "SPEED",
                "Spin speed, e.g. \"4000 rpm\"; may be repeated (default: rotor.speed)")
          .repeats();
  const Option page = add_value(
      app, "-o,--output", options->output, "DIR|FILE.html",
      "Write a page with Campbell diagram and mode shapes, or the page of a map: to a file that "
      "ends in .html, or into a folder as modes.html, rub_map.html, feedback_map.html or "
      "rub_branches.html, with the branches as a table beside it (.csv)");
  add_value(app, "--up-to", options->up_to, "SPEED",
            "Highest spin speed of the Campbell diagram (default: chosen from the critical speeds)")
      .needs(page);
  const Option map =
      add_flag(app, "--rub-map", options->rub_map,
               "Map which lasting rubs are stable, over spin speed and friction or any two "
               "keys. The frequency of each load keeps its ratio to the spin speed");
  add_value(
      app, "--speeds", options->map_speeds, "FROM:TO:COUNT",
      "Spin speeds of the map, e.g. 10Hz:100Hz:40 (default: 60 from 0.2 to 2 times rotor.speed)");
  const Option feedback = add_flag(app, "--feedback-map", options->feedback_map,
                                   "Find which cross-coupled feedback of the ring makes the "
                                   "forced rub stable: a rule for k(Omega)");
  add_value(app, "--feedbacks", options->map_feedbacks, "FROM:TO:COUNT",
            "Values of k of the feedback map in N s/m, e.g. 0:4000:81")
      .needs(feedback);
  const Option plant =
      add_flag(app, "--state-space", options->state_space,
               "Print the plant of a controller as JSON: A, B and C of rotor and ring without "
               "contact, from the force on the ring to their positions")
          .excludes(feedback)
          .excludes(map);
  feedback.excludes(map);
  add_flag(app, "--periodic", options->periodic,
           "Also find the periodic rubs to which runs of the scene settle, at rotor.speed, for "
           "any machine: with weight, films, compliant or several contacts")
      .excludes(speed)
      .excludes(map)
      .excludes(feedback)
      .excludes(plant);
  add_value(app, "--frictions", options->map_frictions, "FROM:TO:COUNT",
            "Coefficients of friction of the map (default: 0.025:0.5:20)")
      .needs(map);
  add_value(app, "--across", options->across, "KEY=FROM:TO:COUNT",
            "Key on the horizontal axis of the rub map instead of the spin speed, e.g. "
            "contact.clearance=0.2mm:1mm:40; with --periodic: key over which the periodic rubs are "
            "followed, stable and unstable, from those to which runs at COUNT values settle");
  add_value(app, "--up", options->up, "KEY=FROM:TO:COUNT",
            "Key on the vertical axis of the rub map instead of the friction, e.g. "
            "stator.stiffness=1e4:1e6:20; with --periodic: key with a diagram for each value");
  add_units_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] {
            check_page(options->output);
            if (!options->output.empty()) check_output_file(page_file(*options));
            return modes(*options);
          }};
}

}  // namespace rotorub
