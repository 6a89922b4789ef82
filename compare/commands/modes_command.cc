// rotorub modes: whirl frequencies, critical speeds, stability threshold and mode shapes; the
// lasting rubs of rotor and ring, and their map.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/modes/rub_key_map.h"
#include "compare/modes/rub_map_text.h"
#include "compare/report/linear_maps.h"
#include "compare/report/modes_page.h"
#include "compare/result/result.h"
#include "compare/sweep/study_reader.h"
#include "native_model/control/library.h"
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
  bool rub_map = false, feedback_map = false, state_space = false;
  std::string map_feedbacks;
  std::string map_speeds, map_frictions;  // FROM:TO:COUNT; empty if not given
  std::string across, up;                 // KEY=FROM:TO:COUNT; empty if not given
};

// ---------------------------------------------------------------- values as FROM:TO:COUNT
[[noreturn]] void refuse_range(const char* option, const std::string& text,
                               const std::string& why) {
  throw UsageError(fmt::format("{} {}: {}; accepted is FROM:TO:COUNT", option, text, why));
}

int count_of(const char* option, const std::string& all, const std::string& part) {
  int count = 0;
  const auto end = std::from_chars(part.data(), part.data() + part.size(), count);
  if (end.ec != std::errc() || end.ptr != part.data() + part.size() || count < 2 || count > 1000) {
    refuse_range(option, all, "COUNT is a whole number from 2 to 1000");
  }
  return count;
}

// `count` >= 2 evenly spaced values, including both ends.
std::vector<double> even_values(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(k + 1 == count ? to : from + (to - from) * k / (count - 1));
  }
  return values;
}

// SI. 2 to 1,000 ascending values, >= 0.
std::vector<double> range_values(const char* option, const std::string& text,
                                 const scene::Quantity& quantity) {
  const std::size_t first = text.find(':'), last = text.rfind(':');
  if (first == std::string::npos || first == last || text.find(':', first + 1) != last) {
    refuse_range(option, text, "it has three parts");
  }
  const auto part = [&](std::size_t begin, std::size_t end) {
    return quantity_of(option, text.substr(begin, end - begin), quantity);
  };
  const double from = part(0, first), to = part(first + 1, last);
  const int count = count_of(option, text, text.substr(last + 1));
  if (!(from >= 0.0) || !(to > from))
    refuse_range(option, text, "FROM is 0 or more and TO above it");
  return even_values(from, to, count);
}

// --up-to; empty if not given.
std::optional<double> range_of(const ModesArguments& options) {
  if (options.up_to.empty()) return std::nullopt;
  const double range = quantity_of("--up-to", options.up_to, scene::kSpin);
  if (!(range > 0.0)) {
    throw UsageError(
        fmt::format("--up-to {}: accepted is a spin speed above 0, as 9000 rpm", options.up_to));
  }
  return range;
}

// Notes speeds without a unit, which may be meant in another unit.
void note_speeds(const ModesArguments& options) {
  for (const std::string& text : options.speeds) note_unitless_speed("--speed", text);
  note_unitless_speed("--up-to", options.up_to);
  const std::string& range = options.map_speeds;
  const std::size_t first = range.find(':');
  if (first == std::string::npos) return;
  note_unitless_speed("--speeds", range.substr(0, first));
  note_unitless_speed("--speeds", range.substr(first + 1, range.rfind(':') - first - 1));
}

// The page's file: the output itself, or a file in that folder.
std::filesystem::path page_file(const ModesArguments& options) {
  const std::filesystem::path path(options.output);
  if (path.extension() == ".html") return path;
  const char* name = options.rub_map        ? "rub_map.html"
                     : options.feedback_map ? "feedback_map.html"
                                            : "modes.html";
  return path / name;
}

void write_file(const ModesArguments& options, const std::string& page) {
  write_whole(page_file(options), page);
}

void write_page(const ModesArguments& options, const scene::Scene& scene,
                const RotorAnalysis& analysis, std::optional<double> asked_range) {
  ProgressBar bar(options.quiet);
  const Campbell campbell = campbell_of(scene, analysis, asked_range, [&](double share) {
    if (interrupted()) throw Interrupted();
    bar.show(share, "Campbell diagram");
  });
  bar.clear();
  write_file(options, modes_page(scene, campbell));
}

int print_found(result::Section found, const ModesArguments& options) {
  if (!options.output.empty())
    found.add({result::line(fmt::format("\nwritten to {}", printable_path(page_file(options))))});
  result::print(found, {options.json, options.quiet});
  return kDone;
}

// ---------------------------------------------------------------- the map of lasting rubs
struct MapRanges {
  std::vector<double> speeds, frictions;  // empty if not given
};

MapRanges map_ranges(const ModesArguments& options) {
  MapRanges ranges;
  if (!options.map_speeds.empty()) {
    ranges.speeds = range_values("--speeds", options.map_speeds, scene::kSpin);
  }
  if (!options.map_frictions.empty()) {
    ranges.frictions = range_values("--frictions", options.map_frictions, scene::kPure);
  }
  return ranges;
}

void say_progress(ProgressBar& bar, double share, const char* what) {
  if (interrupted()) throw Interrupted();
  bar.show(share, what);
}

// --across and --up: any key that accepts a single number. The default axis if not given.
MapAxis axis_of(const char* option, const std::string& text, MapAxis standard) {
  if (text.empty()) return standard;
  const std::string key = scene::override_key(text);
  if (text.find('=') == std::string::npos)
    throw UsageError(fmt::format("{} {}: accepted is KEY=FROM:TO:COUNT", option, text));
  std::string reason;
  const scene::Key* found = sweep::scene_key(key, reason);
  if (reason.empty() && !sweep::takes_number(key, found))
    reason = "`" + key + "` is not one number";
  if (!reason.empty()) throw UsageError(fmt::format("{} {}: {}", option, text, reason));
  const scene::Quantity& quantity = found->quantity;
  return {key, quantity.unit == "1" ? "" : std::string(quantity.unit),
          range_values(option, text.substr(text.find('=') + 1), quantity)};
}

// By default around the scene's own speed, with the width of a terminal.
RubKeyMap rub_map_of(const ModesArguments& options, const scene::Scene& scene, MapRanges ranges) {
  constexpr int kSpeeds = 60, kFrictions = 20;
  if (ranges.speeds.empty() && options.across.empty()) {
    const double speed = std::abs(scene.rotor.speed);
    if (speed == 0.0) throw UsageError("--rub-map: the scene's rotor is at rest; give --speeds");
    ranges.speeds = even_values(0.2 * speed, 2.0 * speed, kSpeeds);
  }
  if (ranges.frictions.empty()) ranges.frictions = even_values(0.025, 0.5, kFrictions);
  ProgressBar bar(options.quiet);
  const auto progress = [&](double share) { say_progress(bar, share, "lasting rubs"); };
  if (!options.across.empty() || !options.up.empty()) {
    const MapAxis across = axis_of("--across", options.across, {kSpeedKey, "rad/s", ranges.speeds});
    const MapAxis up = axis_of("--up", options.up, {kFrictionKey, "", ranges.frictions});
    if (across.key == up.key) throw UsageError("--rub-map: " + up.key + " is on both axes");
    return rub_key_map(scene::Variants(options.scene, overrides_of(options)), across, up, progress);
  }
  return with_place(scene, [&] {
    return rub::rub_map(rub::rub_system(scene), ranges.speeds, ranges.frictions, progress);
  });
}

// rotorub modes --feedback-map: by default spin speeds from half to one and a half times the
// scene's, and k from 0 to 10 sqrt(mass stiffness) of the ring.
int show_feedback(const ModesArguments& options) {
  MapRanges ranges = map_ranges(options);
  const scene::Scene scene = read_scene(options.scene, options);
  const double speed = std::abs(scene.rotor.speed);
  if (ranges.speeds.empty() && speed == 0.0) {
    throw UsageError("--feedback-map: the scene's rotor is at rest; give --speeds");
  }
  if (ranges.speeds.empty()) ranges.speeds = even_values(0.5 * speed, 1.5 * speed, 21);
  ProgressBar bar(options.quiet || options.json);
  const rub::FeedbackMap map = with_place(scene, [&] {
    const rub::RubSystem system = rub::rub_system(scene);
    if (!system.ring) throw UsageError("--feedback-map: the ring is fixed ([stator] is absent)");
    const std::vector<double> feedbacks =
        options.map_feedbacks.empty()
            ? even_values(0.0, 10.0 * std::sqrt(system.ring->mass * system.ring->stiffness), 81)
            : range_values("--feedbacks", options.map_feedbacks, scene::kDamping);
    return rub::feedback_map(system, ranges.speeds, feedbacks,
                             [&](double share) { say_progress(bar, share, "feedback"); });
  });
  bar.clear();
  if (!options.output.empty()) write_file(options, feedback_map_page(scene, map));
  return print_found(
      {.parts = {result::Data{"feedback_map", feedback_map_json(map)},
                 result::line(feedback_map_table(scene::printable(scene.name), map))}},
      options);
}

// rotorub modes --state-space: prints JSON regardless of other options. Of several rings, the plant
// is that of the first one that moves.
int show_state_space(const ModesArguments& options) {
  const scene::Scene scene = read_scene(options.scene, options);
  const Model model = prepare(scene);
  const auto driven = std::ranges::find_if(
      scene.auxiliary, [](const scene::AuxiliaryBearing& at) { return at.stator && at.contact; });
  if (driven == scene.auxiliary.end()) {
    throw UsageError(
        "--state-space: needs [stator] and [contact]: the force on the ring is the input");
  }
  const auto bearing = static_cast<std::size_t>(driven - scene.auxiliary.begin());
  const std::string why = beyond_linear_plant(scene, bearing, model);
  if (!why.empty()) throw UsageError("--state-space: " + why);
  std::cout << json_text(state_space_json(scene, plant_of(model, bearing, scene.rotor.speed)));
  return kDone;
}

int modes(const ModesArguments& options) {
  if (!options.map_speeds.empty() && !options.rub_map && !options.feedback_map) {
    throw UsageError("--speeds: belongs to --rub-map or --feedback-map");
  }
  if (!options.quiet) note_speeds(options);
  if (options.state_space) return show_state_space(options);
  if (options.feedback_map) return show_feedback(options);
  std::vector<double> speeds;
  for (const std::string& text : options.speeds)
    speeds.push_back(quantity_of("--speed", text, scene::kSpin));
  const std::optional<double> range = range_of(options);
  MapRanges ranges = map_ranges(options);
  const scene::Scene scene = read_scene(options.scene, options);
  const RotorAnalysis analysis = analyse_rotor(scene, speeds);
  std::optional<RubKeyMap> map;
  if (options.rub_map) map = rub_map_of(options, scene, std::move(ranges));
  if (!options.output.empty()) {
    if (map) {
      write_file(options, rub_map_page(scene, *map));
    } else {
      write_page(options, scene, analysis, range);
    }
  }

  const std::string name = scene::printable(scene.name);
  result::Section found = modes_result(name, analysis);
  if (map) {
    // People see the picture alone.
    found.seen = result::kJson;
    found = {.parts = {std::move(found),
                       options.json ? result::Part(result::Data{"rub_map", rub_map_json(*map)})
                                    : result::line(rub_map_picture(name, *map))}};
  }
  return print_found(std::move(found), options);
}

}  // namespace

Command add_modes_command(CLI::App& program) {
  auto options = std::make_shared<ModesArguments>();
  CLI::App& app = add_command(
      program, "modes", "Find whirl frequencies, critical speeds, mode shapes and lasting rubs");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "--speed", options->speeds, "SPEED",
            "Spin speed, e.g. \"4000 rpm\"; may be repeated (default: rotor.speed)")
      .repeats();
  const Option page = add_value(
      app, "-o,--output", options->output, "DIR|FILE.html",
      "Write a page with Campbell diagram and mode shapes, or the page of a map: to a file that "
      "ends in .html, or into a folder as modes.html, rub_map.html or feedback_map.html");
  add_value(app, "--up-to", options->up_to, "SPEED",
            "Highest spin speed of the Campbell diagram (default: chosen to show what matters)")
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
            "Values of k of that map, e.g. 0:4000:81, N s/m")
      .needs(feedback);
  add_flag(app, "--state-space", options->state_space,
           "Print the plant of a controller as JSON: A, B and C of rotor and ring without "
           "contact, from the force on the ring to their positions")
      .excludes(feedback)
      .excludes(map);
  feedback.excludes(map);
  add_value(app, "--frictions", options->map_frictions, "FROM:TO:COUNT",
            "Coefficients of friction of the map (default: 0.025:0.5:20)")
      .needs(map);
  add_value(app, "--across", options->across, "KEY=FROM:TO:COUNT",
            "Key on the horizontal axis of the rub map instead of the spin speed, e.g. "
            "contact.clearance=0.2mm:1mm:40")
      .needs(map);
  add_value(app, "--up", options->up, "KEY=FROM:TO:COUNT",
            "Key on its vertical axis instead of the friction, e.g. stator.stiffness=1e4:1e6:20")
      .needs(map);
  add_common_options(app, *options);
  return {&app, [options] {
            set_scene_libraries(SceneLibraries::kLeftOut);
            if (!options->output.empty()) check_output_file(page_file(*options));
            return modes(*options);
          }};
}

}  // namespace rotorub
