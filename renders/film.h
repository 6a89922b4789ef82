// Films and stills of a run, without a display: MuJoCo's renderer on Mesa's software OpenGL, frames
// to ffmpeg (H.264).
#pragma once

#include <filesystem>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/frame.h"
#include "renders/options.h"

namespace rotorub::renders {

struct RenderResult {
  Framing framing;      // what the film shows
  double film_s = 0.0;  // s, length of the film
  double wall_s = 0.0;  // s, spent
};

// Writes the film of a trajectory to `file` (.mp4): whole or not at all. Equal input gives equal
// frames. Throws as FramePainter does, std::invalid_argument where the file's name does not end in
// .mp4, and std::runtime_error where ffmpeg is missing or fails.
RenderResult render(const scene::Scene& scene, const Trajectory& trajectory,
                    const RenderOptions& options, const std::filesystem::path& file);

// Writes the picture of one time (s of the run) to `file` (.png).
void render_still(const scene::Scene& scene, const Trajectory& trajectory, double t,
                  const RenderOptions& options, const std::filesystem::path& file);

}  // namespace rotorub::renders
