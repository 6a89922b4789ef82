#include "compare/own/own_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compare/engine/mujoco_model.h"
#include "compare/own/machine_checks.h"
#include "mjcf/mujoco_version.h"
#include "mjcf/names.h"
#include "mjcf/soft_contact.h"
#include "native_model/model/model.h"
#include "native_model/model/model_checks.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/trajectory/recorder.h"
#include "plugin/make_config.h"
#include "plugin/model/message.h"
#include "plugin/model/options.h"
#include "plugin/own/own_names.h"
#include "plugin/twin/native_twin.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

std::string text_of(const std::filesystem::path& file) {
  try {
    return scene::regular_file_text(file);
  } catch (const std::runtime_error& error) {
    throw scene::SceneError({{file.string(), 0, {}, error.what()}});
  }
}

// Sets the models' texts rotorub_contact to `word`. Their length in the file is fixed, so all texts
// are moved to larger buffers. The returned owner of these buffers must outlive the model.
std::shared_ptr<void> say_contact(mjModel* m, const char* word) {
  struct Texts {
    std::vector<char> data;
    std::vector<int> address, size;
  };
  auto texts = std::make_shared<Texts>();
  texts->data.assign(m->text_data, m->text_data + m->ntextdata);
  texts->address.assign(m->text_adr, m->text_adr + m->ntext);
  texts->size.assign(m->text_size, m->text_size + m->ntext);
  for (const plugin::PairName& pair : plugin::own_pair_names(m)) {
    const std::string name = pair.of(names::kContactText);
    const int id = mj_name2id(m, mjOBJ_TEXT, name.c_str());
    if (id < 0) plugin::refuse(plugin::text_element(name.c_str()), kNoContactText);
    const auto at = static_cast<std::size_t>(id);
    texts->address[at] = static_cast<int>(texts->data.size());
    texts->size[at] = static_cast<int>(std::strlen(word)) + 1;
    texts->data.insert(texts->data.end(), word, word + texts->size[at]);
  }
  m->text_data = texts->data.data();
  m->text_adr = texts->address.data();
  m->text_size = texts->size.data();
  return texts;
}

// Evaluates the sensors of the rub forces in MuJoCo's last stage. The contact model `cone` knows
// the forces only after the velocity stage, in which the other models can fill the sensors.
void ask_late(mjModel* m) {
  for (const plugin::PairName& pair : plugin::own_pair_names(m)) {
    for (const char* name : {names::kNormalForce, names::kFrictionForce, names::kNormalForceScaled,
                             names::kFrictionForceScaled}) {
      const int sensor = mj_name2id(m, mjOBJ_SENSOR, pair.of(name).c_str());
      if (sensor >= 0 && m->sensor_type[sensor] == mjSENS_USER)
        m->sensor_needstage[sensor] = mjSTAGE_ACC;
    }
  }
}

// Sets a pair as in a generated file.
void set_pair(mjModel* m, const plugin::ContactPair& own, scene::ContactModel contact) {
  const ContactParameters& c = own.contact;
  const ContactPair pair = contact_pair(contact, c.clearance, c.friction,
                                        soft_contact(c.restitution, m->opt.timestep), built_for());
  const int at = own.pair;
  m->pair_dim[at] = pair.condim;
  std::fill_n(m->pair_friction + 5 * at, 5, 0.0);
  std::fill_n(m->pair_friction + 5 * at, 2, pair.friction);
  mjtNum* solref = m->pair_solref + mjNREF * at;
  solref[0] = -pair.soft.stiffness;
  solref[1] = -pair.soft.damping;
  mjtNum* solimp = m->pair_solimp + mjNIMP * at;
  solimp[0] = solimp[1] = pair.soft.impedance;
  m->pair_margin[at] = pair.margin;
  m->pair_gap[at] = pair.gap;
}

// For an unknown word or a text without data, MuJoCo's message says neither what to write nor that
// a later release may know the word.
std::string load_advice(const std::string& error) {
  const auto says = [&error](const char* words) { return error.find(words) != error.npos; };
  if (says("'text'") && (says("data") || says("text field"))) {
    return "; add data=\"...\": rigid, coulomb, cone or cone-coulomb for rotorub_contact, and the "
           "name of a geom for rotorub_rotor_geom and rotorub_ring_geom";
  }
  if (says("Schema violation") || says("nrecognized") || says("invalid keyword")) {
    return fmt::format(
        "; this rotorub reads MJCF with MuJoCo {}, which does not know the words of later "
        "releases{}: remove the word, or build rotorub for your release with -DMUJOCO_DIR "
        "(plugin/README.md, "
        "Newer MuJoCo)",
        to_string(built_for()), says("implicitfast") ? " (implicitfast is known since 2.3.3)" : "");
  }
  return {};
}

// Sets MuJoCo's default solref. The plugin refuses a solref whose restitution differs from the
// named values, so these are set to match.
void set_default_solref(mjModel* m, const plugin::Config& config) {
  const auto set = [m](const std::string& name, double value) {
    const int id = mj_name2id(m, mjOBJ_NUMERIC, name.c_str());
    if (id >= 0) m->numeric_data[m->numeric_adr[id]] = value;
  };
  for (const plugin::PairName& pair : plugin::own_pair_names(m)) {
    set(pair.of(names::kOwnRestitution), soft_restitution(DefaultSolref::kDampingRatio));
    set(pair.of(names::kOwnFrictionReference), 0.0);
  }
  for (const plugin::ContactPair& pair : config.pairs) {
    m->pair_solref[mjNREF * pair.pair] = DefaultSolref::kTimeConstant;
    m->pair_solref[mjNREF * pair.pair + 1] = DefaultSolref::kDampingRatio;
  }
}

// Loads the file as it is, except that its load cells are evaluated late, where a linked program
// can correct them (plugin/load_cells.h).
MujocoModel load_machine(const std::filesystem::path& file) {
  MujocoModel m;
  try {
    m = load_mjcf_file(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + load_advice(error.what()));
  }
  const bool cells = std::any_of(m->sensor_type, m->sensor_type + m->nsensor, [](int type) {
    return type == mjSENS_FORCE || type == mjSENS_TORQUE || type == mjSENS_TOUCH;
  });
  if (cells) ask_late(m.get());
  return m;
}

class OwnEngine final : public Engine {
 public:
  OwnEngine(std::shared_ptr<const OwnMachine> machine, scene::ContactModel contact,
            OwnSolref solref)
      : machine_(std::move(machine)), contact_(contact), solref_(solref) {}
  std::string name() const override {
    return std::string("mujoco-") + to_string(contact_) +
           (solref_ == OwnSolref::kDefault ? "-default" : "");
  }

  Trajectory run(const scene::Scene& given, const RunRequest& request) const override {
    if (request.perturbation_ulps != 0) {
      throw std::invalid_argument("a machine of your own starts only where its file says");
    }
    scene::Scene scene = given;
    scene.run.step = request.step.value_or(given.run.step);
    check_steps(scene, scene.run.step);
    MujocoOptions options{request};
    options.window = kWindowSteps * given.run.step;
    return finite(run_mujoco(scene, machine_->setup(contact_, scene.run.step, solref_), options));
  }

 private:
  std::shared_ptr<const OwnMachine> machine_;
  scene::ContactModel contact_;
  OwnSolref solref_;
};

}  // namespace

OwnMachine::OwnMachine(const std::filesystem::path& file, const OwnRun& run) : file_(file) {
  const MujocoMessages messages;
  const MujocoModel m = load_machine(file);
  if (run.step) m->opt.timestep = *run.step;
  if (plugin::scene_text(m.get())) {
    throw std::runtime_error("is a generated file; compare the scene that it was made of");
  }
  if (!plugin::is_ours(m.get())) {
    throw std::runtime_error(
        "names no rotor in a ring; name the geoms of both in <custom>, as in "
        "mjcf/examples/own_model.xml (plugin/README.md)");
  }
  plugin::Refusals refusals;
  plugin::Config config;
  const bool read = refusals.attempt([&] { config = plugin::make_config(m.get()); });
  if (read && config.pairs.empty())
    throw std::runtime_error(
        "has no rotor in a ring, so there is nothing to compare: `compare` needs "
        "rotorub_rotor_geom and rotorub_ring_geom. A corrected pair (rotorub_cone_coulomb_pair) "
        "works in any MuJoCo program, but cannot be compared.");
  refusals.attempt([&] { check_keyframes(m.get()); });
  refusals.attempt([&] { check_contact_texts(m.get()); });
  if (read) {
    for (const char* why :
         {plugin::refused_options(config, m.get()), plugin::refused_integrator(config, m.get())}) {
      refusals.attempt([&] {
        if (why) throw plugin::ConfigError(why);
      });
    }
    refusals.attempt([&] { check_equalities(m.get(), config); });
    refusals.attempt([&] { check_starts(m.get(), config); });
  }
  refusals.raise();
  contact_ = config.contact_model();
  if (!run.control.empty()) {
    controller_ = controller_of(run.control, m->opt.timestep);
    actuators_ = ring_actuators(m.get(), config);
  }
  plugin::NativeTwin made = twin(m.get(), config);
  scene_ = std::move(made.scene);
  limits_ = std::move(made.limits);
  add_drawn_clearances(m.get(), config, limits_);
  scene_.name = file.stem().string();
  scene_.text = text_of(file);
  scene_.run.end = run.end;
  prepare(scene_);  // reports errors of the native model, and of a controller's law, here
}

plugin::NativeTwin OwnMachine::twin(const mjModel* m, const plugin::Config& config) const {
  const MujocoData start = make_start(m);
  for (const int control : actuators_.control) {
    if (control >= 0) start->ctrl[control] = 0.0;
  }
  plugin::NativeTwin made = plugin::make_native_twin(m, config, start.get());
  if (controller_) {
    made.scene.folder = file_.parent_path().string();
    made.scene.first().controller = controller_;
    const double limit = actuators_.force_limit;
    made.scene.first().actuator.emplace().force_limit = limit;
    if (std::isfinite(limit)) {
      made.limits.push_back(fmt::format(
          "ring motors: on both sides the controller is limited to |F_x| + |F_y| <= {:.6g} N, "
          "less than the ctrlranges allow, because native actuators stand at 45 degrees",
          limit * std::numbers::sqrt2));
    }
  }
  return made;
}

MujocoSetup OwnMachine::setup(scene::ContactModel contact, double step, OwnSolref solref) const {
  const MujocoMessages messages;
  MujocoSetup setup;
  setup.m = load_machine(file_);
  mjModel* m = setup.m.get();
  m->opt.timestep = step;
  if (contact != contact_) {
    const plugin::Config own = plugin::make_config(m);
    for (const plugin::ContactPair& pair : own.pairs) set_pair(m, pair, contact);
    if (scene::is_cone(contact)) ask_late(m);
    setup.keeps = say_contact(m, to_string(contact));
  }
  setup.config = std::make_unique<const plugin::Config>(plugin::make_config(m));
  auto made = std::make_shared<plugin::NativeTwin>(twin(m, *setup.config));
  if (solref == OwnSolref::kDefault) {
    set_default_solref(m, *setup.config);
    setup.config = std::make_unique<const plugin::Config>(plugin::make_config(m));
  }
  setup.model = std::make_shared<const Model>(prepare(made->scene));
  setup.read = [made, m](const mjData* d, double* q, double* v) { made->read(m, d, q, v); };
  if (controller_) {
    auto control = std::make_shared<RingControl>(setup.model, setup.read, actuators_);
    setup.control = [control](mjData* d) { return (*control)(d); };
  }
  setup.refusal = step_refusal(*setup.model, step);
  return setup;
}

std::vector<Omission> OwnMachine::omissions(scene::ContactModel contact,
                                            const std::atomic<bool>* interrupt) const {
  return measure_omissions(setup(contact, scene_.run.step), scene_.run.end, interrupt);
}

std::unique_ptr<Engine> own_engine(std::shared_ptr<const OwnMachine> machine,
                                   scene::ContactModel contact, OwnSolref solref) {
  return std::make_unique<OwnEngine>(std::move(machine), contact, solref);
}

}  // namespace rotorub
