// One picture of a run at one time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/framing.h"
#include "renders/machine_view.h"
#include "renders/panel.h"
#include "renders/stage.h"

namespace rotorub::renders {

// Paints pictures. All calls must be on the thread that constructed it. The trajectories must
// outlive it.
class FramePainter {
 public:
  // Throws std::invalid_argument with the option and the accepted values, and std::runtime_error if
  // series and scene do not match or if OpenGL fails.
  FramePainter(const scene::Scene& scene, const Trajectory& trajectory,
               const RenderOptions& options);
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  const Framing& framing() const { return framing_; }
  Picture paint(double t);  // t in s of the run
  // For a single picture: disables the check whether frames are too far apart.
  void alone() { frame_film_time_ = 0.0; }

 private:
  void take_runs(const scene::Scene& scene, const Trajectory& trajectory,
                 const RenderOptions& options);
  // The shown runs including the ghost, or all runs.
  std::vector<const Playback*> playbacks(bool all) const;
  void make_machines(const scene::Scene& scene, const RenderOptions& options);
  void make_panels(const scene::Scene& scene, const Trajectory& trajectory,
                   const RenderOptions& options);
  void make_stage(const RenderOptions& options);
  void write_header(Sheet sheet, double t) const;

  // the shown ones from the left, then those that only share the scales
  std::vector<ShownRun> runs_;
  std::size_t shown_runs_ = 1;
  std::optional<ShownRun> ghost_;  // of the first run
  int width_, height_;
  Framing framing_;
  FilmParts film_;
  Layout layout_;
  std::string title_;
  InstantOptions instant_;
  double frame_film_time_ = 0.0;  // s of film between frames

  std::vector<Panel> panels_;
  std::vector<Mesh> meshes_;
  std::optional<MachineView> machine_view_;
  std::vector<MachineView> further_views_;  // of the contacts after the first
  std::optional<Stage> stage_;              // empty if no panel shows the machine
};

}  // namespace rotorub::renders
