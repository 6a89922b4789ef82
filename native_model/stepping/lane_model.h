// Many models side by side, one a lane, for the equations' templates (dynamics/equations.h): the
// fields that they read, under the names that a Model has, each number a vector over the lanes.
#pragma once

#include <array>
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
    std::optional<Shape> sensor;
    FeedbackStates states;
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
  lanes::Array<T> gravity_mass;  // read where the base moves
  BasicModeMatrix<T> gyroscopic, internal_xx, internal_xy, internal_yy;
  std::vector<Damper> dampers;
  std::vector<Film> films;
  std::vector<Spring> springs;
  std::vector<Feedback> feedbacks;
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

// ---------------------------------------------------------------- models of a known size
// In a rotor of one mode the loops over coordinates cost more than the arithmetic: the step of
// `verlet` is compiled for the layout of a driven Jeffcott rotor in a moving ring too.

// As Layout, without torsion, a ring that turns and coils.
template <int kModes, int kSpin, int kStator>
struct SmallLayout {
  static constexpr int modes = kModes, spin = kSpin, torsion = 0, stator = kStator;
  static constexpr int ring_spin = 0, bristles = 0, integrals = 0, coils = 0;
  static constexpr int phi() { return 2 * modes; }
  static constexpr int theta() { return phi() + spin; }
  static constexpr int ring() { return theta(); }
  static constexpr int ring_angle() { return ring() + stator; }
  static constexpr int integral() { return ring_angle(); }
  static constexpr int coil() { return integral(); }
  static constexpr int mechanical() { return coil(); }
  static constexpr int nq() { return coil(); }
  static bool fits(const Layout& l) {
    return l.modes == modes && l.spin == spin && l.torsion == 0 && l.stator == stator &&
           l.ring_spin == 0 && l.bristles == 0 && l.integrals == 0 && l.coils == 0;
  }
};

// One mode in each plane, driven, in a moving ring.
using DrivenJeffcottInRing = SmallLayout<1, 1, 2>;

// M (a Model or a LaneModel) with the layout L.
template <class M, class L>
struct Sized : M {
  explicit Sized(const M& m) : M(m) {}
  static constexpr L layout{};
};

// A number for each coordinate of M.
template <class M>
struct CoordinateArray {
  using Type = lanes::Array<typename M::Scalar>;
  using Scratch = Type&;
  static Type make(const M& m) {
    return Type(static_cast<std::size_t>(m.layout.nq()), typename M::Scalar{});
  }
};
template <class M, class L>
struct CoordinateArray<Sized<M, L>> {
  using Type = std::array<typename M::Scalar, static_cast<std::size_t>(L::nq())>;
  using Scratch = Type;
  static Type make(const Sized<M, L>&) { return {}; }
};

// ---------------------------------------------------------------- everything that is compiled
template <int W>
using Lanes = LaneModel<lanes::Lane<W>>;
using DrivenJeffcott = Sized<Model, DrivenJeffcottInRing>;

// X(model type) for every model that `verlet` steps. Each costs half a minute of compilation, so
// that only one small layout is among them, and no lanes of it.
#define ROTORUB_ALL_MODELS(X) X(Model) X(DrivenJeffcott) X(Lanes<2>) ROTORUB_WIDE_MODELS(X)
// Lanes that only larger processors have (native_model/CMakeLists.txt).
#ifdef ROTORUB_EACH_TARGET
#define ROTORUB_WIDE_MODELS(X) X(Lanes<4>) X(Lanes<8>)
#else
#define ROTORUB_WIDE_MODELS(X)
#endif

}  // namespace rotorub
