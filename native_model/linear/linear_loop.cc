#include "native_model/linear/linear_loop.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "native_model/model/sampled_feedback.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/matrix_functions.h"

namespace rotorub {

Model always_working(Model model) {
  for (StationFeedback& f : model.feedbacks) {
    const bool ever =
        f.works.fails > std::max(0.0, f.works.from) || f.works.returns < scene::kNever;
    f.works = {-scene::kNever, ever ? scene::kNever : -scene::kNever, scene::kNever};
  }
  return with_linear_feedback(without_offsets(std::move(model)));
}

std::vector<std::size_t> working_feedbacks(const Model& model) {
  std::vector<std::size_t> working;
  for (std::size_t k = 0; k < model.feedbacks.size(); ++k) {
    const StationFeedback& f = model.feedbacks[k];
    if (f.controlled && f.works.at(0.0)) working.push_back(k);
  }
  return working;
}

void put_planes(Eigen::MatrixXd& matrix, Eigen::Index column, const ModeShape& shape) {
  matrix.col(column).head(shape.x.size()) = shape.x;
  matrix.col(column + 1).tail(shape.y.size()) = shape.y;
}

std::string loop_refusal(const Model& m) {
  for (const SampledFeedback& s : m.samplers) {
    if (s.library != nullptr)
      return "a library commands the magnetic bearings (magnetic_control.library)";
    if (s.sample_time != m.samplers.front().sample_time)
      return "the controls of the magnetic bearings have different sample times";
  }
  return {};
}

LinearLoop linear_loop(const Model& m, double speed) {
  LinearLoop loop{closed_loop(m, speed).first_order(), 0.0, {}};
  if (m.samplers.empty()) return loop;
  loop.every = m.samplers.front().sample_time;
  const Eigen::Index bending = 2 * m.layout.modes, kept = m.layout.feedback_states;
  const Eigen::MatrixXd taken = linear_sample(m);
  Eigen::MatrixXd sample = Eigen::MatrixXd::Identity(2 * bending + kept, 2 * bending + kept);
  sample.bottomLeftCorner(kept, bending) = taken.leftCols(bending);
  sample.bottomRightCorner(kept, kept) = taken.rightCols(kept);
  const Eigen::VectorXd inverse = loop.form.unit.cwiseInverse();
  loop.sample = inverse.asDiagonal() * sample * loop.form.unit.asDiagonal();
  return loop;
}

std::optional<std::vector<std::complex<double>>> loop_poles(const LinearLoop& loop) {
  if (loop.every == 0.0) return real_eigenvalues(loop.form.a);
  // Map over one sample, from just before it to just before the next: S first, then e^{A T}.
  const auto values = real_eigenvalues(matrix_exp(loop.form.a * loop.every) * loop.sample);
  if (!values) return std::nullopt;
  constexpr double kNothing = 1e-6;  // |z| below this is round-off: motion that ends in one sample
  std::vector<std::complex<double>> poles;
  for (const std::complex<double>& z : *values) {
    if (std::abs(z) > kNothing) poles.push_back(std::log(z) / loop.every);
  }
  sort_by_growth(poles);
  return poles;
}

Eigen::VectorXcd loop_amplitude(const Model& m, const LinearLoop& loop, double w,
                                const Eigen::VectorXcd& f) {
  const Eigen::Index bending = f.size(), states = loop.form.a.rows();
  const auto minus = [&](std::complex<double> of_one,
                         const Eigen::MatrixXd& a) -> Eigen::MatrixXcd {
    return of_one * Eigen::MatrixXcd::Identity(states, states) - a.cast<std::complex<double>>();
  };
  Eigen::VectorXcd load = Eigen::VectorXcd::Zero(states);
  load.segment(bending, bending) =
      f.cwiseQuotient(m.mass.head(bending).cwiseProduct(loop.form.unit.segment(bending, bending)));
  const Eigen::MatrixXcd turned = minus(std::complex<double>(0.0, w), loop.form.a);
  Eigen::VectorXcd mean = lu_solve(turned, load);
  if (loop.every > 0.0) {
    const std::complex<double> z = std::polar(1.0, w * loop.every);
    const Eigen::MatrixXd over = matrix_exp(loop.form.a * loop.every);
    const Eigen::VectorXcd before =
        lu_solve(minus(z, over * loop.sample), Eigen::VectorXcd(minus(z, over) * mean));
    mean -= lu_solve(turned, Eigen::VectorXcd(before - loop.sample * before)) / loop.every;
  }
  return loop.form.unit.head(bending).cwiseProduct(mean.head(bending));
}

}  // namespace rotorub
