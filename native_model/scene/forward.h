// Forward declaration of Scene, for headers that only pass it on.
#pragma once

namespace rotorub::scene {
struct Scene;  // scene/scene.h
}  // namespace rotorub::scene
