// Checks a caller's options for a film and derives what every frame needs, with defaults filled in.
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

// The part of a picture beside its curves: the machine with the contact's cross-section; only the
// cross-section, seen along the axis; the machine near the contact; the gap over the angle.
enum class FilmView { kRig, kAxis, kCloseUp, kUnrolled };
const char* to_string(FilmView view);  // "close-up"
std::optional<FilmView> view_of(const std::string& name);
std::string view_names();  // "rig, axis, close-up or unrolled"

struct RenderOptions {
  FilmView view = FilmView::kRig;
  int width = 1280;                 // pixels, 320 to 3840; must be even for a film
  int height = 720;                 // pixels, 180 to 2160; must be even for a film
  double frames_per_second = 60.0;  // 1 to 120; for a GIF 1 to 50
  int samples = 4;                  // for smooth edges: 0 (none), 2, 4, 8

  // The part of the run that is shown, s. Default: from shortly before the first contact (or from
  // the start, without one) to the end.
  std::optional<double> from, to;
  // Seconds of film per second of the run, > 0, constant. Default: a film of length `duration` that
  // is slower around impacts (FilmClock), and in which the whirl makes at most an eighth of a turn
  // between frames in the decisive part: from shortly before the first contact on, or around the
  // least gap.
  std::optional<double> slow_motion;
  double duration = 12.0;  // s of film, > 0, used without slow_motion
  // Magnification of displacements and clearance, >= 1, in the cross-section at the contact and in
  // the view of the whole machine. Default: chosen so that the rub and the bent shaft are visible.
  std::optional<double> magnification;
  std::optional<double> machine_magnification;

  std::string title;                  // default: the scene's name
  std::string remark, beside_remark;  // after the label of each run: how their scenes differ

  // A second run of the same scene, drawn translucent at the same times. Not owned.
  const Trajectory* shadow = nullptr;

  // Number of threads that paint, >= 1; 0: one per processor, at most 4. The frames do not depend
  // on it.
  int threads = 0;

  // Further runs of the same scene, not owned: one is shown beside the first, with the same camera,
  // clock and scale; the others are not shown but share the scales.
  const Trajectory* beside = nullptr;
  std::vector<const Trajectory*> scaled_with;

  // Called with the completed fraction, [0, 1], after every frame. An exception from it ends the
  // film, and no file is left.
  std::function<void(double)> progress;
};

// A part of the run, s.
struct Span {
  double from = 0.0, to = 1.0;
  double length() const { return to - from; }
  bool has(double t) const { return t >= from && t <= to; }
};

// The clock of a film maps its time to the time of the run. It stretches the time around visible
// impacts, so that they can be seen. Seconds of film per second of the run:
//   slow(t) = base (1 + (kStretch - 1) max_i bump((t - t_i) / half)),
//   bump(u) = (1 - u^2)^2 on (-1, 1)
// around the chosen impacts t_i: the first of all runs, then the hardest that are at least `half`
// apart. They take about half of the film. With a decisive part of the run, this applies within it;
// it takes kDecisive of the film, and the rest of the run has one speed, slow(t) = rest.
class FilmClock {
 public:
  static constexpr double kStretch = 10.0;
  static constexpr int kMostImpacts = 6;
  static constexpr double kDecisive = 2.0 / 3.0;

  FilmClock() = default;
  // Constant slow motion; the film lasts `duration` s.
  FilmClock(const Span& run, double duration);
  // Stretched around impacts; `strikes`: of all shown runs. By default the whole run is decisive.
  FilmClock(const Span& run, double duration, std::span<const Strike> strikes,
            const std::optional<Span>& decisive = {});

  double time(double share) const;  // s of the run at this fraction of the film, [0, 1]
  double slow(double t) const;      // seconds of film per second of the run at t, s of the run
  double slowest() const;           // maximum of slow()
  double base() const { return base_; }
  const std::vector<double>& impacts() const { return impacts_; }  // s, ascending
  // "slowed down 16 times from 98 ms to 220 ms, 160 times at 5 impacts, 7.4 times elsewhere"
  std::string text() const;

 private:
  double stretch(double t) const;
  void fill();

  Span run_, decisive_;
  double base_ = 1.0, half_ = 0.0;
  double rest_ = 1.0;  // slow() in the rest of the run, relative to base_
  std::vector<double> impacts_;
  // The run's time and the fraction of the film at it; empty if the speed is constant.
  struct Knot {
    double t, film;
  };
  std::vector<Knot> knots_;
};

// Properties that all pictures of a film share; they are also written into the pictures.
struct Framing {
  double from = 0.0, to = 0.0;         // s, the shown part of the run
  double slow_motion = 1.0;            // mean seconds of film per second of the run
  FilmClock clock;                     // local slow motion
  double magnification = 1.0;          // of displacements and clearance in the cross-section
  double machine_magnification = 1.0;  // the same in the view of the whole machine
  int frames = 1;                      // of the film; the first shows `from`, the last `to`
  // "displacements magnified 40 times in the cross-section, 100 times in the machine".
  std::string magnification_text(FilmView view) const;
  double time(int frame) const {
    return frames < 2 ? from : clock.time(static_cast<double>(frame) / (frames - 1));
  }
};

// Throws std::invalid_argument with the option, its value and the accepted values.
void check_options(const RenderOptions& options);

// Window, clock and number of frames for the shown runs; the magnifications stay 1. Throws
// std::invalid_argument if the window is not within each run.
Framing make_framing(std::span<const Playback* const> runs, const RenderOptions& options);
inline Framing make_framing(const Playback& run, const RenderOptions& options) {
  const std::array<const Playback*, 1> runs = {&run};
  return make_framing(runs, options);
}

// Time of the hardest shown impact, or the middle of the shown part, s.
double hardest_impact(const Playback& playback, const Framing& framing);

// "native: event, rigid contact", "MuJoCo alone: Euler, cone contact"
std::string engine_label(const Trajectory& trajectory);

}  // namespace rotorub::renders
