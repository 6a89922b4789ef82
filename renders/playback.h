// Interpolates a trajectory for a film: the pose of the machine at any time, also between rows.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::renders {

// The state of the machine at one instant. Lengths in m, angles in rad, forces in N.
struct Pose {
  double t = 0.0;                    // s
  Eigen::Vector2d rotor{0.0, 0.0};   // centre of the rotor at the contact station
  Eigen::Vector2d stator{0.0, 0.0};  // centre of the ring
  Eigen::VectorXd x, y;              // n, modal coordinates
  double spin_angle = 0.0;
  double ring_angle = 0.0;            // if the ring turns
  double gap = 0.0;                   // negative: penetration
  double normal_force = 0.0;          // >= 0
  double friction_force = 0.0;        // on the rotor along e_t = e_z x e_r
  Eigen::Vector2d control{0.0, 0.0};  // actuator force on the ring
  Eigen::Vector2d current{0.0, 0.0};  // A, in the coils of the axes (1, 1) and (-1, 1)
  ContactMode mode = ContactMode::kFree;

  // Unit vector from the ring's centre to the rotor's; 0 if they coincide.
  Eigen::Vector2d e_r() const;
};

// An impact and its place on the ring.
struct Strike {
  double t = 0.0;                 // s
  double impulse = 0.0;           // N s, normal
  Eigen::Vector2d e_r{1.0, 0.0};  // from the ring's centre to the point of contact
};

// Time of the first contact, s, from statistics, impacts and rows; nothing if there is no contact.
std::optional<double> first_touch(const Trajectory& trajectory);

// A whirl that rows or frames undersample; its path would be drawn as a star.
struct Strobe {
  double whirl = 0.0;    // rad/s, signed, of the rotor's centre about the ring's
  double spacing = 0.0;  // s, between rows or frames
};
// The least number of points per turn for which the path is drawn.
inline constexpr double kPointsOfATurn = 8.0;

// Positions between rows follow the cubic Hermite interpolation of positions and velocities, or a
// straight line if there is an impact between the rows or the series has no velocities. A straight
// line between two points inside the ring cannot leave it; it is also used if the rows are too far
// apart for the whirl. Forces are interpolated within one contact and otherwise keep the value of
// the row before.
class Playback {
 public:
  // Throws std::runtime_error with the column's name if a required column is missing, and if there
  // are no rows. The trajectory must outlive the playback. `contact`: number of the contact, from
  // 0, whose rotor, ring and forces a pose contains.
  explicit Playback(const Trajectory& trajectory, std::size_t contact = 0);

  Pose at(double t) const;  // t is clamped to the rows' range

  // The median whirl of the rows in [from, to], from their velocities, if points at a distance of
  // `spacing` s give it fewer than kPointsOfATurn points per turn. A rotor that rocks to and fro
  // has a small median. Nothing if the path can be drawn or if the series has no velocities.
  // A spacing below the mean spacing of the rows is raised to it.
  std::optional<Strobe> strobe(double from, double to, double spacing = 0.0) const;
  double median_whirl(double from, double to) const;  // rad/s, of those rows
  double closest(double from, double to) const;       // time of the row with the least gap, s

  double start() const { return time_->front(); }  // s
  double end() const { return time_->back(); }
  std::optional<double> first_touch() const { return renders::first_touch(*trajectory_); }
  int modes() const { return static_cast<int>(modes_.size()); }
  const std::vector<Strike>& strikes() const { return strikes_; }
  // Largest |stator| over the rows from `from` to `to`, m, and a quantile of the normal force over
  // the rows in contact there, N (0 without contact).
  double largest_stator(double from, double to) const { return largest(stator_, from, to); }
  double force_quantile(double quantile, double from, double to) const;
  // Quantile of the gap over all rows there, m, and largest control force, N (0 if there is none).
  double gap_quantile(double quantile, double from, double to) const;
  double largest_control(double from, double to) const { return largest(control_, from, to); }
  // A, magnitude of the two coils' currents together.
  double largest_current(double from, double to) const { return largest(current_, from, to); }

 private:
  // `of`: maps a column name of the first contact to the name for `contact`.
  template <class Of>
  Playback(const Trajectory& trajectory, std::size_t contact, const Of& of);

  using Values = std::vector<double>;
  // A position and its velocity; null if the series does not have it.
  struct Track {
    const Values* value = nullptr;
    const Values* rate = nullptr;
  };
  using Pair = std::array<Track, 2>;  // for two axes
  Track track(const std::string& value, const std::string& rate) const;
  std::size_t row_before(double t) const;
  // The rows in which the motion over [from, to] begins, at least one but for the last row.
  std::pair<std::size_t, std::size_t> rows_of(double from, double to) const;
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
  std::optional<Track> ring_;    // if the ring turns
  std::optional<Pair> control_;  // if the ring has a controller
  std::optional<Pair> current_;  // if there are electromagnets
  std::vector<Pair> modes_;
  std::vector<Strike> strikes_;
};

}  // namespace rotorub::renders
