// From what a caller asks of a film to what every frame needs: checked, and the defaults filled in.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "native_model/trajectory/trajectory.h"
#include "renders/playback.h"

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

  // The part of the run that is shown, s. Default: from shortly before the first contact (or from
  // the start, without one) to the end.
  std::optional<double> from, to;
  // Seconds of film for one second of the run, > 0, the same throughout. Default: what gives a film
  // of `duration`, more of it around impacts (FilmClock).
  std::optional<double> slow_motion;
  double duration = 12.0;  // s of film, > 0, where slow_motion is not given
  // Of displacements and of the clearance, >= 1, in the cross-section at the contact and in the
  // view of the whole machine. Default: chosen so that the rub and the bent shaft are seen.
  std::optional<double> magnification;
  std::optional<double> machine_magnification;

  std::string title;  // default: the scene's name

  // A second run of the same scene, drawn translucent at the same times; not owned.
  const Trajectory* shadow = nullptr;

  // Painting at the same time, >= 1; 0: as many as there are processors, 4 at most. The frames are
  // the same with any number.
  int threads = 0;

  // Further runs of the same scene, not owned: one shown beside the first, with one camera, clock
  // and scale, and others that are not shown but share the scales.
  const Trajectory* beside = nullptr;
  std::vector<const Trajectory*> scaled_with;

  // Given the fraction done, [0, 1], after every frame. What it throws ends the film: no file is
  // left.
  std::function<void(double)> progress;
};

// The clock of a film: which time of the run each moment of the film shows. Around impacts that are
// in view time stretches by itself, so that they are seen. Seconds of film for a second of the run:
//   slow(t) = base (1 + (kStretch - 1) max_i bump((t - t_i) / half)),
//   bump(u) = (1 - u^2)^2 on (-1, 1)
// around the chosen impacts t_i: the first of all runs, then the hardest that are `half` apart.
// They take about half of the film.
class FilmClock {
 public:
  static constexpr double kStretch = 10.0;
  static constexpr int kMostImpacts = 6;

  FilmClock() = default;
  // The same slow motion throughout, `duration` s of film in all.
  FilmClock(double from, double to, double duration);
  // Stretched around impacts; `strikes`: of all runs that are shown.
  FilmClock(double from, double to, double duration, std::span<const Strike> strikes);

  double time(double share) const;  // s of the run at this share of the film, [0, 1]
  double slow(double t) const;      // seconds of film for a second of the run there
  double slowest() const;           // the largest of them
  double base() const { return base_; }
  const std::vector<double>& impacts() const { return impacts_; }  // s, ascending

 private:
  double stretch(double t) const;
  void fill();

  double from_ = 0.0, to_ = 1.0;
  double base_ = 1.0, half_ = 0.0;
  std::vector<double> impacts_;
  std::vector<double> film_;  // share of the film at equal steps of the run
};

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

// Throws std::invalid_argument naming the option, its value and what is accepted.
void check_options(const RenderOptions& options);

// Window, clock and number of frames for the runs that are shown; the magnifications are left at 1.
// Throws std::invalid_argument where the window does not lie within each run.
Framing make_framing(std::span<const Playback* const> runs, const RenderOptions& options);
inline Framing make_framing(const Playback& run, const RenderOptions& options) {
  const std::array<const Playback*, 1> runs = {&run};
  return make_framing(runs, options);
}

// Time of the hardest impact that is shown, or the middle of what is shown, s.
double hardest_impact(const Playback& playback, const Framing& framing);

// "native paper, rigid contact"
std::string engine_label(const Trajectory& trajectory);

}  // namespace rotorub::renders
