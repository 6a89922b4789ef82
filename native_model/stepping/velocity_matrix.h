// The matrix that a fixed step solves with, A = M + h/2 D. D is the linear part of all
// velocity-dependent forces (damping of modes and bearings, rotating damping, slope of the drive,
// gyroscopics) at the speed of t = 0. These forces are therefore implicit at the middle of the step
// and may have any size. Effects outside D (change of the spin speed, curve of a motor) are
// iterated (load_kick.h).
//
// A free spin with unbalance couples bending and spin by b(phi), the bending rows of M(phi)
// (equations::spin_coupling): A = A_0 + b e_phi^T + e_phi b^T. Bending is eliminated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "native_model/model/equations.h"
#include "native_model/model/model.h"

namespace rotorub {

class VelocityMatrix {
 public:
  // The model must outlive this object. h: time step, s.
  VelocityMatrix(const Model& model, double h);

  // h A^-1 if A is diagonal, nq values; otherwise null.
  const double* diagonal_step() const {
    return dense_bending_ || dense_spin_ || coupled_ ? nullptr : step_.data();
  }
  bool coupled() const { return coupled_; }
  // h A^-1 of coordinate i, s/kg; only for coordinates that A does not couple with others, which
  // are those of the rings.
  double step_of(int i) const { return step_[static_cast<std::size_t>(i)]; }

  // Sets b for the directions `at` of the discs.
  void couple_at(const equations::DiscAngles& at);
  const double* coupling() const { return coupling_.data(); }    // b, two planes
  std::int64_t times_coupled() const { return times_coupled_; }  // calls of couple_at()

  // f <- A^-1 f.
  void solve(double* f) {
    solve_uncoupled(f);
    if (coupled_) add(coupled_part(f), f);
  }
  // f <- A_0^-1 f.
  void solve_uncoupled(double* f);
  // The difference between A^-1 g and f = A_0^-1 g: -w spin in the bending rows and s back in the
  // spin rows, with w = B^-1 b and s = S^-1 e_phi, where B and S are the bending and spin blocks of
  // A_0.
  struct Coupled {
    double spin = 0.0, back = 0.0;
  };
  Coupled coupled_part(const double* f) const;
  void add(const Coupled& part, double* f) const;
  const double* solved_coupling() const { return solved_.data(); }   // w
  const double* spin_column() const { return spin_column_.data(); }  // s

 private:
  const Model* model_;
  bool dense_bending_ = false, dense_spin_ = false, coupled_ = false;
  std::vector<double> inverse_, step_;  // of the diagonal, nq; times h
  // Inverses B^-1 and S^-1 of the full blocks, column by column.
  std::vector<double> bending_, spin_;
  // Only if coupled: s; B^-1 times the mode values of each eccentric disc in x and in y; b; w; b' w
  // and 1 / (1 - b' w s_phi).
  std::vector<double> spin_column_, solved_shapes_, coupling_, solved_;
  double own_ = 0.0, free_spin_ = 1.0;
  std::int64_t times_coupled_ = 0;
  std::vector<double> work_;
};

}  // namespace rotorub
