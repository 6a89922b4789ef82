#include "plugin/linearise.h"

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/matrix_functions.h"
#include "plugin/config_cache.h"
#include "plugin/contact/verlet.h"
#include "plugin/differences.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

MatrixXd matrix(const std::vector<double>& values, int rows, int columns) {
  return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

// Spectral projection onto the eigenvalues of `a` below `radius`: (1 - sign of its Cayley
// transform) / 2, where the sign is found by Newton's iteration.
MatrixXd projection_within(const MatrixXd& a, double radius) {
  const MatrixXd one = MatrixXd::Identity(a.rows(), a.cols());
  MatrixXd x = lu_solve(MatrixXd(a + radius * one), MatrixXd(a - radius * one));
  constexpr int kRounds = 100;
  for (int k = 0; k < kRounds; ++k) {
    const MatrixXd next = 0.5 * (x + lu_inverse(x));
    const double change = (next - x).norm();
    x = next;
    if (change <= 1e-14 * x.norm()) break;
  }
  MatrixXd projection = 0.5 * (one - x);
  // In flight the projection is 0 except for round-off.
  if (std::abs(projection.trace()) < 0.5) projection.setZero();
  return projection;
}

[[noreturn]] void refuse_linear(const char* reason) {
  throw std::runtime_error(std::string("rotorub: linearise: ") + reason +
                           "; lower <option timestep>");
}

void refuse_fast(const MatrixXd& a) {
  const auto values = real_eigenvalues(a);
  if (!values) refuse_linear("the eigenvalues of the step are not found");
  for (const std::complex<double>& value : *values) {
    if (value.real() > 0.0 || std::abs(value.imag()) > 1e-9 * std::abs(value)) continue;
    refuse_linear("a mode turns by half a turn a step or more");
  }
}

bool begins_with_half_a_kick(const mjModel* m, const mjData* d) {
  const Config* config = find_config_checked(m, d);
  return config && config->takes_native_steps() && begins_anew(*config, m, d);
}

}  // namespace

LinearSystem linearise(const mjModel* m, const mjData* d, double eps) {
  const std::unique_ptr<mjData, void (*)(mjData*)> next(
      begins_with_half_a_kick(m, d) ? mj_makeData(m) : nullptr, mj_deleteData);
  if (next) {
    mj_copyData(next.get(), m, d);
    mj_step(m, next.get());
    d = next.get();
  }
  const Transition t = transition(m, d, eps);
  // eigenvalue of a step; those of all moving modes are near 1 in magnitude
  constexpr double kHeld = 0.5;
  const MatrixXd step = matrix(t.A, t.states, t.states);
  const MatrixXd one = MatrixXd::Identity(t.states, t.states);
  LinearSystem out;
  out.held = projection_within(step, kHeld);
  const MatrixXd free = step * (one - out.held) + out.held;
  refuse_fast(free);
  const std::optional<MatrixXd> log = matrix_log(free);
  if (!log) refuse_linear("the logarithm of the step is not found");
  const double h = m->opt.timestep;
  out.A = *log / h;
  // B_k = h phi(A h) B, phi(x) = (e^x - 1) / x = sum x^j / (j + 1)!. A few terms are enough if |A
  // h| is small; otherwise as many as needed.
  const MatrixXd x = out.A * h;
  MatrixXd phi = one, term = one;
  for (int j = 1; j < 60 && term.norm() > 1e-17 * phi.norm(); ++j) {
    term = term * x / (j + 1.0);
    phi += term;
  }
  out.B = lu_solve(phi, MatrixXd((one - out.held) * matrix(t.B, t.states, t.controls))) / h;
  out.C = matrix(t.C, t.sensors, t.states) * (one - out.held);
  out.D = matrix(t.D, t.sensors, t.controls);
  return out;
}

}  // namespace rotorub::plugin
