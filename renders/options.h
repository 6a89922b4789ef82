// What a caller may choose of a film.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::renders {

struct RenderOptions {
  int width = 960;                  // pixels, even, 320 to 3840
  int height = 540;                 // pixels, even, 180 to 2160
  double frames_per_second = 25.0;  // 1 to 120
  int samples = 4;                  // for smooth edges: 0 (none), 2, 4, 8
  int quality = 25;                 // x264's constant rate factor, 0 (lossless) to 51

  // The part of the run that is shown, s. Default: from shortly before the first contact (or from
  // the start, without one) to the end.
  std::optional<double> from, to;
  // Seconds of film for one second of the run, > 0. Default: what gives a film of `duration`.
  std::optional<double> slow_motion;
  double duration = 16.0;  // s of film, > 0, where slow_motion is not given
  // Of displacements and of the clearance, >= 1, in the cross-section at the contact and in the
  // view of the whole machine. Default: chosen so that the rub and the bent shaft are seen.
  std::optional<double> magnification;
  std::optional<double> machine_magnification;

  std::string title;         // default: the scene's name
  std::string engine_label;  // default: engine, integrator and contact model

  // A second run of the same scene, drawn translucent at the same times; not owned.
  const Trajectory* shadow = nullptr;
  std::string shadow_label;  // default: as engine_label

  // Told the fraction done, [0, 1], after every frame. What it throws ends the film: no file is
  // left.
  std::function<void(double)> progress;
};

}  // namespace rotorub::renders
