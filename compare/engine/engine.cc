#include "compare/engine/engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "compare/engine/mujoco_engine.h"
#include "native_model/event/parameters.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

namespace {

class NativeEngine final : public Engine {
 public:
  explicit NativeEngine(scene::Integrator integrator, std::optional<EventParameters> event = {})
      : integrator_(integrator), event_(std::move(event)) {}
  std::string name() const override { return std::string("native-") + to_string(integrator_); }
  Trajectory run(const scene::Scene& scene, const RunRequest& request) const override {
    if (request.watch) throw std::invalid_argument("a native run has no step to watch");
    NativeOptions options;
    options.integrator = integrator_;
    options.step = request.step;
    options.output_times = request.output_times;
    options.progress = request.progress;
    options.interrupt = request.interrupt;
    options.commands = request.commands;
    options.event = event_;
    return finite(run_native(perturbed(scene, request.perturbation_ulps), options));
  }

 private:
  scene::Integrator integrator_;
  std::optional<EventParameters> event_;
};

class MujocoEngine final : public Engine {
 public:
  explicit MujocoEngine(scene::ContactModel contact) : contact_(contact) {}
  std::string name() const override { return std::string("mujoco-") + to_string(contact_); }
  Trajectory run(const scene::Scene& scene, const RunRequest& request) const override {
    MujocoOptions options{request};
    options.contact = contact_;
    options.window = kWindowSteps * scene.run.step;
    return finite(run_mujoco(scene, options));
  }

 private:
  scene::ContactModel contact_;
};

constexpr const char* kIntegrators[] = {"event", "verlet", "euler"};  // in the order of the enum

class DefaultConeEngine final : public Engine {
 public:
  std::string name() const override { return "mujoco-cone-default"; }
  Trajectory run(const scene::Scene& given, const RunRequest& request) const override {
    scene::Scene scene = given;
    scene.mujoco.friction_reference = 0.0;
    scene.mujoco.solref_stiffness = DefaultSolref::kStiffness;
    scene.mujoco.solref_damping = DefaultSolref::kDamping;
    Trajectory done = MujocoEngine(scene::ContactModel::kCone).run(scene, request);
    if (request.solref) {
      *request.solref = solref_text(DefaultSolref::kTimeConstant, DefaultSolref::kDampingRatio);
    }
    return done;
  }
};

}  // namespace

Trajectory finite(Trajectory trajectory) {
  if (trajectory.status != Status::kOk) return trajectory;
  const char* what = nullptr;
  const Statistics& s = trajectory.statistics;
  for (const auto& [name, value] : {std::pair("max_penetration", s.max_penetration),
                                    std::pair("impulse_total", s.impulse_total),
                                    std::pair("energy_residual", s.energy_residual()),
                                    std::pair("mean_force", trajectory.mean_force())}) {
    if (!std::isfinite(value)) what = name;
  }
  for (const Column& column : trajectory.series) {
    for (const double value : column.values) {
      if (!std::isfinite(value)) what = column.name.c_str();
    }
  }
  if (what == nullptr) return trajectory;
  trajectory.status = Status::kDiverged;
  trajectory.message = std::string(what) + " is not finite";
  return trajectory;
}

std::unique_ptr<Engine> native_engine(scene::Integrator integrator) {
  return std::make_unique<NativeEngine>(integrator);
}

std::unique_ptr<Engine> event_engine(const EventParameters& parameters) {
  return std::make_unique<NativeEngine>(scene::Integrator::kEvent, parameters);
}

std::unique_ptr<Engine> mujoco_engine(scene::ContactModel contact) {
  return std::make_unique<MujocoEngine>(contact);
}

std::unique_ptr<Engine> default_cone_engine() { return std::make_unique<DefaultConeEngine>(); }

std::string solref_text(double first, double second) {
  return fmt::format("{:.4g} {:.4g}", first, second);
}

const char* to_string(scene::Integrator integrator) {
  return kIntegrators[static_cast<std::size_t>(integrator)];
}

std::optional<scene::Integrator> integrator_named(std::string_view name) {
  const auto found = std::ranges::find(kIntegrators, name);
  if (found == std::end(kIntegrators)) return std::nullopt;
  return static_cast<scene::Integrator>(found - std::begin(kIntegrators));
}

scene::Scene perturbed(const scene::Scene& scene, int ulps) {
  if (ulps == 0) return scene;
  scene::Scene moved = scene;
  // A unit in the last place of a coordinate that is 0 would vanish in the first sum. The unit of
  // the smallest clearance is used instead, because the coordinates reach that size.
  const double size = smallest_clearance(scene).value_or(1e-3);
  const double unit = std::nextafter(size, 2.0 * size) - size;
  if (moved.initial.x.empty()) {
    moved.initial.x.assign(static_cast<std::size_t>(prepare(scene).layout.modes), 0.0);
  }
  moved.initial.x.front() += ulps * unit;
  return moved;
}

}  // namespace rotorub
