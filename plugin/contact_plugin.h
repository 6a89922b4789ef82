// The engine plugin of own/instances.h, as MuJoCo calls it.
#pragma once

namespace rotorub::plugin {

// So that MuJoCo knows the plugin; does nothing where it does already.
void register_contact_plugin();

}  // namespace rotorub::plugin
