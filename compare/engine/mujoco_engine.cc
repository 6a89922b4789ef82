#include "compare/engine/mujoco_engine.h"

#include <algorithm>
#include <stdexcept>

#include "compare/engine/chunked_run.h"
#include "compare/engine/engine.h"
#include "compare/engine/mujoco_model.h"
#include "compare/engine/mujoco_record.h"
#include "mjcf/soft_contact.h"
#include "mjcf/writer.h"
#include "native_model/control/library.h"
#include "native_model/model/model_checks.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/trajectory/recorder.h"
#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub {

namespace {

scene::Scene with_options(const scene::Scene& scene, const MujocoOptions& options) {
  if (scene.text.empty()) {
    throw std::invalid_argument("scene " + scene.name +
                                ": MuJoCo's plugin reads the scene's text, and it has none");
  }
  scene::Scene own = scene;
  own.mujoco.contact = options.contact.value_or(scene.mujoco.contact);
  own.run.step = options.step.value_or(scene.run.step);
  return own;
}

bool takes_solref(const scene::Scene& scene, const plugin::Config& config) {
  return config.has_contact() && config.contact_model() != scene::ContactModel::kRigid &&
         !scene.is_compliant();
}

const char* contact_reason(Status status) {
  return status == Status::kNoSolution ? "the contact laws have no solution (Painleve)"
                                       : "the contact laws have several solutions (Painleve)";
}

}  // namespace

Trajectory run_mujoco(const scene::Scene& given, const MujocoOptions& options) {
  const scene::Scene scene = with_options(perturbed(given, options.perturbation_ulps), options);
  const bool lags = scene.first().actuator && scene.first().actuator->coil_lag > 0.0;
  const bool native = scene.mujoco.rotor == scene::MujocoRotor::kModal &&
                      scene.auxiliary.size() == 1 && !scene.mujoco.shadow && !lags;
  if (scene.mujoco.contact == scene::ContactModel::kRigid) {
    refuse_finite_impacts(scene, native ? FiniteImpacts::kUnsampled : FiniteImpacts::kNone);
  }
  check_steps(scene, scene.run.step);
  const MujocoInPlace mujoco;
  MujocoSetup setup;
  if (scene.folder) look_for_controllers_in(*scene.folder);
  setup.m = load_mjcf(mjcf(scene));
  setup.config = std::make_unique<const plugin::Config>(plugin::make_config(setup.m.get()));
  const plugin::Config& config = *setup.config;
  setup.model = {std::shared_ptr<const void>(), &config.model};
  setup.read = [&config](const mjData* d, double* q, double* v) {
    const plugin::Coordinates state(config, d);
    std::copy_n(state.q(), config.qpos_address.size(), q);
    std::copy_n(state.v(), config.qpos_address.size(), v);
  };
  setup.refusal = config.segments ? plugin::segment_step_refusal(*config.segments, scene.run.step)
                                  : step_refusal(config.model, scene.run.step);
  if (setup.refusal.empty()) setup.refusal = sample_refusal(config.model, scene.run.step);
  return run_mujoco(scene, setup, options);
}

Trajectory run_mujoco(const scene::Scene& scene, const MujocoSetup& setup,
                      const MujocoOptions& options) {
  if (options.commands) throw std::invalid_argument("MuJoCo takes no recorded commands");
  const MujocoInPlace mujoco;
  const plugin::Config& config = *setup.config;
  const Model& model = *setup.model;
  const double step = scene.run.step;
  check_run_size(scene, model, std::nullopt,
                 options.output_times ? &*options.output_times : nullptr);

  if (options.solref && takes_solref(scene, config)) {
    const mjtNum* solref = setup.m->pair_solref + mjNREF * config.pairs.front().pair;
    *options.solref = solref_text(solref[0], solref[1]);
  }
  ChunkedRun run(setup, static_cast<bool>(options.watch));
  WatchFeed feed(model, step, options.watch);
  feed.begin(run.start_q(), run.start_v());
  MujocoRecord record(model, config.contact_model() == scene::ContactModel::kRigid, step,
                      options.output_times.value_or(output_times(scene.run)),
                      options.window > 0.0 ? options.window : kWindowSteps * step);
  record.begin(run.start_q(), run.start_v());

  const std::int64_t steps = scene::step_count(scene.run.end, step);
  Status status = Status::kOk;
  std::string message = setup.refusal;
  if (!message.empty()) status = Status::kStepTooLarge;
  std::int64_t k = 0;
  try {
    while (k < steps && status == Status::kOk) {
      const std::size_t good = run.advance(static_cast<std::size_t>(steps - k));
      for (std::size_t i = 0; i < good; ++i, ++k) {
        if (config.takes_native_steps()) {
          record.native_step(k, run.q(i), run.v(i), run.result(i), false);
          feed.native_step(k, run.q(i), run.v(i), run.result(i));
        } else {
          record.step(k, run.q(i), run.v(i), run.result(i));
          feed.step(k, run.q(i), run.v(i), run.result(i));
        }
        if (const auto why = record.lost(run.q(i), run.v(i))) {
          status = Status::kOutOfRange;
          message = *why;
          break;
        }
      }
      if (status != Status::kOk) break;
      if (run.contact_status() != Status::kOk) {
        status = run.contact_status();
        message = run.error().empty() ? contact_reason(status) : run.error();
      } else if (!run.error().empty()) {
        status = Status::kDiverged;
        message = run.error();
      } else if (run.failed()) {
        status = Status::kDiverged;
        const std::vector<std::string> warnings = mujoco.messages.warnings();
        message = warnings.empty() ? "the state is no longer finite" : warnings.back();
      } else if (options.interrupt && options.interrupt->load(std::memory_order_relaxed)) {
        status = Status::kInterrupted;
        message = "interrupted";
      }
      if (options.progress) options.progress(static_cast<double>(k) / static_cast<double>(steps));
    }
    if (status == Status::kOk && config.takes_native_steps()) {
      const StepResult last = run.last_half();
      record.native_step(k, run.q(0), run.v(0), last, true);
    }
  } catch (const MujocoError& error) {
    status = Status::kDiverged;
    message = error.what();
  }

  const bool ended = status == Status::kOk;
  const double reached = static_cast<double>(k) * step;
  if (!ended && status != Status::kStepTooLarge) {
    message += " at t = " + std::to_string(reached) + " s";
  }
  if (ended && config.contact_model() != scene::ContactModel::kRigid) {
    message = unused_by_soft_contacts(scene);
  }
  Trajectory out = record.finish({ended ? scene.run.end : reached, k, status, message});
  out.engine = "mujoco";
  out.integrator = setup.m->opt.integrator == mjINT_IMPLICIT ? "implicit" : "euler";
  out.contact_model = to_string(config.contact_model());
  out.step = step;
  out.wall_s = run.wall();
  return out;
}

}  // namespace rotorub
