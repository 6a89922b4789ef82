// The engine plugin of own/instances.h, as MuJoCo calls it.
#pragma once

namespace rotorub::plugin {

// Registers the engine plugin in MuJoCo; does nothing if it is registered already.
void register_contact_plugin();

}  // namespace rotorub::plugin
