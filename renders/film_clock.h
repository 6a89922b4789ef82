// The clock of a film: which time of the run each moment of the film shows. Around impacts that are
// in view time stretches by itself, so that they are seen.
#pragma once

#include <span>
#include <vector>

#include "renders/playback.h"

namespace rotorub::renders {

// Seconds of film for a second of the run:
//   slow(t) = base (1 + (kStretch - 1) max_i bump((t - t_i) / half)), bump(u) = (1 - u^2)^2 on (-1,
//   1)
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

}  // namespace rotorub::renders
