// Every key of the schema in a scene in which it matters: every engine honours it or refuses the
// scene. None may run on as if the key did not stand there. The keys and other values for them come
// from the schema, so that a new key is asked for without a word here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/compare/keys/key_scenes.h"
#include "tests/compare/keys/key_values.h"

namespace rotorub::test {
namespace {

// Keys that by their nature change nothing that is compared here, with the reason.
const std::map<std::string, std::string>& without_effect() {
  static const std::string library = "only a controller of one's own is shown it";
  static const std::string cover = "the sections cover the shaft: one alone cannot be changed";
  static const std::map<std::string, std::string> reasons{
      {"run.step", "`event` has none; that every other engine takes it convergence tests show"},
      {"run.integrator", "the test chooses it"},
      {"mujoco.contact", "the test chooses it"},
      {"mujoco.shadow", "runs alongside and acts on nothing"},
      {"mujoco.bearing_currents", "a user's to move; at 0 they do nothing"},
      {"run.output_step", "of what is written"},
      {"run.output_times", "of what is written"},
      {"magnetic_bearing.kind", "each word has required keys of its own: alone it is refused"},
      {"magnetic_control.kind", "each word has required keys of its own: alone it is refused"},
      {"magnetic_control.library", "a file"},
      {"contact.name", "a name"},
      {"controller.library", "a file"},
      {"controller.sensors.rotor", library},
      {"controller.sensors.stator", library},
      {"controller.sensors.spin", library},
      {"controller.sensors.current", library},
      {"controller.sensors.current_resolution", library},
      {"controller.sensors.current_noise", library},
      {"rotor.length", cover},
      {"rotor.section.from", cover},
      {"rotor.section.to", cover}};
  return reasons;
}

// Keys of the impact laws of rigid bodies. MuJoCo's soft contacts have no such laws: their duration
// and their effect on the slip follow from stiffness and damping.
const std::set<std::string>& of_rigid_impacts() {
  static const std::set<std::string> keys{"contact.compression_time", "contact.expansion_time",
                                          "contact.tangential_restitution"};
  return keys;
}

struct NamedEngine {
  std::unique_ptr<Engine> engine;
  bool is_mujoco, is_soft;
};

std::string name_of(const scene::Table& table, const scene::Key& key) {
  return std::string(table.path) + "." + std::string(key.name);
}

std::vector<NamedEngine> all_engines() {
  using scene::Integrator;
  std::vector<NamedEngine> all;
  for (const Integrator i : {Integrator::kEvent, Integrator::kVerlet, Integrator::kEuler})
    all.push_back({native_engine(i), false, false});
  for (const auto& [model, word] : scene::kContactModels)
    all.push_back({mujoco_engine(model), true, model != scene::ContactModel::kRigid});
  return all;
}

// Empty: the scene is refused. The refusal must have a reason.
std::optional<Trajectory> run(const NamedEngine& e, const scene::Scene& scene) {
  try {
    Trajectory t = e.engine->run(scene, {});
    if (t.status == Status::kOk) return t;
    EXPECT_FALSE(t.message.empty()) << e.engine->name();
  } catch (const std::runtime_error& error) {
    EXPECT_STRNE(error.what(), "") << e.engine->name();
  }
  return {};
}

// True if any column differs by more than round-off.
bool differ(const Trajectory& a, const Trajectory& b) {
  constexpr double kRoundOff = 1e-9;
  if (a.rows() != b.rows() || a.series.size() != b.series.size()) return true;
  for (std::size_t c = 0; c < a.series.size(); ++c) {
    const std::vector<double>&x = a.series[c].values, &y = b.series[c].values;
    double size = 0.0, apart = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      size = std::max({size, std::abs(x[k]), std::abs(y[k])});
      apart = std::max(apart, std::abs(x[k] - y[k]));
    }
    if (apart > kRoundOff * size) return true;
  }
  return false;
}

// A scene with its runs by every engine; each is computed when it is first needed.
class Host {
 public:
  Host(const KeyScene& of, const std::vector<NamedEngine>& engines)
      : name_(of.name), engines_(engines), runs_(engines.size()) {
    text_ = scene::parse_scene(of.base, name_, of.overrides).text;
    std::vector<scene::Diagnostic> none;
    tree_ = scene::parse_toml(text_, name_, none).value();
  }
  scene::Scene scene(const std::vector<std::string>& overrides = {}) const {
    return scene::parse_scene(text_, name_ + ".toml", overrides);
  }
  const std::optional<Trajectory>& run_of(std::size_t engine) {
    if (!runs_[engine]) runs_[engine] = run(engines_[engine], scene());
    return *runs_[engine];
  }
  const std::string& name() const { return name_; }

  // The place of a table in the scene, or of a table that one key can begin: "force[1]".
  std::vector<std::string> places(const scene::Table& table) const {
    const std::string path(table.path);
    const scene::TomlNode* contact = tree_.find("contact");
    const bool listed = contact != nullptr && !contact->items.empty();
    std::vector<std::string> all;
    if (listed && (scene::is_part_of_contact(table) || path == "contact")) {
      for (std::size_t k = 0; k < contact->items.size(); ++k)
        all.push_back(scene::list_element("contact", k) + (path == "contact" ? "" : "." + path));
    } else if (const scene::TomlNode* list = at(path); table.list && list != nullptr) {
      for (std::size_t k = 0; k < list->items.size(); ++k)
        all.push_back(scene::list_element(path, k));
    } else if (const scene::Table* above = scene::find_table(table.parent());
               above != nullptr && above->list) {
      const scene::TomlNode* elements = at(table.parent());
      for (std::size_t k = 0; elements != nullptr && k < elements->items.size(); ++k) {
        all.push_back(scene::list_element(std::string(table.parent()), k) + "." +
                      std::string(table.name()));
      }
    } else if (!table.list) {
      all.push_back(path);
    }
    std::erase_if(all, [&](const std::string& place) {
      return at(place) == nullptr &&
             std::any_of(table.keys.begin(), table.keys.end(),
                         [](const scene::Key& key) { return key.required(); });
    });
    return all;
  }

  // The value at a path such as "force[1].amplitude"; null if there is no value.
  const scene::TomlNode* at(std::string_view path) const {
    const scene::TomlNode* node = &tree_;
    while (node != nullptr && !path.empty()) {
      const std::string_view part = path.substr(0, path.find('.'));
      path.remove_prefix(std::min(part.size() + 1, path.size()));
      const std::size_t bracket = part.find('[');
      node = node->find(part.substr(0, bracket));
      if (node == nullptr || bracket == std::string_view::npos) continue;
      const auto index = static_cast<std::size_t>(std::stoi(std::string(part.substr(bracket + 1))));
      node = index < node->items.size() ? &node->items[index] : nullptr;
    }
    return node;
  }

 private:
  std::string name_, text_;
  const std::vector<NamedEngine>& engines_;
  std::vector<std::optional<std::optional<Trajectory>>> runs_;
  scene::TomlNode tree_;
};

// The scene with another value of the key, if that is a scene.
std::optional<scene::Scene> changed(const Host& host, const std::string& override_) {
  try {
    return host.scene({override_});
  } catch (const scene::SceneError&) {
    return {};
  }
}

class EveryKey : public ::testing::TestWithParam<std::string> {
 protected:
  static const std::vector<NamedEngine>& engines() {
    static const std::vector<NamedEngine> all = all_engines();
    return all;
  }
  static std::vector<Host>& hosts() {
    static std::vector<Host> all = [] {
      std::vector<Host> made;
      for (const KeyScene& scene : key_scenes()) made.emplace_back(scene, engines());
      return made;
    }();
    return all;
  }

  // Another value where the key stands, else one where it does not: the first with which one of
  // the engines that decide whether it matters does otherwise; then every engine is asked.
  static void ask(const scene::Table& table, const scene::Key& key) {
    for (const bool given : {true, false}) {
      for (Host& host : hosts()) {
        for (const std::string& place : host.places(table)) {
          const std::string path = place + "." + std::string(key.name);
          if ((host.at(path) != nullptr) == given && asked_of(host, table, key, path)) return;
        }
      }
    }
    ADD_FAILURE() << name_of(table, key)
                  << " matters in no scene: give it a part in tests/support/pair_parts.h or a "
                     "scene in key_scenes.h, or the reason why it changes nothing";
  }
  // False: no value of the key matters in this scene.
  static bool asked_of(Host& host, const scene::Table& table, const scene::Key& key,
                       const std::string& path) {
    const bool of_mujoco = table.path == "mujoco";
    for (const std::string& value : other_values(key, host.at(path))) {
      const auto other = changed(host, path + "=" + value);
      if (!other) continue;
      if (!(of_mujoco ? matters_to_mujoco(host, *other) : matters(host, *other, 0))) continue;
      if (!of_mujoco)
        everyone_honours(host, *other, name_of(table, key),
                         host.name() + ", " + path + " = " + value);
      return true;
    }
    return false;
  }

  // True if the engine runs both, with different results.
  static bool matters(Host& host, const scene::Scene& other, std::size_t engine) {
    const auto& before = host.run_of(engine);
    if (!before) return false;
    const auto after = run(engines()[engine], other);
    return after && differ(*before, *after);
  }
  // A key that only MuJoCo reads may concern one contact model.
  static bool matters_to_mujoco(Host& host, const scene::Scene& other) {
    for (std::size_t e = 0; e < engines().size(); ++e) {
      if (engines()[e].is_mujoco && matters(host, other, e)) return true;
    }
    return false;
  }
  static void everyone_honours(Host& host, const scene::Scene& other, const std::string& key,
                               const std::string& what) {
    for (std::size_t e = 1; e < engines().size(); ++e) {
      const auto& before = host.run_of(e);
      if (!before) continue;
      const auto after = run(engines()[e], other);
      if (engines()[e].is_soft && of_rigid_impacts().contains(key)) {
        EXPECT_TRUE(!after || after->message.find(key) != std::string::npos)
            << what << ": " << engines()[e].engine->name() << " says nothing of it";
        continue;
      }
      EXPECT_TRUE(!after || differ(*before, *after))
          << what << ": " << engines()[e].engine->name() << " runs on as without it";
    }
  }
};

TEST_P(EveryKey, IsHonouredOrRefused) {
  const scene::Table& table = *scene::find_table(GetParam());
  for (const scene::Key& key : table.keys) {
    if (!without_effect().contains(name_of(table, key))) ask(table, key);
  }
}

// [[check]] does not belong to the simulation.
std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const scene::Table& table : scene::tables()) {
    if (table.path != "check" && !table.keys.empty()) names.emplace_back(table.path);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Schema, EveryKey, ::testing::ValuesIn(table_names()),
                         [](const auto& shown) {
                           std::string name = shown.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(KeysWithoutEffect, AreKeysOfTheSchema) {
  for (const auto& [path, reason] : without_effect()) {
    const std::size_t dot = path.rfind('.');
    const scene::Table* table = scene::find_table(path.substr(0, dot));
    EXPECT_TRUE(table != nullptr && table->find(path.substr(dot + 1)) != nullptr) << path;
  }
}

}  // namespace
}  // namespace rotorub::test
