// The arithmetic of one step of the paper's scheme (see paper.h) for one run (T = double) or for
// kWidth runs at once (T = Lane). Impacts are rare and taken lane by lane by the scalar law; free
// flight and lasting contact are branch-free across lanes. What a model lacks costs nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "native_model/contact/impact_map.h"
#include "native_model/integrate/lanes.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

template <class T>
class PaperKernel {
 public:
  static constexpr int kLanes = lanes::Traits<T>::kWidth;
  using Mask = typename lanes::Traits<T>::Mask;

  // One model a lane, all of the same structure (see same_structure); they must outlive the kernel.
  PaperKernel(const std::vector<const Model*>& models, double step);

  // State, nq each; written by the caller at the start.
  T* q() { return q_.data(); }
  T* v() { return v_.data(); }
  // What the actuator is told, held over the next step (system/actuation.h): the force on the ring,
  // or the currents of the two axes; `commanded`: there is a command (from the start where the models
  // have a controller).
  T command_x{}, command_y{};
  bool commanded = false;
  double origin = 0.0;  // s, t at k = 0

  // What the last step did.
  T normal_impulse{}, friction_impulse{};  // N s
  T slip_sign{};                           // of sliding contact: +1, -1; 0: free or sticking
  const T& in_contact() const { return in_contact_; }  // 1 in lasting contact, else 0
  Impact impact[kLanes];
  bool impacted[kLanes] = {};
  bool any_impact() const { return impacts_; }
  Status status[kLanes] = {};

  // From t = origin + k step to origin + (k + 1) step. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k);

  // Of one lane (paper_kernel_memory.h).
  static std::size_t memory_size(const Model& model);
  void save(double* to) const;
  void restore(const double* from);
  static const double* saved_q(const double* memory);
  void begin(double t, const double* q, const double* v);

 private:
  struct Force {
    bool rotating = false, switched = false;
    T amplitude{}, frequency{}, phase{}, x{}, y{}, on{}, off{}, ramp{};
    T cosine{}, sine{}, turn_cosine{}, turn_sine{};  // at the midpoint, and of one step
    lanes::Array<T> shape_x, shape_y;
  };
  struct Station {  // spring or damper
    T factor_x{}, factor_y{};
    lanes::Array<T> shape_x, shape_y;
  };
  struct Unbalance {
    T moment{}, phase{}, cosine{}, sine{};
    lanes::Array<T> shape_x, shape_y;
  };
  struct Matrix {
    ModeMatrix::Kind kind = ModeMatrix::Kind::kAbsent;
    lanes::Array<T> a;  // diagonal, or row by row
  };
  struct Centre {
    T x, y;
  };

  void load(const std::vector<const Model*>& models);
  ROTORUB_INLINE Centre relative(const T* q) const;
  ROTORUB_INLINE T spin_at_contact(const T* v) const;
  ROTORUB_INLINE void add_station(const lanes::Array<T>& sx, const lanes::Array<T>& sy, T fx, T fy);
  ROTORUB_INLINE void multiply(const Matrix& m, T factor, const T* in, T* out, bool transposed) const;
  ROTORUB_INLINE void rotate(T omega, double h);
  // Where every number that outlives a step is, in the order of the memory.
  template <class Kernel, class Action>
  static void for_each_kept(Kernel& kernel, Action action);
  ROTORUB_INLINE void forces(std::int64_t k);
  ROTORUB_INLINE void unbalance_arms(double t);
  ROTORUB_INLINE void unbalance_load(T omega);
  ROTORUB_INLINE void drive_torque();
  void magnet_force();
  ROTORUB_INLINE void free_velocity(std::int64_t k);
  ROTORUB_INLINE void solve(const T* inverse_mass, T* f) const;
  struct Admittance {
    T xx, yy, xy, xz, yz, zz;
  };
  ROTORUB_INLINE Admittance admittance(const T* inverse_mass) const;
  ROTORUB_INLINE void add_contact(const T* inverse_mass, T* x, T ex, T ey, T normal, T friction,
                                  Mask on);
  ROTORUB_INLINE void project();
  ROTORUB_INLINE void touch(std::int64_t k);
  ROTORUB_INLINE void persist(Mask on, T ex, T ey, T gap, Centre free, T spin);
  void impact_lane(int lane, std::int64_t k, const Eigen::Vector2d& e_r,
                   const Eigen::Vector3d& free, const Eigen::Vector2d& start, double closing_time);

  double step_;
  Layout layout_;
  bool contact_present_ = false, coupled_ = false, magnets_ = false;
  std::vector<const Model*> models_;
  lanes::Array<T> q_, v_, q_mid_, v_new_, f_;
  lanes::Array<T> mass_, inverse_mass_, implicit_inverse_, stiffness_, damping_, weight_;
  lanes::Array<T> contact_x_, contact_y_, torsion_contact_, drive_shape_;
  lanes::Array<T> arm_x_, arm_y_;  // rows of M that couple spin and bending
  std::vector<Force> forces_;
  std::vector<Station> springs_, dampers_;
  std::vector<Unbalance> unbalances_;
  Matrix internal_xx_, internal_yy_, internal_xy_;
  // The gyroscopic rotation, see gyroscopic_modes.h.
  bool rotates_ = false, rotates_diagonal_ = false;
  lanes::Array<T> turn_rate_, to_x_, to_y_, from_x_, from_y_, pair_a_, pair_b_;
  scene::DriveKind drive_kind_ = scene::DriveKind::kFree;
  T drive_gain_{}, drive_speed_{}, speed_{}, spin_angle_{};
  T radius_{}, clearance_{}, friction_{}, restitution_{};
  T in_contact_{};
  bool failed_ = false, impacts_ = false;  // some lane has a status; had an impact last step
  Admittance constant_{}, constant_implicit_{};
};

// Smallest s in [0, h] at which |d + s v| = radius, from inside or on the circle.
double circle_crossing(double dx, double dy, double vx, double vy, double radius, double h);

}  // namespace rotorub
