// A user's own machine: an MJCF with the plugin's names (plugin/own/own_config.h) and its native
// twin (plugin/twin/native_twin.h). It can be compared like a scene.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/engine/mujoco_engine.h"
#include "compare/own/omissions.h"
#include "compare/own/ring_control.h"
#include "native_model/scene/scene.h"
#include "plugin/twin/native_twin.h"

namespace rotorub {

struct OwnRun {
  std::optional<double> step;  // s, > 0; default: the model's <option timestep>
  double end = 1.0;            // s, > 0
  // Overrides "controller.key=value" (scene/overrides.h) of a [controller] on the ring. If empty,
  // ctrl stays as at the start.
  std::vector<std::string> control{};
};

// The solref of an own model's pairs in a run.
enum class OwnSolref {
  // The file's solref if the run has the file's own contact model, otherwise one that suits step
  // and restitution.
  kChosen,
  kDefault  // MuJoCo's default
};

class OwnMachine {
 public:
  // Starts from the keyframe "start" or "test", or from qpos0 without a keyframe. Throws
  // plugin::ConfigError with all reasons if the plugin refuses the model or it has no twin;
  // std::runtime_error with MuJoCo's message if MuJoCo cannot read it, or if no actuators take a
  // controller's commands (ring_control.h); scene::SceneError for a start outside the ring or a
  // wrong controller.
  explicit OwnMachine(const std::filesystem::path& file, const OwnRun& run = {});

  // The twin, named after the file; its text is the file's.
  const scene::Scene& scene() const { return scene_; }
  // Sentences about what the twin leaves out, as far as known before any run.
  const std::vector<std::string>& limits() const { return limits_; }
  // Measures what the twin leaves out, in a run of the machine with this contact model that is as
  // long as the scene's run.
  std::vector<Omission> omissions(scene::ContactModel contact,
                                  const std::atomic<bool>* interrupt = nullptr) const;
  // The contact model that the file asks for.
  scene::ContactModel contact() const { return contact_; }

  // The user's model with a contact model. With its own one, it stays as in the file; with another,
  // the pairs are set as in a generated file (mjcf/soft_contact.h).
  MujocoSetup setup(scene::ContactModel contact, double step,
                    OwnSolref solref = OwnSolref::kChosen) const;

 private:
  // The twin of the model at its start, including the controller if there is one.
  plugin::NativeTwin twin(const mjModel* m, const plugin::Config& config) const;

  std::filesystem::path file_;
  scene::ContactModel contact_ = scene::ContactModel::kRigid;
  std::optional<scene::Controller> controller_;
  RingActuators actuators_;  // commanded by the controller
  scene::Scene scene_;
  std::vector<std::string> limits_;
};

// MuJoCo on the user's model. Its scenes must be the machine's, with any [run] and the machine's
// start.
std::unique_ptr<Engine> own_engine(std::shared_ptr<const OwnMachine> machine,
                                   scene::ContactModel contact,
                                   OwnSolref solref = OwnSolref::kChosen);

}  // namespace rotorub
