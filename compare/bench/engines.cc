#include "compare/bench/engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "compare/bench/event_engine.h"
#include "compare/peers/peers.h"
#include "native_model/scene/text.h"

namespace rotorub::bench {
namespace {

using Settings = std::vector<Setting>;

// The scene in this variant, or why it cannot be had.
void read(const SceneReader& reader, const std::vector<std::string>& overrides, Setting& setting) {
  try {
    setting.scene = std::make_shared<const scene::Scene>(reader(overrides));
  } catch (const std::exception& error) {
    setting.refusal = error.what();
  }
}

// One setting on all steps of the ladder.
void add_steps(Settings& all, const std::string& engine, const std::string& name,
               const std::shared_ptr<const Engine>& runner, const SceneReader& reader,
               const std::vector<std::string>& overrides, const std::vector<double>& steps) {
  Setting setting{engine, name, {}, runner, nullptr, ""};
  read(reader, overrides, setting);
  for (const double step : steps) {
    setting.step = step;
    all.push_back(setting);
  }
}

BenchEngine fixed_step(scene::Integrator integrator, const std::string& what) {
  const std::shared_ptr<const Engine> runner = native_engine(integrator);
  const std::string name = runner->name();
  return {name, Family::kNative, what, "", [=](const SceneReader& reader, const Ladder& ladder) {
            Settings all;
            add_steps(all, name, "", runner, reader, {}, ladder.steps);
            return all;
          }};
}

BenchEngine event() {
  return {"native-event", Family::kNative,
          "set-valued Poisson/Coulomb law, located events, DOP853 between them", "",
          [](const SceneReader& reader, const Ladder& ladder) {
            Settings all;
            Setting setting{"native-event", "", {}, nullptr, nullptr, ""};
            read(reader, {}, setting);
            for (const double tolerance : ladder.tolerances) {
              setting.setting = fmt::format("tolerance {:g}", tolerance);
              setting.runner = event_engine(event_parameters(tolerance));
              all.push_back(setting);
            }
            return all;
          }};
}

// Soft contacts also at a stiffness that the step does not set: only they have a limit of their own
// that is not the rigid contact.
BenchEngine mujoco(scene::ContactModel contact, const std::string& what) {
  const std::shared_ptr<const Engine> runner = mujoco_engine(contact);
  const std::string name = runner->name();
  return {name, Family::kMujoco, what, "", [=](const SceneReader& reader, const Ladder& ladder) {
            Settings all;
            const auto add = [&](const std::string& setting, const std::string& integrator,
                                 const std::vector<std::string>& further) {
              std::vector<std::string> overrides{"mujoco.integrator=\"" + integrator + "\""};
              overrides.insert(overrides.end(), further.begin(), further.end());
              add_steps(all, name, setting, runner, reader, overrides, ladder.steps);
            };
            add("Euler", "euler", {});
            add("implicit", "implicit", {});
            if (contact != scene::ContactModel::kRigid) {
              add(kFixedStiffnessName, "euler",
                  {fmt::format("mujoco.solref_stiffness={:g}", kFixedStiffness)});
            }
            return all;
          }};
}

BenchEngine peer(const peers::Peer& peer) {
  return {peer.name, Family::kPeer, peer.what, peer.missing,
          [=](const SceneReader& reader, const Ladder& ladder) {
            Settings all;
            for (const peers::PeerVariant& v : peer.variants) {
              add_steps(all, peer.name, v.setting, v.engine, reader, {}, ladder.steps);
            }
            return all;
          }};
}

std::vector<BenchEngine> make_engines() {
  std::vector<BenchEngine> all{
      event(),
      fixed_step(scene::Integrator::kVerlet,
                 "set-valued Poisson/Coulomb law, second-order fixed step through impacts"),
      fixed_step(scene::Integrator::kMidpoint,
                 "set-valued Poisson/Coulomb law, first-order time stepping (Chavez, Ulbrich)"),
      mujoco(scene::ContactModel::kRigid, "the same law solved by the plugin in MuJoCo's step"),
      mujoco(scene::ContactModel::kCoulomb,
             "MuJoCo's soft normal contact, Coulomb friction by the plugin"),
      mujoco(scene::ContactModel::kCone, "MuJoCo's own soft contact with its friction cone"),
      mujoco(scene::ContactModel::kConeCoulomb,
             "the same, its normal reference corrected for sliding")};
  for (const peers::Peer& p : peers::all_peers()) all.push_back(peer(p));
  return all;
}

std::string accepted() {
  std::string names = "native, mujoco, peer";
  for (const BenchEngine& engine : bench_engines()) names += ", " + engine.name;
  return names;
}

}  // namespace

const char* to_string(Family family) {
  switch (family) {
    case Family::kNative:
      return "native";
    case Family::kMujoco:
      return "mujoco";
    case Family::kPeer:
      return "peer";
  }
  return "";
}

const std::vector<BenchEngine>& bench_engines() {
  static const std::vector<BenchEngine> all = make_engines();
  return all;
}

std::vector<BenchEngine> chosen_engines(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream entries(list);
  for (std::string name; std::getline(entries, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    names.emplace_back(scene::current_word(name));
    if (names.back() != name)
      fmt::print(stderr, "note: {}\n", scene::old_word_note("--engines", name));
  }
  std::vector<BenchEngine> chosen;
  std::vector<bool> met(names.size(), false);
  for (const BenchEngine& engine : bench_engines()) {
    bool wanted = names.empty();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool by_name = names[k] == engine.name;
      if (!by_name && names[k] != to_string(engine.family)) continue;
      if (by_name && !engine.missing.empty()) {
        throw std::invalid_argument(
            fmt::format("--engines {}: {} is not here: {}", list, engine.name, engine.missing));
      }
      wanted = met[k] = true;
    }
    if (wanted && engine.missing.empty()) chosen.push_back(engine);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!met[k]) {
      throw std::invalid_argument(
          fmt::format("--engines {}: there is no `{}`; accepted: {}", list, names[k], accepted()));
    }
  }
  return chosen;
}

}  // namespace rotorub::bench
