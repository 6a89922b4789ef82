// Films and stills of a run, without a display: MuJoCo's renderer on Mesa's software OpenGL, frames
// to ffmpeg.
#pragma once

#include <filesystem>
#include <optional>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/framing.h"

namespace rotorub::renders {

// H.264, animated GIF, one picture.
enum class FilmFormat { kMp4, kGif, kPng };
const char* extension(FilmFormat format);  // ".mp4"

// What options and format rule out together, beyond check_options(options): throws
// std::invalid_argument naming the option, its value and what is accepted.
void check_options(const RenderOptions& options, FilmFormat format);

struct RenderResult {
  Framing framing;      // what the film shows
  double film_s = 0.0;  // s, length of the film
  double wall_s = 0.0;  // s, spent
};

// Writes the film of a trajectory to `file` (.mp4 or .gif): whole or not at all. Equal input gives
// equal frames. Throws as FramePainter does, std::invalid_argument where the file's name ends
// otherwise, and std::runtime_error where ffmpeg is missing or fails.
RenderResult render(const scene::Scene& scene, const Trajectory& trajectory,
                    const RenderOptions& options, const std::filesystem::path& file);

struct PictureResult {
  Framing framing;
  double t = 0.0;  // s, of the run
};

// Writes the picture of one time (s of the run, within what is shown) to `file` (.png). Without a
// time: the hardest impact shown, or the middle.
PictureResult render_still(const scene::Scene& scene, const Trajectory& trajectory,
                           std::optional<double> t, const RenderOptions& options,
                           const std::filesystem::path& file);

}  // namespace rotorub::renders
