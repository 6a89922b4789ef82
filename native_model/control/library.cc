#include "native_model/control/library.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "native_model/control/abi/rotorub/controller.h"
#include "native_model/control/control_loop.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRoom = 512;              // bytes of a reason
constexpr std::size_t kLargestState = 1 << 20;  // numbers
constexpr const char* kKey = "controller.library";
constexpr const char* kPath = "ROTORUB_CONTROLLER_PATH";

std::mutex mutex;
std::vector<fs::path> scene_folders, allowed_files;
SceneLibraries scene_libraries = SceneLibraries::kAsked;

std::vector<fs::path> folders_of(const std::string& list) {
  std::vector<fs::path> folders;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(':', at), list.size());
    if (end > at) folders.emplace_back(list.substr(at, end - at));
    at = end + 1;
  }
  return folders;
}

// A path without links and "..", to be compared.
fs::path plain(const fs::path& path) {
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failed);
  return failed ? fs::absolute(path) : whole;
}

bool is_allowed(const fs::path& file, const std::vector<fs::path>& open_folders) {
  if (scene_libraries == SceneLibraries::kAllowed) return true;
  const fs::path path = plain(file);
  const auto same = [&path](const fs::path& other) { return plain(other) == path; };
  if (std::any_of(allowed_files.begin(), allowed_files.end(), same)) return true;
  // In one of the folders, or below it.
  return std::any_of(open_folders.begin(), open_folders.end(), [&path](const fs::path& folder) {
    const fs::path top = plain(folder / "");
    return std::mismatch(top.begin(), top.end(), path.begin(), path.end()).first == top.end() ||
           plain(folder) == path.parent_path();
  });
}

// The first that is there and allowed.
fs::path found_in(const scene::Scene& scene, const std::vector<fs::path>& folders,
                  const fs::path& name, const std::vector<fs::path>& open_folders) {
  std::string looked;
  fs::path refused;
  for (const fs::path& folder : folders) {
    const fs::path path = fs::absolute(folder / name);
    std::error_code status;
    if (!fs::is_regular_file(path, status)) {
      looked += (looked.empty() ? "" : ", ") + path.string();
    } else if (is_allowed(path, open_folders)) {
      return path;
    } else if (refused.empty()) {
      refused = path;
    }
  }
  if (refused.empty()) scene::refuse_at(scene, kKey, "not found: looked for " + looked);
  scene::refuse_at(
      scene, kKey,
      refused.string() +
          " is not opened: a scene must not run code by itself; if you trust this one, say "
          "--allow-library (Python: allow_library=True), or set " +
          kPath + " to its folder");
}

// What the library says, ended by 0 or not.
std::string said(const std::array<char, kRoom>& reason) {
  const std::string text(reason.data(), std::find(reason.begin(), reason.end(), '\0'));
  return text.empty() ? "no reason given" : scene::printable(text, kRoom);
}

// `action` of the library: what it throws is its failure.
template <typename Action>
std::string failure_of(Action action) {
  std::array<char, kRoom> reason{};
  try {
    return action(reason.data()) == 0 ? "" : said(reason);
  } catch (const std::exception& error) {
    return scene::printable(error.what(), kRoom);
  } catch (...) {
    return "it threw what is no std::exception";
  }
}

std::shared_ptr<void> opened(const scene::Scene& scene, const fs::path& path) {
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* why = dlerror();
    scene::refuse_at(scene, kKey,
                     scene::printable(why != nullptr ? why : "cannot be loaded", kRoom));
  }
  return {handle, [](void* h) { dlclose(h); }};
}

// What the library gives, of this ABI and complete.
const rotorub_controller* functions_of(const scene::Scene& scene, const fs::path& path,
                                       void* library) {
  const auto refuse_it = [&](const std::string& why) {
    scene::refuse_at(scene, kKey, path.string() + ": " + why);
  };
  const auto get =
      reinterpret_cast<rotorub_controller_get_function>(dlsym(library, ROTORUB_CONTROLLER_SYMBOL));
  if (get == nullptr) refuse_it("no function " ROTORUB_CONTROLLER_SYMBOL " (rotorub/controller.h)");
  const rotorub_controller* functions = get();
  if (functions == nullptr) refuse_it("gives no controller");
  if (functions->abi != ROTORUB_CONTROLLER_ABI) {
    refuse_it("is of controller ABI " + std::to_string(functions->abi) +
              "; accepted: " + std::to_string(ROTORUB_CONTROLLER_ABI));
  }
  if (functions->create == nullptr || functions->step == nullptr)
    refuse_it("has no create() or no step()");
  if (functions->command > ROTORUB_CURRENT)
    refuse_it("commands neither ROTORUB_FORCE nor ROTORUB_CURRENT");
  return functions;
}

}  // namespace

void set_scene_libraries(SceneLibraries which) {
  const std::lock_guard<std::mutex> lock(mutex);
  scene_libraries = which;
}

void allow_library(const fs::path& file) {
  const std::lock_guard<std::mutex> lock(mutex);
  allowed_files.push_back(file);
}

bool libraries_left_out() {
  const std::lock_guard<std::mutex> lock(mutex);
  return scene_libraries == SceneLibraries::kLeftOut;
}

void look_for_controllers_in(const fs::path& folder) {
  const std::lock_guard<std::mutex> lock(mutex);
  const fs::path path = fs::absolute(folder);
  if (std::find(scene_folders.begin(), scene_folders.end(), path) == scene_folders.end()) {
    scene_folders.push_back(path);
  }
}

fs::path controller_library(const scene::Scene& scene) {
  const std::lock_guard<std::mutex> lock(mutex);
  const fs::path name = scene.first().controller->library;
  const char* path = std::getenv(kPath);
  const std::vector<fs::path> open_folders = folders_of(path == nullptr ? "" : path);
  std::vector<fs::path> folders =
      scene.folder ? std::vector<fs::path>{*scene.folder} : scene_folders;
  folders.insert(folders.end(), open_folders.begin(), open_folders.end());
  if (folders.empty()) {
    scene::refuse_at(scene, kKey,
                     std::string("is not loaded: a model must not load code by itself; set ") +
                         kPath + " to the folder of the libraries that you trust");
  }
  if (!name.is_absolute()) return found_in(scene, folders, name, open_folders);
  // Of an MJCF, whose paths are absolute or none, setting the variable allows them.
  const bool model = !scene.folder && path != nullptr;
  return found_in(scene, {""}, name,
                  model ? std::vector<fs::path>{name.parent_path()} : open_folders);
}

// Delegating: what create() made is destroyed even where the controller is refused after it.
LibraryController::LibraryController(const scene::Scene& scene, const Plant& plant)
    : LibraryController(scene, controller_library(scene)) {
  if (functions_->command == ROTORUB_CURRENT && plant.current_limit <= 0.0) {
    scene::refuse_at(
        scene, kKey,
        name_ +
            " commands currents; accepted with [actuator] kind = \"electromagnet\" or \"table\"");
  }
  create(scene, plant);
  if (functions_->state_size != nullptr) state_size_ = functions_->state_size(self_);
  if (state_size_ > kLargestState) {
    scene::refuse_at(scene, kKey,
                     name_ + ": a state of " + std::to_string(state_size_) +
                         " numbers; accepted: up to " + std::to_string(kLargestState));
  }
}

LibraryController::LibraryController(const scene::Scene& scene, const fs::path& path)
    : library_(opened(scene, path)), functions_(functions_of(scene, path, library_.get())) {
  name_ = functions_->name != nullptr ? scene::printable(functions_->name, 80)
                                      : path.filename().string();
}

void LibraryController::create(const scene::Scene& scene, const Plant& plant) {
  const scene::Controller& c = *scene.first().controller;
  std::vector<rotorub_entry> entries;
  for (const scene::ConfigEntry& e : c.config) {
    entries.push_back({e.key.c_str(), e.text ? e.text->c_str() : nullptr, e.number});
  }
  rotorub_setup setup{};
  setup.abi = ROTORUB_CONTROLLER_ABI;
  setup.measured = Sensors(c.sensors, c.sample_time).measured();
  setup.sample_time = c.sample_time;
  setup.clearance = plant.clearance;
  for (int k = 0; k < 2; ++k) {
    setup.stator_mass[k] = plant.stator_mass[k];
    setup.stator_damping[k] = plant.stator_damping[k];
    setup.stator_stiffness[k] = plant.stator_stiffness[k];
  }
  setup.force_limit = plant.force_limit;
  setup.current_limit = plant.current_limit;
  setup.entries = entries.size();
  setup.config = entries.data();
  const std::string refused =
      failure_of([&](char* reason) { return functions_->create(&setup, &self_, reason, kRoom); });
  if (!refused.empty())
    scene::refuse_at(scene, "controller.config", name_ + " refuses: " + refused);
  created_ = true;
}

LibraryController::~LibraryController() {
  if (created_ && functions_->destroy != nullptr) functions_->destroy(self_);
}

void LibraryController::start(double* state) const {
  if (functions_->start != nullptr) functions_->start(self_, state);
}

bool LibraryController::commands_currents() const { return functions_->command == ROTORUB_CURRENT; }

Eigen::Vector2d LibraryController::command(const Measurement& now, const SwitchOn&,
                                           double* state) const {
  rotorub_measurement m{};
  m.t = now.t;
  m.sample = now.sample;
  for (int k = 0; k < 2; ++k) {
    m.rotor[k] = now.rotor[k];
    m.rotor_velocity[k] = now.rotor_velocity[k];
    m.stator[k] = now.stator[k];
    m.stator_velocity[k] = now.stator_velocity[k];
    m.current[k] = now.current[k];
  }
  m.spin_angle = now.spin_angle;
  m.spin_speed = now.spin_speed;
  double told[2] = {0.0, 0.0};
  const std::string failed = failure_of(
      [&](char* reason) { return functions_->step(self_, &m, state, told, reason, kRoom); });
  if (!failed.empty()) fail(now.t, failed);
  if (!std::isfinite(told[0]) || !std::isfinite(told[1])) {
    fail(now.t, "its command is not finite");
  }
  const bool finite =
      std::all_of(state, state + state_size_, [](double x) { return std::isfinite(x); });
  if (!finite) fail(now.t, "its state is not finite");
  return {told[0], told[1]};
}

void LibraryController::fail(double t, const std::string& reason) const {
  throw ControllerError("controller " + name_ + " at t = " + std::to_string(t) + " s: " + reason);
}

}  // namespace rotorub
