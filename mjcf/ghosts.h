// The ghosts of a generated MJCF: bodies that show where the shadow has rotor and ring. The plugin
// moves them; without it they rest at the start. They take no part in the motion.
#pragma once

#include "mjcf/xml.h"
#include "native_model/scene/scene.h"
#include "native_model/system/model.h"

namespace rotorub {

void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model);

}  // namespace rotorub
