#include "compare/run_files/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "compare/base/columns.h"
#include "compare/base/json.h"
#include "compare/run_files/hdf5_file.h"
#include "compare/run_files/summary.h"
#include "native_model/control/library.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/record.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

constexpr const char* kSeries = "series.csv";
constexpr const char* kImpacts = "impacts.csv";
constexpr const char* kEvents = "events.csv";
constexpr const char* kKeyphasor = "keyphasor.csv";
constexpr const char* kScene = "scene.toml";
constexpr const char* kOwnModel = "model.xml";  // of a user's own machine
constexpr const char* kSummary = "summary.json";
constexpr const char* kHdf5 = "run.h5";  // only on request

std::string text_of(const path& file) {
  try {
    return scene::regular_file_text(file);
  } catch (const std::runtime_error& error) {
    throw BrokenRun(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

// Calls row(fields, line number) for every line after the header; returns the header.
template <class Row>
std::vector<std::string> read_csv(const path& file, Row row) {
  const std::string text = text_of(file);
  std::vector<std::string> header;
  std::size_t at = 0;
  for (int number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto fields = fields_of(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (header.empty()) {
      header.assign(fields.begin(), fields.end());
    } else if (fields.size() != header.size()) {
      throw BrokenRun(fmt::format("{}:{}: the line has {} fields, but the header has {}",
                                  file.string(), number, fields.size(), header.size()));
    } else {
      row(fields, number);
    }
  }
  if (header.empty()) throw BrokenRun(file.string() + ": is empty");
  return header;
}

double number_of(std::string_view field, const path& file, int line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    throw BrokenRun(fmt::format("{}:{}: `{}` is not a number", file.string(), line, field));
  }
  return value;
}

double value_of(std::string_view field, const path& file, int line) {
  for (const ContactMode mode : {ContactMode::kFree, ContactMode::kSlide, ContactMode::kStick}) {
    if (field == to_string(mode)) return static_cast<double>(mode);
  }
  return number_of(field, file, line);
}

void read_series(const path& file, Trajectory& trajectory) {
  std::vector<std::vector<double>> columns;
  const auto header = read_csv(file, [&](const auto& fields, int line) {
    columns.resize(fields.size());
    for (std::size_t k = 0; k < fields.size(); ++k) {
      columns[k].push_back(value_of(fields[k], file, line));
    }
  });
  columns.resize(header.size());
  for (std::size_t k = 0; k < header.size(); ++k) {
    trajectory.series.push_back({header[k], "", std::move(columns[k])});
  }
}

void expect_columns(const path& file, int line, std::size_t there, std::size_t expected) {
  if (there == expected) return;
  throw BrokenRun(fmt::format("{}:{}: expected {} columns", file.string(), line, expected));
}

void read_keyphasor(const path& file, Trajectory& trajectory) {
  read_csv(file, [&](const auto& fields, int line) {
    expect_columns(file, line, fields.size(), keyphasor_columns().size());
    const auto value = [&](std::size_t k) { return number_of(fields[k], file, line); };
    trajectory.keyphasor.push_back({value(0), value(1), value(2), value(3)});
  });
}

void read_impacts(const path& file, Trajectory& trajectory) {
  read_csv(file, [&](const auto& fields, int line) {
    expect_columns(file, line, fields.size(), impact_columns(trajectory.contacts > 1).size());
    const auto value = [&](std::size_t k) { return number_of(fields[k], file, line); };
    trajectory.impacts.push_back(
        {value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7)});
    if (trajectory.contacts < 2) return;
    const double contact = value(8);
    if (!(contact >= 1.0 && contact <= static_cast<double>(trajectory.contacts)) ||
        contact != std::floor(contact)) {
      throw BrokenRun(fmt::format("{}:{}: `{}` is not one of the run's {} contacts", file.string(),
                                  line, fields[8], trajectory.contacts));
    }
    trajectory.impacts.back().contact = static_cast<int>(contact) - 1;
  });
}

Status stored_status(const std::string& name) {
  for (const Status status : {Status::kOk, Status::kDiverged, Status::kNoSolution,
                              Status::kAmbiguous, Status::kStepTooLarge, Status::kOutOfRange,
                              Status::kInterrupted, Status::kControllerFailed}) {
    if (name == to_string(status)) return status;
  }
  return Status::kDiverged;
}

// The message of the library without its prefix "[json.exception.parse_error.101] ".
std::string json_reason(const nlohmann::json::exception& error) {
  const std::string said = error.what();
  const std::size_t end = said.find("] ");
  return said.starts_with("[json.") && end != std::string::npos ? said.substr(end + 2) : said;
}

nlohmann::json summary_of(const path& file) {
  try {
    return nlohmann::json::parse(text_of(file));
  } catch (const nlohmann::json::exception& error) {
    throw BrokenRun(
        fmt::format("{}: is not the summary of a run: {}", file.string(), json_reason(error)));
  }
}

// The text of the scene for the folder. Libraries are located relative to the scene, so their
// absolute paths are inserted. The text of a user's own machine, which has no record, names no
// library.
std::string text_to_keep(const scene::Scene& scene) {
  const std::vector<std::string> places = absolute_libraries(scene);
  if (places.empty() || !scene.record) return scene.text;
  return scene::parse_scene(scene.text, scene.name + ".toml", places).text;
}

// The scene has the name of its run, but error messages name the file in the folder.
scene::Scene read_kept_scene(const path& file, const std::string& name) {
  try {
    return scene::parse_scene(text_of(file), name + ".toml");
  } catch (const scene::SceneError& error) {
    auto wrong = error.diagnostics();
    for (scene::Diagnostic& d : wrong) d.file = file.string();
    throw scene::SceneError(std::move(wrong));
  }
}

bool is_own_machine(const scene::Scene& scene) { return scene.rotor.assembled != nullptr; }
const char* scene_file(bool own_machine) { return own_machine ? kOwnModel : kScene; }

// Files of an earlier run that this run does not write could be mistaken for its results.
std::vector<const char*> obsolete_files(const path& folder, bool own_machine) {
  if (!std::filesystem::exists(folder / kSummary)) return {};
  return {scene_file(!own_machine), kRunPage, kLyapunovFile};
}

}  // namespace

std::vector<std::string> run_files(const path& folder, const std::string& below, bool own_machine) {
  std::vector<const char*> names = obsolete_files(folder / below, own_machine);
  names.insert(names.end(), {kSeries, kImpacts, kEvents, kKeyphasor, scene_file(own_machine), kHdf5,
                             kColumnsFile, kSummary});
  std::vector<std::string> files;
  for (const char* name : names) files.push_back((path(below) / name).string());
  return files;
}

void write_run(const path& folder, const scene::Scene& scene, const Trajectory& trajectory,
               const nlohmann::json& summary, hdf5::ImageOf hdf5) {
  std::filesystem::create_directories(folder);
  const bool own_machine = is_own_machine(scene);
  for (const char* file : obsolete_files(folder, own_machine))
    std::filesystem::remove(folder / file);
  for (const char* file : {kSummary, kHdf5}) std::filesystem::remove(folder / file);
  write_series(trajectory, folder / kSeries);
  write_impacts(trajectory, folder / kImpacts);
  write_events(trajectory, folder / kEvents);
  write_keyphasor(trajectory, folder / kKeyphasor);
  const std::string scene_text = text_to_keep(scene);
  write_whole(folder / scene_file(own_machine), scene_text);
  if (hdf5) write_whole(folder / kHdf5, hdf5::run_file(hdf5, scene, scene_text, trajectory));
  write_whole(folder / kColumnsFile, columns_text(run_columns_json(trajectory)));
  write_whole(folder / kSummary, json_text(summary));
}

StoredRun read_run(const path& folder) {
  if (std::filesystem::exists(folder / kOwnModel)) {
    throw BrokenRun(
        folder.string() +
        ": is a run of a machine of your own, which only the report of its comparison shows");
  }
  StoredRun run;
  const nlohmann::json& summary = run.summary = summary_of(folder / kSummary);
  Trajectory& t = run.trajectory;
  try {
    run.scene = read_kept_scene(folder / kScene, summary.at("scene").get<std::string>());
    run.scene.folder = folder.string();
    t.engine = summary.at("engine");
    t.integrator = summary.at("integrator");
    t.contact_model = summary.at("contact_model");
    t.step = summary.at("step");
    t.steps = summary.at("steps");
    t.end = summary.at("end");
    t.status = stored_status(summary.at("status"));
    t.message = summary.at("message");
  } catch (const nlohmann::json::exception& error) {
    throw BrokenRun(fmt::format("{}: is not the summary of a run: {}", (folder / kSummary).string(),
                                json_reason(error)));
  }
  t.contacts = run.scene.auxiliary.size();
  t.statistics.contacts.resize(t.contacts);
  read_series(folder / kSeries, t);
  read_impacts(folder / kImpacts, t);
  // Runs of earlier versions have no such file.
  if (std::filesystem::exists(folder / kKeyphasor)) read_keyphasor(folder / kKeyphasor, t);
  return run;
}

void check_series(const Trajectory& trajectory, const std::string& file) {
  for (const char* name : {"t", "rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x",
                           "stator_y", "stator_vx", "stator_vy", "spin_angle", "spin_speed", "gap",
                           "gap_rate", "normal_force", "friction_force", "mode"}) {
    if (!trajectory.has(name)) throw BrokenRun(fmt::format("{}: has no column `{}`", file, name));
  }
  // The rows follow a header.
  const auto line = [](std::size_t row) { return row + 2; };
  for (const Column& column : trajectory.series) {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      if (std::isfinite(column.values[i])) continue;
      throw BrokenRun(fmt::format("{}:{}: {} = {} is not a number", file, line(i), column.name,
                                  column.values[i]));
    }
  }
  const auto& t = trajectory.column("t");
  const auto back = std::is_sorted_until(t.begin(), t.end());
  if (back == t.end()) return;
  throw BrokenRun(fmt::format("{}:{}: the times do not ascend", file,
                              line(static_cast<std::size_t>(back - t.begin()))));
}

std::optional<StoredRun> read_shadow(const path& folder, const StoredRun& run) {
  const path own = folder / kShadowFolder;
  if (run.trajectory.engine != "mujoco" || !run.scene.mujoco.shadow) return std::nullopt;
  if (!std::filesystem::exists(own / kSummary)) return std::nullopt;
  StoredRun shadow = read_run(own);
  // A run of another scene may have been written over the one that the shadow belongs to.
  if (shadow.scene.text != run.scene.text) return std::nullopt;
  return shadow;
}

}  // namespace rotorub
