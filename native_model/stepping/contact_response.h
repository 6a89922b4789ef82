// What a load at the contact does to the velocities of a fixed step: the columns A^-1 J^T and the
// admittance J A^-1 J^T of (x, y, torque about z). Where a free spin is coupled with bending
// (velocity_matrix.h) only what that adds changes from step to step.
#pragma once

#include <algorithm>

#include "native_model/stepping/load_kick.h"

namespace rotorub {

template <class M>
class ContactResponse {
 public:
  using T = typename M::Scalar;
  using State = StepState<M>;

  explicit ContactResponse(const M& m) : column_{State::make(m), State::make(m), State::make(m)} {}

  T admittance[3][3] = {};

  // Once, of a model with a contact; radius: m, of the rotor there.
  void find(const State& x, LoadKick<M>& loads, const T& radius) {
    radius_ = radius;
    const T zero{}, one = lanes::all<T>(1.0);
    for (int j = 0; j < 3; ++j) {
      T* column = column_[j].data();
      equations::add_contact_load(x.m, j == 0 ? one : zero, j == 1 ? one : zero,
                                  j == 2 ? one : zero, column);
      loads.solve_uncoupled(x, column);
      const equations::Pair<T> d = equations::relative(x.m, column);
      uncoupled_[0][j] = d.x;
      uncoupled_[1][j] = d.y;
      // A prescribed spin speed does not change.
      if (equations::turns_at_contact(x.m)) {
        uncoupled_[2][j] = equations::turning_at_contact(x.m, x.m.first(), column);
      }
      if (x.m.layout.spin) uncoupled_[2][j] += column[x.m.layout.phi()];
    }
    for (int i = 0; i < 3; ++i) std::copy_n(uncoupled_[i], 3, admittance[i]);
  }

  // With bending and spin coupled as in this step.
  ROTORUB_INLINE void couple(const State& x, const LoadKick<M>& loads) {
    if (!loads.coupled()) return;
    const auto& l = x.m.layout;
    const VelocityMatrix<T>& a = loads.matrix();
    const equations::Pair<T> bent =
        equations::at_station(l.modes, x.m.first().shape, a.solved_coupling());
    T turned = a.spin_column()[0];
    const T* shape = x.m.first().torsion_shape.data();
    for (int k = 0; k < l.torsion; ++k) turned += shape[k] * a.spin_column()[1 + k];
    for (int j = 0; j < 3; ++j) {
      coupled_[j] = a.coupled_part(l, column_[j].data());
      admittance[0][j] = uncoupled_[0][j] - bent.x * coupled_[j].spin;
      admittance[1][j] = uncoupled_[1][j] - bent.y * coupled_[j].spin;
      admittance[2][j] = uncoupled_[2][j] + turned * coupled_[j].back;
    }
  }

  // to = from + A^-1 J^T of the load (N, F) with the normal e, in the lanes of `on`.
  ROTORUB_INLINE void push(const State& x, const LoadKick<M>& loads, const T* from, T* to,
                           const equations::Pair<T>& e, const T& normal, const T& friction,
                           const lanes::Mask<T>& on) {
    const T zero{};
    const T N = lanes::select(on, normal, zero), F = lanes::select(on, friction, zero);
    const T px = -e.x * N - e.y * F, py = -e.y * N + e.x * F, pz = radius_ * F;
    const T *cx = column_[0].data(), *cy = column_[1].data(), *cz = column_[2].data();
    const int nq = x.nq();
    ROTORUB_APART for (int i = 0; i < nq; ++i) {
      to[i] = from[i] + (cx[i] * px + cy[i] * py + cz[i] * pz);
    }
    if (!loads.coupled()) return;
    const auto along = [&](auto part) {
      return coupled_[0].*part * px + coupled_[1].*part * py + coupled_[2].*part * pz;
    };
    loads.matrix().add(x.m.layout, {along(&Coupled::spin), along(&Coupled::back)}, to);
  }

 private:
  using Coupled = typename VelocityMatrix<T>::Coupled;

  T radius_{};
  // A_0^-1 J^T and J A_0^-1 J^T; what A has beside A_0^-1 J^T.
  typename State::Coordinates column_[3];
  T uncoupled_[3][3] = {};
  Coupled coupled_[3];
};

}  // namespace rotorub
