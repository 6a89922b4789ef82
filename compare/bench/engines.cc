#include "compare/bench/engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "compare/peers/peers.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"

namespace rotorub::bench {
namespace {

// Entries in descending order without repetitions. wrong: why a value is refused, or empty.
std::vector<double> parse_list(const char* option, const std::string& list,
                               const scene::Quantity& quantity,
                               const std::function<std::string(double)>& wrong) {
  std::vector<double> values;
  std::istringstream entries(list + ",");  // so that the last entry ends with a comma too
  for (std::string entry; std::getline(entries, entry, ',');) {
    const std::string text(scene::trimmed(entry));
    const auto parsed = scene::parse_quantity(text, quantity);
    const std::string why = parsed.error.empty() ? wrong(parsed.value) : parsed.error;
    if (!why.empty()) {
      throw std::invalid_argument(fmt::format("{} {}: `{}`: {}", option, list, text, why));
    }
    values.push_back(parsed.value);
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

using Variants = std::vector<BenchEngine::Variant>;

BenchEngine fixed_step(scene::Integrator integrator, const std::string& what) {
  const std::shared_ptr<const Engine> runner = native_engine(integrator);
  return {runner->name(), Family::kNative, what, "", {{"", runner, {}}}};
}

// Soft contacts are also run at a stiffness that does not depend on the step. Only then do they
// converge to a limit that differs from the rigid contact.
BenchEngine mujoco(scene::ContactModel contact, const std::string& what) {
  const std::shared_ptr<const Engine> runner = mujoco_engine(contact);
  const std::string euler = "mujoco.integrator=\"euler\"";
  Variants variants{{"Euler", runner, {euler}},
                    {"implicit", runner, {"mujoco.integrator=\"implicit\""}}};
  if (contact != scene::ContactModel::kRigid) {
    variants.push_back({kFixedStiffnessName,
                        runner,
                        {euler, fmt::format("mujoco.solref_stiffness={:g}", kFixedStiffness)}});
  }
  return {runner->name(), Family::kMujoco, what, "", variants};
}

BenchEngine peer(const peers::Peer& peer) {
  Variants variants;
  for (const peers::PeerVariant& v : peer.variants) variants.push_back({v.setting, v.engine, {}});
  return {peer.name, Family::kPeer, peer.what, peer.missing, variants};
}

std::vector<BenchEngine> make_engines() {
  std::vector<BenchEngine> all{
      {"native-event",
       Family::kNative,
       "set-valued Poisson/Coulomb law, located events, DOP853 between them",
       "",
       {{"", nullptr, {}}}},
      fixed_step(scene::Integrator::kVerlet,
                 "set-valued Poisson/Coulomb law, second-order fixed step through impacts"),
      mujoco(scene::ContactModel::kRigid, "the same law solved by the plugin in MuJoCo's step"),
      mujoco(scene::ContactModel::kCoulomb,
             "MuJoCo's soft normal contact, Coulomb friction by the plugin"),
      mujoco(scene::ContactModel::kCone, "MuJoCo's own soft contact with its friction cone"),
      mujoco(scene::ContactModel::kConeCoulomb,
             "the same, with its normal reference corrected for sliding")};
  for (const peers::Peer& p : peers::all_peers()) all.push_back(peer(p));
  return all;
}

std::vector<std::string_view> accepted() {
  std::vector<std::string_view> names{"native", "mujoco", "peer", "event", "verlet"};
  for (const BenchEngine& engine : bench_engines()) names.push_back(engine.name);
  return names;
}

}  // namespace

Ladder default_ladder() {
  return {{2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6},
          {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}};
}

std::vector<double> parse_steps(const std::string& list) {
  return parse_list("--steps", list, scene::kTime, [](double step) -> std::string {
    return step > 0.0 ? "" : "expected a time above 0, for example 10us";
  });
}

std::vector<double> parse_tolerances(const std::string& list) {
  return parse_list("--tolerances", list, scene::kPure, [](double tolerance) -> std::string {
    return tolerance > 0.0 && tolerance < 1.0
               ? ""
               : "expected a number above 0 and below 1, for example 1e-8";
  });
}

EventParameters event_parameters(double tolerance) {
  const EventParameters standard;
  EventParameters p;
  p.tolerance = tolerance;
  p.no_force = std::max(standard.no_force, 100.0 * tolerance);
  return p;
}

const char* to_string(Family family) {
  constexpr const char* kWords[] = {"native", "mujoco", "peer"};
  return kWords[static_cast<int>(family)];
}

std::vector<Setting> BenchEngine::settings(const SceneReader& reader, const Ladder& ladder) const {
  std::vector<Setting> all;
  for (const Variant& variant : variants) {
    Setting one{name, variant.setting, {}, variant.runner, nullptr, ""};
    try {
      one.scene = std::make_shared<const scene::Scene>(reader(variant.overrides));
    } catch (const std::exception& error) {
      one.refusal = error.what();
    }
    for (const double rung : variant.runner ? ladder.steps : ladder.tolerances) {
      if (variant.runner) {
        one.step = rung;
      } else {
        one.setting = fmt::format("tolerance {:g}", rung);
        one.runner = event_engine(event_parameters(rung));
      }
      all.push_back(one);
    }
  }
  return all;
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
    // An integrator's name stands for the native engine with it.
    const bool integrator = std::ranges::any_of(bench_engines(), [&](const BenchEngine& engine) {
      return engine.name == "native-" + names.back();
    });
    if (integrator) names.back().insert(0, "native-");
  }
  std::vector<BenchEngine> chosen;
  std::vector<bool> met(names.size(), false);
  for (const BenchEngine& engine : bench_engines()) {
    bool wanted = names.empty();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool by_name = names[k] == engine.name;
      if (!by_name && names[k] != to_string(engine.family)) continue;
      if (by_name && !engine.missing.empty()) {
        throw std::invalid_argument(fmt::format("--engines {}: {} is not available: {}", list,
                                                engine.name, engine.missing));
      }
      wanted = met[k] = true;
    }
    if (wanted && engine.missing.empty()) chosen.push_back(engine);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!met[k]) {
      throw std::invalid_argument(fmt::format("--engines {}: there is no engine `{}`{}", list,
                                              names[k], scene::suggestion(names[k], accepted())));
    }
  }
  return chosen;
}

}  // namespace rotorub::bench
