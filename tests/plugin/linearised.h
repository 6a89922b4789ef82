// MuJoCo's accelerations about the spinning, undeflected segment rotor, linearised by differences.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <vector>

#include "native_model/numerics/eigenvalues.h"
#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

// x'' = from_position x + from_velocity x' in the joints given, all others at rest but the spin.
struct Linearised {
  Eigen::MatrixXd from_position, from_velocity;
};

class LinearisedRotor {
 public:
  // Hooks must be installed.
  explicit LinearisedRotor(const mjModel* m)
      : m_(m), d_(mj_makeData(m)), segments_(*plugin::make_config(m).segments) {}

  const plugin::Segments& segments() const { return segments_; }

  Linearised bending(double speed) {
    std::vector<plugin::JointAddress> joints = segments_.x;
    joints.insert(joints.end(), segments_.y.begin(), segments_.y.end());
    return about(joints, speed, 1e-6);
  }
  Linearised torsion(double speed) { return about(segments_.spin, speed, 1e-6); }

 private:
  // Central differences: the accelerations are odd in the deflections, so that the error is cubic.
  Linearised about(const std::vector<plugin::JointAddress>& joints, double speed, double size) {
    const auto n = static_cast<Eigen::Index>(joints.size());
    Linearised result{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
    for (Eigen::Index j = 0; j < n; ++j) {
      const plugin::JointAddress& joint = joints[static_cast<std::size_t>(j)];
      result.from_position.col(j) = (accelerations(joints, speed, joint.position, -1, size) -
                                     accelerations(joints, speed, joint.position, -1, -size)) /
                                    (2.0 * size);
      result.from_velocity.col(j) = (accelerations(joints, speed, -1, joint.velocity, size) -
                                     accelerations(joints, speed, -1, joint.velocity, -size)) /
                                    (2.0 * size);
    }
    return result;
  }

  Eigen::VectorXd accelerations(const std::vector<plugin::JointAddress>& joints, double speed,
                                int position, int velocity, double size) {
    mj_resetData(m_, d_.get());
    for (const plugin::JointAddress& spin : segments_.spin) {
      d_->qpos[spin.position] = 0.7;  // any
      d_->qvel[spin.velocity] = speed;
    }
    if (position >= 0) d_->qpos[position] += size;
    if (velocity >= 0) d_->qvel[velocity] += size;
    mj_forward(m_, d_.get());
    Eigen::VectorXd a(static_cast<Eigen::Index>(joints.size()));
    for (std::size_t i = 0; i < joints.size(); ++i) {
      a[static_cast<Eigen::Index>(i)] = d_->qacc[joints[i].velocity];
    }
    return a;
  }

  const mjModel* m_;
  DataPointer d_;
  plugin::Segments segments_;
};

// Eigenvalues s of z'' = C z + B z', by rising |Im s|, negative first.
template <typename Matrix>
std::vector<std::complex<double>> eigenvalues(const Matrix& C, const Matrix& B) {
  const Eigen::Index n = C.rows();
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = C.template cast<std::complex<double>>();
  A.bottomRightCorner(n, n) = B.template cast<std::complex<double>>();
  std::vector<std::complex<double>> s = complex_eigenvalues(A).value();
  std::sort(s.begin(), s.end(),
            [](const auto& a, const auto& b) { return std::abs(a.imag()) < std::abs(b.imag()); });
  return s;
}

// Equal planes as one in x + i y: each eigenvalue is a whirl, forward with Im s > 0.
inline std::vector<std::complex<double>> isotropic_whirl(const Linearised& a) {
  const std::complex<double> i(0.0, 1.0);
  const Eigen::Index n = a.from_position.rows() / 2;
  const auto complex = [&](const Eigen::MatrixXd& both) -> Eigen::MatrixXcd {
    return both.topLeftCorner(n, n) - i * both.topRightCorner(n, n);
  };
  return eigenvalues(complex(a.from_position), complex(a.from_velocity));
}

}  // namespace rotorub::test
