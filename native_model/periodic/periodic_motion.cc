#include "native_model/periodic/periodic_motion.h"

#include <algorithm>
#include <cmath>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"

namespace rotorub::periodic {
namespace {

constexpr double kMostOfPeriod = 0.2;  // largest change of an unknown period in one step
constexpr double kMostOfState = 0.5;   // largest change of the state, relative to its sizes
constexpr double kGoodFall = 0.1;      // of the residual in one iteration

struct NewtonStep {
  Eigen::VectorXd c;       // in the tangent space
  double of_period = 0.0;  // relative change of the period
};

NewtonStep newton_step(const Return& point, const ReturnDerivative& d, double period,
                       bool autonomous) {
  const Eigen::Index k = d.basis.cols(), n = autonomous ? k + 1 : k;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  matrix.topLeftCorner(k, k) = d.basis.transpose() * (d.image - d.basis);
  right.head(k) = -(d.basis.transpose() * point.change);
  if (autonomous) {
    matrix.topRightCorner(k, 1) = period * (d.basis.transpose() * d.end_slope);
    matrix.bottomLeftCorner(1, k) = period * (d.start_slope.transpose() * d.basis);
  }
  const Eigen::VectorXd step = least_squares(matrix, right);
  NewtonStep found{step.head(k), autonomous ? step[k] : 0.0};
  double share = 1.0;
  if (autonomous) share = std::max(share, std::abs(found.of_period) / kMostOfPeriod);
  share = std::max(share, (d.basis * found.c).cwiseAbs().maxCoeff() / kMostOfState);
  found.c /= share;
  found.of_period /= share;
  return found;
}

void end_with(PeriodicMotion& motion, SearchStatus status, const std::string& message) {
  motion.status = status;
  motion.message = message;
}

}  // namespace

const char* to_string(SearchStatus status) {
  switch (status) {
    case SearchStatus::kFound:
      return "found";
    case SearchStatus::kNoConvergence:
      return "no convergence";
    case SearchStatus::kRunFailed:
      return "run failed";
    case SearchStatus::kGrazes:
      return "grazes";
    case SearchStatus::kRefused:
      return "refused";
  }
  return "";
}

std::vector<std::complex<double>> floquet_multipliers(const ReturnDerivative& d, bool autonomous) {
  const Eigen::MatrixXd map = d.basis.transpose() * d.image;
  if (!map.allFinite()) return {};
  auto all = real_eigenvalues(map);
  if (!all) return {};
  if (autonomous && !all->empty()) {
    const auto off = [](const std::complex<double>& s) { return std::abs(s - 1.0); };
    all->erase(std::ranges::min_element(*all, {}, off));
  }
  std::ranges::stable_sort(*all, std::ranges::greater{},
                           [](const std::complex<double>& s) { return std::abs(s); });
  return *all;
}

bool is_stable(const std::vector<std::complex<double>>& multipliers) {
  constexpr double kRoundOff = 1e-8;
  return !multipliers.empty() && std::ranges::all_of(multipliers, [](const auto& m) {
    return std::abs(m) <= 1.0 + kRoundOff;
  });
}

PeriodicMotion find_periodic_motion(const Model& model, const Guess& guess,
                                    const SearchParameters& parameters) {
  PeriodicMotion motion;
  motion.start = guess.start;
  motion.period = guess.period;
  motion.turns = guess.turns;
  motion.held = guess.held;
  const ReturnMap map(model, parameters.event, guess.turning);
  motion.frame = map.frame().speed();
  if (!map.forcing().refusal.empty()) {
    end_with(motion, SearchStatus::kRefused, map.forcing().refusal);
    return motion;
  }
  const bool autonomous = map.is_autonomous();
  map.project(motion.start, motion.held);
  Return point = map.at(motion.start, motion.period, motion.turns);
  if (point.status != Status::kOk) {
    end_with(motion, SearchStatus::kRunFailed, point.message);
    return motion;
  }
  ReturnDerivative d;
  bool fresh = false;  // d belongs to this point
  for (motion.iterations = 0;; ++motion.iterations) {
    motion.residual = point.residual;
    const bool found = point.residual <= parameters.tolerance;
    if (found || d.basis.size() == 0) {
      d = map.derivative(point, motion.held);
      fresh = true;
    }
    if (found) {
      motion.multipliers = floquet_multipliers(d, autonomous);
      motion.stable = is_stable(motion.multipliers);
      motion.status = SearchStatus::kFound;
      return motion;
    }
    if (motion.iterations == parameters.most_iterations) break;
    double fall = 1.0;  // of the residual
    const auto improve = [&] {
      if (d.grazes || !d.image.allFinite()) return;
      const NewtonStep step = newton_step(point, d, motion.period, autonomous);
      if (!step.c.allFinite() || !std::isfinite(step.of_period)) return;
      const int halvings = fresh ? parameters.most_halvings : 0;
      double share = 1.0;
      for (int k = 0; k <= halvings; ++k, share *= 0.5) {
        const State start =
            map.moved(motion.start, point.sizes, d.basis, share * step.c, motion.held);
        const double period = motion.period * (1.0 + share * step.of_period);
        Return next = map.at(start, period, motion.turns);
        if (!(next.residual < (fresh ? 1.0 : kGoodFall) * point.residual)) continue;
        fall = next.residual / point.residual;
        motion.start = start;
        motion.period = period;
        point = std::move(next);
        return;
      }
    };
    improve();
    // A derivative costs many motions, so an old one serves while it makes the residual fall fast.
    if (fall <= kGoodFall) {
      fresh = false;
    } else if (fall < 1.0 || !fresh) {
      d = map.derivative(point, motion.held);
      fresh = true;
    } else {
      if (d.grazes) {
        end_with(motion, SearchStatus::kGrazes, "a contact grazes");
        return motion;
      }
      break;
    }
  }
  end_with(motion, SearchStatus::kNoConvergence,
           "Newton's method does not converge from this start");
  return motion;
}

}  // namespace rotorub::periodic
