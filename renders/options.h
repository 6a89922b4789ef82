// What a caller may choose of a film.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::renders {

// What a picture shows beside its curves: the machine with the contact's cross-section; the
// cross-section alone, seen along the axis; the machine near the contact; the gap over the angle.
enum class FilmView { kRig, kAxis, kCloseUp, kUnrolled };
const char* to_string(FilmView view);  // "close-up"
std::optional<FilmView> view_of(const std::string& name);
std::string view_names();  // "rig, axis, close-up or unrolled"

struct RenderOptions {
  FilmView view = FilmView::kRig;
  int width = 1280;                 // pixels, 320 to 3840; of a film even
  int height = 720;                 // pixels, 180 to 2160; of a film even
  double frames_per_second = 60.0;  // 1 to 120; of a GIF 1 to 50
  int samples = 4;                  // for smooth edges: 0 (none), 2, 4, 8
  int quality = 25;                 // x264's constant rate factor, 0 (lossless) to 51

  // The part of the run that is shown, s. Default: from shortly before the first contact (or from
  // the start, without one) to the end.
  std::optional<double> from, to;
  // Seconds of film for one second of the run, > 0, the same throughout. Default: what gives a film
  // of `duration`, more of it around impacts (film_clock.h).
  std::optional<double> slow_motion;
  double duration = 12.0;  // s of film, > 0, where slow_motion is not given
  // Of displacements and of the clearance, >= 1, in the cross-section at the contact and in the
  // view of the whole machine. Default: chosen so that the rub and the bent shaft are seen.
  std::optional<double> magnification;
  std::optional<double> machine_magnification;

  std::string title;         // default: the scene's name
  std::string engine_label;  // default: engine, integrator and contact model

  // A second run of the same scene, drawn translucent at the same times; not owned.
  const Trajectory* shadow = nullptr;
  std::string shadow_label;  // default: as engine_label

  // Painting at the same time, >= 1; 0: as many as there are processors, 4 at most. The frames are
  // the same with any number.
  int threads = 0;

  // Further runs of the same scene, not owned: one shown beside the first, with one camera, clock
  // and scale, and others that are not shown but share the scales.
  const Trajectory* beside = nullptr;
  std::string beside_label;  // default: as engine_label
  std::vector<const Trajectory*> scaled_with;

  // Told the fraction done, [0, 1], after every frame. What it throws ends the film: no file is
  // left.
  std::function<void(double)> progress;
};

}  // namespace rotorub::renders
