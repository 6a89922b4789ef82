// The name of the scene, for headers that only hand one on.
#pragma once

namespace rotorub::scene {
struct Scene;  // scene/scene.h
}  // namespace rotorub::scene
