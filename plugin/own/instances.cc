#include "plugin/own/instances.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <string_view>

#include "mjcf/names.h"
#include "plugin/model/config.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/own/own_names.h"

namespace rotorub::plugin {

#if mjVERSION_HEADER >= 235
namespace {

namespace names = mjcf_names;

constexpr std::string_view kMark = "contact";  // the name of every instance contains it

// The names in <custom>, and the same as keys.
constexpr auto kNames = [] {
  std::array<const char*, kOwnTexts.size() + kOwnNumbers.size() + 1> all{};
  std::copy(kOwnTexts.begin(), kOwnTexts.end(), all.begin());
  std::copy(kOwnNumbers.begin(), kOwnNumbers.end(), all.begin() + kOwnTexts.size());
  all.back() = names::kOwnConeCoulombPair;
  return all;
}();
constexpr auto kKeys = [] {
  auto keys = kNames;
  for (const char*& key : keys) key += std::string_view(names::kOwnMark).size();
  return keys;
}();

// MuJoCo's number of the plugin, or -1.
int slot() {
  static std::atomic<int> known = -1;
  int at = known.load(std::memory_order_relaxed);
  if (at < 0 && mjp_getPlugin(kInstancePlugin, &at)) known.store(at, std::memory_order_relaxed);
  return at;
}

// Calls action(instance, name) for each instance of the plugin.
template <typename Action>
void for_each_instance(const mjModel* m, Action action) {
  for (int i = 0; i < count(m->nplugin); ++i) {
    if (m->plugin[i] == slot()) action(i, std::string(m->names + m->name_pluginadr[i]));
  }
}

std::string element(const std::string& instance) {
  return message("<instance name=\"{}\">", instance);
}
std::string config(const std::string& instance, const char* key) {
  return element(instance) + message("<config key=\"{}\">", key);
}

// When MuJoCo attaches a model to another, it silently drops an instance that nothing refers to.
void check_reference(const mjModel* m, int i, const std::string& name) {
  if (std::find(m->body_plugin, m->body_plugin + m->nbody, i) != m->body_plugin + m->nbody) return;
  refuse(element(name), message("no body refers to it; put <plugin instance=\"{}\"/> in the body "
                                "of its rotor or of its ring; a body can have one",
                                name));
}

// An instance that is written inside its body has no name; it is the first contact.
PairName contact_of(const std::string& name) {
  if (name.empty()) return {};
  const std::size_t at = name.rfind(kMark);  // a prefix may contain the word too
  if (at == name.npos) {
    refuse(element(name),
           "its name determines the contact and its sensors; call it contact, contact_2, "
           "left_contact or the like");
  }
  return {name.substr(0, at), name.substr(at + kMark.size())};
}

}  // namespace

std::span<const char* const> instance_keys() { return kKeys; }

bool has_instances(const mjModel* m) {
  return m->nplugin > 0 &&
         std::find(m->plugin, m->plugin + m->nplugin, slot()) != m->plugin + m->nplugin;
}

std::vector<InstanceWord> instance_words(const mjModel* m) {
  std::vector<InstanceWord> words;
  for_each_instance(m, [&](int i, const std::string& instance) {
    const PairName contact = contact_of(instance);
    check_reference(m, i, instance);
    for (std::size_t k = 0; k < kKeys.size(); ++k) {
      const char* value = mj_getPluginConfig(m, i, kKeys[k]);
      if (value && *value) words.push_back({contact, kNames[k], value, config(instance, kKeys[k])});
    }
  });
  return words;
}

std::string instance_element(const mjModel* m, const std::string& name) {
  std::string found;
  for_each_instance(m, [&](int, const std::string& instance) {
    const PairName contact = contact_of(instance);
    for (std::size_t k = 0; k < kKeys.size(); ++k) {
      if (contact.of(kNames[k]) == name) found = config(instance, kKeys[k]);
    }
  });
  return found;
}
#else
std::span<const char* const> instance_keys() { return {}; }
bool has_instances(const mjModel*) { return false; }
std::vector<InstanceWord> instance_words(const mjModel*) { return {}; }
std::string instance_element(const mjModel*, const std::string&) { return {}; }
#endif

}  // namespace rotorub::plugin
