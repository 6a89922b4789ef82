// One picture of a run at one time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/film_clock.h"
#include "renders/image.h"
#include "renders/options.h"

namespace rotorub::renders {

// What the pictures of a film have in common, also written into them.
struct Framing {
  double from = 0.0, to = 0.0;  // s, the part of the run that is shown
  double slow_motion = 1.0;     // seconds of film for one second of the run, mean
  FilmClock clock;              // and where they are more
  double magnification = 1.0;   // of displacements and clearance, cross-section at the contact
  double machine_magnification = 1.0;  // the same, view of the whole machine
  int frames = 1;                      // of the film; the first shows `from`, the last `to`
  double time(int frame) const {
    return frames < 2 ? from : clock.time(static_cast<double>(frame) / (frames - 1));
  }
};

// Takes pictures; all calls on the thread that made it. The trajectories must outlive it.
class FramePainter {
 public:
  // Throws std::invalid_argument naming the option and what is accepted, std::runtime_error where
  // the series and the scene do not belong together or where OpenGL fails.
  FramePainter(const scene::Scene& scene, const Trajectory& trajectory,
               const RenderOptions& options);
  ~FramePainter();
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  const Framing& framing() const;
  Image paint(double t);  // t in s of the run

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rotorub::renders
