// Many models side by side, one a lane, for the equations' templates (dynamics/equations.h): the
// fields that they read, under the names that a Model has, each number a vector over the lanes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "native_model/numerics/lanes.h"
#include "native_model/system/model.h"

namespace rotorub {

template <class T>
struct LaneModel {
  using Scalar = T;
  struct Shape {  // mode values at a station, n each
    lanes::Array<T> x, y;
  };
  struct Plane {  // a number for each plane
    T values[2];
    const T& x() const { return values[0]; }
    const T& y() const { return values[1]; }
  };
  struct Damper {
    Shape shape;
    Plane damping;
  };
  struct Film {
    Shape shape;
    BearingFilm<T> law;
  };
  struct Spring {
    Shape shape;
    Plane stiffness;
  };
  struct Feedback {
    Shape shape;
    MagneticFeedback<T> law;
  };
  struct Bearing {  // as AuxiliaryBearing
    Shape shape;
    lanes::Array<T> torsion_shape;
    Plane ring_offset{};
    T ring_ratio{};
    int ring, ring_angle;
  };
  struct Unbalance {
    Shape shape;
    T static_moment{}, phase{}, on{};
  };

  // One model a lane, all of the same structure (see same_structure); they must outlive this.
  explicit LaneModel(const std::vector<const Model*>& models);

  std::vector<const Model*> models;
  Layout layout;
  lanes::Array<T> mass, stiffness, damping, weight;
  BasicModeMatrix<T> gyroscopic, internal_xx, internal_xy, internal_yy;
  std::vector<Damper> dampers;
  std::vector<Film> films;
  std::vector<Spring> springs;
  std::optional<Feedback> feedback;
  std::vector<Unbalance> unbalances;
  T speed{}, spin_angle{};
  lanes::Array<T> drive_shape;
  Bearing bearing;
  const Bearing& first() const { return bearing; }
  T drive_gain{}, drive_speed{};  // of a linear drive
  T drive_angle{};
  bool linear_drive = false, following_drive = false;

  bool coupled_mass() const { return layout.spin == 1 && !unbalances.empty(); }
  bool drive_follows() const { return following_drive; }
  ROTORUB_INLINE T drive_torque(double t, const T& angle, const T& motor_speed) const {
    if (linear_drive) return drive_gain * (drive_speed - motor_speed);
    T torque{};
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      const Model& m = *models[static_cast<std::size_t>(lane)];
      lanes::set(torque, lane,
                 m.drive_torque(t, lanes::get(angle, lane), lanes::get(motor_speed, lane)));
    }
    return torque;
  }
};

// True where two models have the same coordinates and parts, so that they can be lanes of one
// kernel.
bool same_structure(const Model& a, const Model& b);

// The model in a lane, and how many there are: for what is done run by run.
inline const Model& lane_model(const Model& model, int) { return model; }
template <class T>
const Model& lane_model(const LaneModel<T>& models, int lane) {
  return *models.models[static_cast<std::size_t>(lane)];
}

// to[i] of one lane = from[i].
template <class To, class From>
void put_lane(To& to, const From& from, int lane) {
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    lanes::set(to[static_cast<std::size_t>(i)], lane, from[i]);
  }
}

}  // namespace rotorub
