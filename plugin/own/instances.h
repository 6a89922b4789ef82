// The same contacts without names in <custom>, described by instances of an engine plugin (MuJoCo
// 2.3.5 and later):
//   <extension><plugin plugin="rotorub.contact">
//     <instance name="contact_2"><config key="clearance" value="5e-4"/></instance>
//   </plugin></extension>
//   <body name="rotor"><plugin instance="contact_2"/> ...
// A key is a name of own_names.h without rotorub_. The instance's name contains the word "contact"
// in place of the key: left_contact_2 is the contact of left_rotorub_clearance_2. While it loads a
// model, MuJoCo refuses unknown keys and a plugin that is not loaded, and the plugin refuses values
// that do not fit. Before 2.3.5 no model has instances.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <string>
#include <vector>

#include "plugin/own/own_names.h"

namespace rotorub::plugin {

// The name of the engine plugin, and the keys of an instance.
inline constexpr const char* kInstancePlugin = "rotorub.contact";
std::span<const char* const> instance_keys();

bool has_instances(const mjModel* m);

// One <config> of an instance.
struct InstanceWord {
  PairName contact;
  const char* key;      // its name in <custom>
  const char* value;    // in mjModel
  std::string element;  // <instance name="..."><config key="...">
  std::string name() const { return contact.of(key); }
};
// The entries of all instances, in the order of the file. Throws ConfigError if the name of an
// instance does not fit or no body refers to it.
std::vector<InstanceWord> instance_words(const mjModel* m);

// The element of an instance that has this name, or would have it if the instance gave it; empty if
// no instance belongs to that contact.
std::string instance_element(const mjModel* m, const std::string& name);

}  // namespace rotorub::plugin
