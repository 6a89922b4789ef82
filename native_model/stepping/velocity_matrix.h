// The matrix that a fixed step solves with, A = M + h/2 D: D is the linear part of all forces that
// depend on velocities (damping of modes and bearings, rotating damping, the drive's slope,
// gyroscopics), taken at the speed of t = 0. So all of them are implicit at the middle of the step,
// whatever their size. What D leaves out (the spin's change, a motor's curve) is iterated
// (load_kick.h).
//
// A free spin with unbalance couples bending and spin by b(phi), the bending rows of M(phi)
// (equations::spin_coupling): A = A_0 + b e_phi^T + e_phi b^T, and bending is eliminated.
#pragma once

#include <vector>

#include "native_model/model/equations.h"
#include "native_model/model/model.h"

namespace rotorub {

class VelocityMatrix {
 public:
  // The model must outlive it. step h, s.
  VelocityMatrix(const Model& model, double h);

  // h A^-1 where A is diagonal, nq values; else null.
  const double* diagonal_step() const {
    return dense_bending_ || dense_spin_ || coupled_ ? nullptr : step_.data();
  }
  bool coupled() const { return coupled_; }

  // b where the discs' directions are `at`.
  void couple_at(const equations::DiscAngles& at);
  const double* coupling() const { return coupling_.data(); }  // b, two planes

  // f <- A^-1 f.
  void solve(double* f) {
    solve_uncoupled(f);
    if (coupled_) add(coupled_part(f), f);
  }
  // f <- A_0^-1 f.
  void solve_uncoupled(double* f);
  // Of g with f = A_0^-1 g what A^-1 g has beside f: -w spin in bending, s back in the spin rows;
  // with w = B^-1 b, s = S^-1 e_phi the rows of unbalance are eliminated.
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
  // Inverses of the blocks, column by column, where they are full: B^-1, S^-1.
  std::vector<double> bending_, spin_;
  // Where coupled: s; of each eccentric disc B^-1 times its mode values, of x and of y; b; w; b' w
  // and 1 / (1 - b' w s_phi).
  std::vector<double> spin_column_, solved_shapes_, coupling_, solved_;
  double own_ = 0.0, free_spin_ = 1.0;
  std::vector<double> work_;
};

}  // namespace rotorub
