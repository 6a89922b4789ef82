// One picture of a run at one time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/framing.h"
#include "renders/sheet.h"

namespace rotorub::renders {

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
  Picture paint(double t);  // t in s of the run

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rotorub::renders
