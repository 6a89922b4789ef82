// A trajectory read as a film is: the pose of the machine at any time, not at the rows alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::renders {

// All that a picture shows of one instant. Lengths in m, angles in rad, forces in N.
struct Pose {
  double t = 0.0;                    // s
  Eigen::Vector2d rotor{0.0, 0.0};   // centre of the rotor at the contact station
  Eigen::Vector2d stator{0.0, 0.0};  // centre of the ring
  Eigen::VectorXd x, y;              // n, modal coordinates
  double spin_angle = 0.0;
  double ring_angle = 0.0;            // of a ring that turns
  double gap = 0.0;                   // negative: penetration
  double normal_force = 0.0;          // >= 0
  double friction_force = 0.0;        // on the rotor along e_t = e_z x e_r
  Eigen::Vector2d control{0.0, 0.0};  // on the ring, of its actuator
  Eigen::Vector2d current{0.0, 0.0};  // A, of the coils of the axes (1, 1) and (-1, 1)
  Mode mode = Mode::kFree;

  // Outward normal from the ring's centre to the rotor's; 0 where they coincide.
  Eigen::Vector2d e_r() const;
};

// An impact with the place on the ring where it happened.
struct Strike {
  double t = 0.0;                 // s
  double impulse = 0.0;           // N s, normal
  Eigen::Vector2d e_r{1.0, 0.0};  // from the ring's centre to the point of contact
};

// Time of the first contact, s, from impacts and rows; nothing where it never touches.
std::optional<double> first_touch(const Trajectory& trajectory);

// A whirl that rows or frames are too far apart to show: drawn from point to point it is a star.
struct Strobe {
  double whirl = 0.0;    // rad/s, signed, of the rotor's centre about the ring's
  double spacing = 0.0;  // s, between rows
};
// A turn has to have so many points for its path to be drawn.
inline constexpr double kPointsOfATurn = 8.0;

// Between two rows positions follow the cubic Hermite of positions and velocities; the straight
// line where an impact lies between them, or where the velocities are not in the series. Two points
// inside a ring never give one outside of it that way; nor do rows too far apart for the whirl.
// Forces are interpolated within one contact and hold the value of the row before otherwise.
class Playback {
 public:
  // Throws std::runtime_error naming the column where the series lacks one that the contract
  // promises, and where it has no row. The trajectory must outlive the playback.
  // `contact`: of several, from 0, the one whose rotor, ring and forces a pose has.
  explicit Playback(const Trajectory& trajectory, std::size_t contact = 0);

  Pose at(double t) const;  // t is clamped to the rows' range

  // Of the rows in [from, to]: their median whirl by the velocities, where for most of them less
  // than kPointsOfATurn of `spacing` s make a turn; nothing where the path can be drawn, or where
  // the series has no velocities. spacing: 0: that of the rows.
  std::optional<Strobe> strobe(double from, double to, double spacing = 0.0) const;

  double start() const { return time_->front(); }  // s
  double end() const { return time_->back(); }
  std::optional<double> first_touch() const { return renders::first_touch(*trajectory_); }
  int modes() const { return static_cast<int>(modes_.size()); }
  const std::vector<Strike>& strikes() const { return strikes_; }
  // Largest |stator| over the rows from `from` to `to`, m, and quantile of the normal
  // force over the rows in contact there, N (0: no contact).
  double largest_stator(double from, double to) const { return largest(stator_, from, to); }
  double force_quantile(double quantile, double from, double to) const;
  // The same of the gap over all rows there, m, and the largest control force, N (0: none).
  double gap_quantile(double quantile, double from, double to) const;
  double largest_control(double from, double to) const { return largest(control_, from, to); }
  // A, of both coils together.
  double largest_current(double from, double to) const { return largest(current_, from, to); }

 private:
  // `of`: the column of that contact by the name of the first one's.
  template <class Of>
  Playback(const Trajectory& trajectory, std::size_t contact, const Of& of);

  using Values = std::vector<double>;
  // A position and its velocity, null where the series has none.
  struct Track {
    const Values* value = nullptr;
    const Values* rate = nullptr;
  };
  using Pair = std::array<Track, 2>;  // of two axes
  Track track(const std::string& value, const std::string& rate) const;
  std::size_t row_before(double t) const;
  double interpolate(const Track& track, std::size_t row, double t, bool smooth) const;
  bool impact_between(double from, double to) const;
  double whirl(std::size_t row) const;  // rad/s; 0 without velocities
  template <class Taken>
  double quantile_of(const Values& values, double quantile, double from, double to,
                     const Taken& taken) const;
  double largest(const std::optional<Pair>& pair, double from, double to) const;

  const Trajectory* trajectory_;
  const Values *time_, *gap_, *normal_, *friction_, *mode_;
  Pair rotor_, stator_;
  Track spin_;
  std::optional<Track> ring_;    // of a ring that turns
  std::optional<Pair> control_;  // of a ring with a controller
  std::optional<Pair> current_;  // of electromagnets
  std::vector<Pair> modes_;
  std::vector<Strike> strikes_;
};

}  // namespace rotorub::renders
