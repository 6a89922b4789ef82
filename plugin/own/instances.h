// The same contacts without names in <custom>, by the engine plugins that MuJoCo has from 2.3.5 on:
//   <extension><plugin plugin="rotorub.contact">
//     <instance name="contact_2"><config key="clearance" value="5e-4"/></instance>
//   </plugin></extension>
//   <body name="rotor"><plugin instance="contact_2"/> ...
// A key is a name of own_names.h without its rotorub_. The instance's name has the word "contact"
// in the place of the key: left_contact_2 is the contact of left_rotorub_clearance_2. MuJoCo
// refuses a key that it does not know when it loads the model, and a model whose plugin is not
// there; a value that does not fit is refused then too. Before 2.3.5 no model has any.
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

// What a config of an instance says.
struct InstanceWord {
  PairName contact;
  const char* key;      // as in <custom>
  const char* value;    // in mjModel
  std::string element;  // <instance name="..."><config key="...">
  std::string name() const { return contact.of(key); }
};
// In the order of the file. Throws ConfigError for the name of an instance.
std::vector<InstanceWord> instance_words(const mjModel* m);

// Where an instance says this name, or would, if it says other words of its contact; else empty.
std::string instance_element(const mjModel* m, const std::string& name);

}  // namespace rotorub::plugin
