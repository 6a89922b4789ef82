// Films and stills of a run, made without a display: MuJoCo renders with Mesa's software OpenGL,
// and ffmpeg encodes the frames.
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

// Checks the combination of options and format, after check_options(options). Throws
// std::invalid_argument with the option, its value and the accepted values.
void check_options(const RenderOptions& options, FilmFormat format);

struct RenderResult {
  Framing framing;      // of the film
  double film_s = 0.0;  // s, length of the film
  double wall_s = 0.0;  // s, elapsed
};

// Writes the film of a trajectory to `file` (.mp4 or .gif), completely or not at all. Equal input
// gives equal frames. Throws as FramePainter does, std::invalid_argument for another extension of
// `file`, and std::runtime_error if ffmpeg is missing or fails.
RenderResult render(const scene::Scene& scene, const Trajectory& trajectory,
                    const RenderOptions& options, const std::filesystem::path& file);

struct PictureResult {
  Framing framing;
  double t = 0.0;  // s, of the run
};

// Writes the picture at one time (s of the run, within the shown part) to `file` (.png). Default
// time: the hardest impact shown, or the middle.
PictureResult render_still(const scene::Scene& scene, const Trajectory& trajectory,
                           std::optional<double> t, const RenderOptions& options,
                           const std::filesystem::path& file);

}  // namespace rotorub::renders
