// A machine of the user's own: an MJCF with the plugin's names (plugin/own/own_config.h), and its
// native twin (plugin/twin/native_twin.h), to be compared like a scene.
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
  // Of a [controller] on the ring, "controller.key=value" (scene/overrides.h); empty: ctrl stays as
  // the start has it.
  std::vector<std::string> control{};
};

// Which solref the pairs of an own model have in a run.
enum class OwnSolref {
  kChosen,  // the file's with its own contact model; with another, one that suits step and
            // restitution
  kDefault  // MuJoCo's default
};

class OwnMachine {
 public:
  // Starts from the keyframe "start" or "test", or from qpos0 if there is no keyframe. Throws
  // plugin::ConfigError, with all that is wrong, for what the plugin refuses or has no twin,
  // std::runtime_error with MuJoCo's message for what MuJoCo cannot read, or where no actuators
  // take a controller's commands (ring_control.h), scene::SceneError for a start outside the ring,
  // or at "controller".
  explicit OwnMachine(const std::filesystem::path& file, const OwnRun& run = {});

  // The twin, named after the file; its text is the file's.
  const scene::Scene& scene() const { return scene_; }
  // What the twin is known to leave out before any run, sentences.
  const std::vector<std::string>& limits() const { return limits_; }
  // What it leaves out in a run of the machine with this contact model, as long as the scene's.
  std::vector<Omission> omissions(scene::ContactModel contact,
                                  const std::atomic<bool>* interrupt = nullptr) const;
  // The contact model that the file asks for.
  scene::ContactModel contact() const { return contact_; }

  // The user's model with one of the contact models. Its own: as the file has it. Another: the
  // pairs are set as a generated file's would be (mjcf/soft_contact.h).
  MujocoSetup setup(scene::ContactModel contact, double step,
                    OwnSolref solref = OwnSolref::kChosen) const;

 private:
  // Of the model as it starts; its controller, if it has one, is put in.
  plugin::NativeTwin twin(const mjModel* m, const plugin::Config& config) const;

  std::filesystem::path file_;
  scene::ContactModel contact_ = scene::ContactModel::kRigid;
  std::optional<scene::Controller> controller_;
  RingActuators actuators_;  // that it commands
  scene::Scene scene_;
  std::vector<std::string> limits_;
};

// MuJoCo on the user's model; scenes given to it must be the machine's, but for run and start.
std::unique_ptr<Engine> own_engine(std::shared_ptr<const OwnMachine> machine,
                                   scene::ContactModel contact,
                                   OwnSolref solref = OwnSolref::kChosen);

}  // namespace rotorub
