#include "native_model/linear/step_response.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/matrix_functions.h"

namespace rotorub {
namespace {

// maps_[k] advances (x, f) by h 2^k. maps_[kWhole] is one whole step: one sample, or, for a
// continuous loop, a sixteenth of 1 / |s| of its fastest pole.
constexpr int kWhole = 16;
// The first 2^kDenseOctaves whole steps are all evaluated, then half as many points in every
// octave.
constexpr int kDenseOctaves = 10;
constexpr std::int64_t kDense = std::int64_t{1} << kDenseOctaves;

class Flow {
 public:
  Flow(const LinearLoop& loop, const Eigen::MatrixXd& input, double whole, int octaves)
      : states_(loop.form.a.rows()), step_(std::ldexp(whole, -kWhole)) {
    const Eigen::Index n = states_, p = input.cols();
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n + p, n + p);
    block.topLeftCorner(n, n) = step_ * loop.form.a;
    block.topRightCorner(n, p) = step_ * input;
    maps_.push_back(matrix_exp(block));
    while (static_cast<int>(maps_.size()) <= kWhole + kDenseOctaves + octaves) {
      maps_.push_back(maps_.back() * maps_.back());
      if (static_cast<int>(maps_.size()) == kWhole + 1 && loop.every > 0.0)
        maps_.back().topRows(n) = (loop.sample * maps_.back().topRows(n)).eval();
    }
  }

  // One column per port: x = 0, followed by f = 1.
  Eigen::MatrixXd start() const {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(maps_[0].rows(), maps_[0].rows() - states_);
    x.bottomRows(x.cols()).setIdentity();
    return x;
  }
  // Map over 2^octave whole steps.
  const Eigen::MatrixXd& map(int octave) const {
    return maps_[static_cast<std::size_t>(kWhole + octave)];
  }
  double time(std::int64_t steps) const { return static_cast<double>(steps) * whole(); }
  // (x, f) after this number of whole steps.
  Eigen::VectorXd at(std::int64_t steps, Eigen::Index port) const {
    Eigen::VectorXd x = start().col(port);
    for (std::size_t k = kWhole; steps != 0; steps /= 2, ++k) {
      if (steps % 2 != 0) x = (maps_[k] * x).eval();
    }
    return x;
  }
  // Finds by bisection where row . x = level between `steps` whole steps and 2^octave later.
  struct Met {
    double t;
    Eigen::VectorXd x;
  };
  Met crossing(const Eigen::RowVectorXd& row, double level, std::int64_t steps, int octave,
               Eigen::Index port) const {
    Met met{time(steps), at(steps, port)};
    double off = row.dot(met.x) - level;
    for (int k = kWhole + octave; k-- > 0;) {
      const Eigen::VectorXd later = maps_[static_cast<std::size_t>(k)] * met.x;
      const double then = row.dot(later) - level;
      if ((then > 0.0) != (off > 0.0)) continue;
      met = {met.t + std::ldexp(step_, k), later};
      off = then;
    }
    const double then = row.dot(maps_[0] * met.x) - level;
    if (then != off) met.t += step_ * off / (off - then);
    return met;
  }

 private:
  double whole() const { return std::ldexp(step_, kWhole); }

  Eigen::Index states_;
  double step_;  // s
  std::vector<Eigen::MatrixXd> maps_;
};

// Force input, deflection and its rate for two ports of each working feedback, in the form's units.
struct Ports {
  Eigen::MatrixXd input, deflection, rate;
};
Ports ports_of(const Model& m, const FirstOrderForm& form) {
  const Eigen::Index n = m.layout.modes, states = form.a.rows();
  const std::vector<std::size_t> working = working_feedbacks(m);
  const auto p = 2 * static_cast<Eigen::Index>(working.size());
  Ports ports{Eigen::MatrixXd::Zero(states, p), Eigen::MatrixXd::Zero(p, states),
              Eigen::MatrixXd::Zero(p, states)};
  for (Eigen::Index j = 0; j < p; ++j) {
    const ModeShape& at = m.feedbacks[working[static_cast<std::size_t>(j / 2)]].shape;
    const Eigen::VectorXd& shape = j % 2 == 0 ? at.x : at.y;
    const Eigen::Index q = j % 2 * n, v = 2 * n + q;
    ports.input.col(j).segment(v, n) = shape.cwiseQuotient(m.mass.segment(q, n));
    ports.deflection.row(j).segment(q, n) = shape;
    ports.rate.row(j).segment(v, n) = shape;
  }
  ports.input.array().colwise() /= form.unit.array();
  ports.deflection.array().rowwise() *= form.unit.transpose().array();
  ports.rate.array().rowwise() *= form.unit.transpose().array();
  return ports;
}

// Instants to evaluate, in whole steps; the interval to the next is 2^octave of them.
struct Grid {
  std::vector<std::int64_t> steps;
  std::vector<int> octave;
  Eigen::MatrixXd y;  // ports x instants, m/N
};
Grid grid_of(const Flow& flow, const Eigen::MatrixXd& deflection, int octaves) {
  Grid grid;
  std::vector<Eigen::VectorXd> all;
  Eigen::MatrixXd x = flow.start();
  std::int64_t at = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    for (const std::int64_t end = kDense << octave; at < end; at += std::int64_t{1} << octave) {
      grid.steps.push_back(at);
      grid.octave.push_back(octave);
      all.push_back(
          deflection.cwiseProduct(x.topRows(deflection.cols()).transpose()).rowwise().sum());
      x = (flow.map(octave) * x).eval();
    }
  }
  grid.y.resize(deflection.rows(), static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) grid.y.col(static_cast<Eigen::Index>(k)) = all[k];
  return grid;
}

// Results of one port. deflection, rate: rows that act on (x, f).
StepResponse read(const Flow& flow, const Grid& grid, Eigen::Index port,
                  const Eigen::RowVectorXd& deflection, const Eigen::RowVectorXd& rate,
                  double steady) {
  constexpr double kScatter = 1e-9;  // of the largest: smaller steady values are round-off
  const Eigen::RowVectorXd y = grid.y.row(port);
  const auto steps = [&](Eigen::Index k) { return grid.steps[static_cast<std::size_t>(k)]; };
  const auto crossing = [&](const Eigen::RowVectorXd& row, double level, Eigen::Index k) {
    return flow.crossing(row, level, steps(k), grid.octave[static_cast<std::size_t>(k)], port);
  };
  StepResponse r;
  Eigen::Index most = 0;
  const double highest = y.cwiseAbs().maxCoeff(&most);
  if (std::abs(steady) > kScatter * highest) r.steady = steady;
  r.largest = r.steady;
  if (highest > (1.0 + kScatter) * std::abs(r.steady) && most > 0 && most + 1 < y.size()) {
    // Before the sampled maximum the deflection still grows; after it, it has begun to return.
    const bool grows = rate.dot(flow.at(steps(most), port)) * y[most] > 0.0;
    const Flow::Met top = crossing(rate, 0.0, grows ? most : most - 1);
    r.largest = deflection.dot(top.x);
    r.largest_at = top.t;
  }
  if (std::abs(r.steady) >= StepResponse::kSteadyShare * std::abs(r.largest)) {
    const auto first = [&](double share) {
      Eigen::Index k = 0;
      while (k + 2 < y.size() && y[k + 1] / r.steady < share) ++k;
      return crossing(deflection, share * r.steady, k).t;
    };
    r.rise_time = first(0.9) - first(0.1);
    r.overshoot = std::max(0.0, r.largest / r.steady - 1.0);
  }
  const double band = StepResponse::kBand * std::abs(r.overshoot ? r.steady : r.largest);
  Eigen::Index last = y.size() - 2;
  while (last > 0 && std::abs(y[last] - r.steady) <= band) --last;
  const double side = y[last] > r.steady ? band : -band;
  r.settling_time = crossing(deflection, r.steady + side, last).t;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    r.t.push_back(flow.time(steps(k)));
    r.y.push_back(y[k]);
  }
  return r;
}

}  // namespace

std::vector<StepResponse> step_responses(const Model& m, const LinearLoop& loop,
                                         const std::vector<std::complex<double>>& poles) {
  constexpr double kEnds = 12.0;  // e^-12 of the slowest motion is left at the end
  constexpr int kMost = 45;       // octaves; only a nearly unstable loop needs so many
  const double fastest = largest_size(poles);
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& s : poles) slowest = std::min(slowest, -s.real());
  const double whole = loop.every > 0.0 ? loop.every : 1.0 / (kWhole * fastest);
  const double most = kEnds / (slowest * whole * static_cast<double>(kDense));
  const int octaves = std::clamp(1 + static_cast<int>(std::ceil(std::log2(most))), 1, kMost);

  const Ports ports = ports_of(m, loop.form);
  const Flow flow(loop, ports.input, whole, octaves);
  const Grid grid = grid_of(flow, ports.deflection, octaves);
  // Steady state: x = M x + g.
  const Eigen::Index n = loop.form.a.rows(), p = ports.input.cols();
  const Eigen::MatrixXd stays =
      lu_solve(Eigen::MatrixXd::Identity(n, n) - flow.map(0).topLeftCorner(n, n),
               Eigen::MatrixXd(flow.map(0).topRightCorner(n, p)));
  std::vector<StepResponse> all;
  for (Eigen::Index port = 0; port < p; ++port) {
    const auto widened = [&](const Eigen::MatrixXd& rows) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n + p);
      row.head(n) = rows.row(port);
      return row;
    };
    all.push_back(read(flow, grid, port, widened(ports.deflection), widened(ports.rate),
                       ports.deflection.row(port).dot(stays.col(port))));
  }
  return all;
}

}  // namespace rotorub
