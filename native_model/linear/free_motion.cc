#include "native_model/linear/free_motion.h"

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "native_model/linear/linear_loop.h"
#include "native_model/model/closed_loop.h"
#include "native_model/model/linear_parts.h"
#include "native_model/model/loads.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;

// Bending with the working integrators of magnetic bearings, which add the force
// -force_per_current j at their stations, with j' = integral sensor^T q. Each such bearing has two
// columns, one per plane.
struct Bending : LinearParts {
  explicit Bending(LinearParts parts) : LinearParts(std::move(parts)) {}
  Eigen::MatrixXd station, sensor;            // 2 n x s
  std::vector<int> stored;                    // s, index among the model's integrals
  std::vector<const StationFeedback*> owner;  // s
};

Bending bending(const Model& m) {
  const Layout& l = m.layout;
  Bending b(linear_parts(m, m.speed));
  b.station = b.sensor = Eigen::MatrixXd::Zero(2 * l.modes, l.feedback_states);
  Eigen::Index at = 0;
  for (const StationFeedback& f : m.feedbacks) {
    if (f.states.stored == kAbsent || !f.works.at(0.0)) continue;
    put_planes(b.station, at, f.shape);
    put_planes(b.sensor, at, f.sensor_shape());
    for (int plane = 0; plane < 2; ++plane) {
      b.stored.push_back(f.states.stored - l.feedback_state() + plane);
      b.owner.push_back(&f);
    }
    at += 2;
  }
  b.station.conservativeResize(Eigen::NoChange, at);
  b.sensor.conservativeResize(Eigen::NoChange, at);
  return b;
}

// Re(load e^{i frequency t}), frequency >= 0.
struct Load {
  double frequency;       // rad/s
  Eigen::VectorXcd load;  // N, 2 n
};

class Loads {
 public:
  explicit Loads(int modes) : modes_(modes) {}
  const std::vector<Load>& all() const { return all_; }

  // x and y: N, complex amplitudes at a station with these mode values.
  void add(double frequency, const ModeShape& shape, Phasor x, Phasor y) {
    Eigen::VectorXcd load(2 * modes_);
    load << x * shape.x.cast<Phasor>(), y * shape.y.cast<Phasor>();
    add({frequency, std::move(load)});
  }
  // Adds amplitude (cos(frequency t + phase), sin(frequency t + phase)); either sign of frequency.
  void turn(double frequency, const ModeShape& shape, double amplitude, double phase) {
    const Phasor x = std::polar(1.0, phase) * amplitude, y = Phasor(0.0, -1.0) * x;
    if (frequency < 0.0) return add(-frequency, shape, std::conj(x), std::conj(y));
    add(frequency, shape, x, y);
  }
  void add(Load load) {
    constexpr double kSame = 1e-12;
    if (load.load.isZero(0.0)) return;
    if (load.frequency == 0.0) load.load = load.load.real().cast<Phasor>().eval();
    for (Load& other : all_) {
      if (std::abs(other.frequency - load.frequency) <= kSame * other.frequency) {
        other.load += load.load;
        return;
      }
    }
    all_.push_back(std::move(load));
  }

 private:
  int modes_;
  std::vector<Load> all_;
};

void add_force(const scene::Scene& scene, const Model& m, const AppliedForce& f, Loads& loads) {
  using scene::ForceKind;
  if (f.on > 0.0 || f.off <= 0.0) return;
  if (f.kind == ForceKind::kPulse && f.on < 0.0) {
    refuse_steady(scene,
                  "a [[force]] of kind pulse is acting at t = 0, so no orbit is steady; let the "
                  "pulse begin at 0 or later");
  }
  if (f.ramp > 0.0 && f.on < 0.0 && f.on + f.ramp > 0.0) {
    refuse_steady(scene,
                  "a [[force]] is still rising at t = 0, so no orbit is steady; let it begin to "
                  "rise at 0 or later, or end its rise by then");
  }
  if (f.kind == ForceKind::kPulse || f.envelope(0.0) == 0.0) return;
  if (f.kind == ForceKind::kConstant) return loads.add(0.0, f.shape, f.vector.x(), f.vector.y());
  double frequency = f.frequency;
  if (f.kind == ForceKind::kSynchronous) frequency = m.speed;
  if (f.kind == ForceKind::kChirp) {
    frequency += (f.frequency_end - f.frequency) * (0.0 - f.on) / (f.off - f.on);
  }
  loads.turn(frequency, f.shape, f.amplitude, f.angle(0.0, m.spin_angle));
}

std::vector<Load> loads_of(const scene::Scene& scene, const Model& m) {
  Loads loads(m.layout.modes);
  for (const AppliedForce& f : m.forces) add_force(scene, m, f, loads);
  for (const DiscUnbalance& u : m.unbalances) {
    if (u.on > 0.0) continue;
    loads.turn(m.speed, u.shape, u.static_moment * m.speed * m.speed, m.spin_angle + u.phase);
  }
  // Weight, and the constant forces of springs and films of bearings off the line.
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(m.nq());
  Eigen::VectorXd constant = m.weight.size() > 0 ? m.weight : rest;
  equations::add_films(m, m.speed, rest.data(), rest.data(), constant.data());
  loads.add({0.0, constant.head(2 * m.layout.modes).cast<Phasor>()});
  return loads.all();
}

// Refuses a rotor with a growing mode: no motion returns to its orbit.
void check_stability(const scene::Scene& scene, const Model& m) {
  constexpr double kScatter = 1e-9;  // of the largest eigenvalue
  const auto values = closed_loop_eigenvalues(closed_loop(m, m.speed));
  if (!values) refuse_steady(scene, "the eigenvalues of the free rotor do not converge");
  const Phasor first = values->front();
  if (first.real() <= kScatter * largest_size(*values)) return;
  refuse_steady(scene, "the free rotor is unstable at " + scene::number_text(m.speed) +
                           " rad/s, a motion at " + scene::number_text(std::abs(first.imag())) +
                           " rad/s grows with " + scene::number_text(first.real()) +
                           " 1/s; stabilise the rotor, or set false");
}

// Adds to z, force over deflection, the effect of filters and lags on the control laws.
void add_lags(const Model& m, double nu, Eigen::MatrixXcd& z) {
  const int n = m.layout.modes;
  for (const StationFeedback& f : m.feedbacks) {
    const bool filters = f.states.filtered != kAbsent, lags = f.states.current != kAbsent;
    if ((!filters && !lags) || !f.works.at(0.0)) continue;
    // Part that the matrices already contain.
    const Phasor has(lags ? 0.0 : f.law.proportional,
                     lags || filters ? 0.0 : nu * f.law.derivative);
    const Phasor missing = f.law.force_per_current * (lag_of(f, nu) * gain_of(f, nu) - has);
    z.topLeftCorner(n, n) += missing * f.shape.x * f.sensor_shape().x.transpose();
    z.block(n, n, n, n) += missing * f.shape.y * f.sensor_shape().y.transpose();
  }
}

// Phasor amplitudes at one frequency: Q (m, 2 n), and the states of the model's feedbacks.
struct Answer {
  Eigen::VectorXcd q, stored;
};
// Sets the states that follow from q and the integrators: filters and amplifiers.
void follow(const Model& m, double nu, Answer& answer) {
  const int n = m.layout.modes, first = m.layout.feedback_state();
  for (const StationFeedback& f : m.feedbacks) {
    if (!f.works.at(0.0)) continue;
    for (int plane = 0; plane < 2; ++plane) {
      const Eigen::VectorXd& shape = plane == 0 ? f.sensor_shape().x : f.sensor_shape().y;
      const Phasor deflection = shape.cast<Phasor>().dot(answer.q.segment(plane * n, n));
      const auto state = [&](int at) -> Phasor& { return answer.stored[at - first + plane]; };
      if (f.states.filtered != kAbsent) {
        state(f.states.filtered) = Phasor(0.0, nu) * filter_of(f, nu) * deflection;
      }
      if (f.states.current == kAbsent) continue;
      const Phasor stored = f.states.stored == kAbsent ? 0.0 : state(f.states.stored);
      state(f.states.current) = -lag_of(f, nu) * (gain_of(f, nu) * deflection + stored);
    }
  }
}
Answer answer(const scene::Scene& scene, const Model& m, const Bending& b, const Load& load) {
  constexpr double kSingular = 1e-12;
  const double nu = load.frequency;
  // Rows and columns are scaled by the size of their terms, so that the diagonal is about 1 away
  // from resonance.
  Eigen::VectorXd scale =
      b.stiffness.diagonal().cwiseAbs() + nu * nu * b.mass + nu * b.damping.diagonal().cwiseAbs();
  for (double& x : scale) x = x > 0.0 ? 1.0 / std::sqrt(x) : 1.0;
  Eigen::MatrixXcd z = dynamic_stiffness(b, nu);
  add_lags(m, nu, z);
  z = (scale.asDiagonal() * z * scale.asDiagonal()).eval();
  // Rows i nu j = I sensor^T q of the integrators, with j in the unit of force of the rows at their
  // stations.
  const Eigen::Index n = b.mass.size(), stored = b.station.cols();
  const Eigen::MatrixXd station = scale.asDiagonal() * b.station,
                        sensor = scale.asDiagonal() * b.sensor;
  const double unit = stored > 0 ? station.cwiseAbs().maxCoeff() : 1.0;
  if (stored > 0) {
    z.conservativeResizeLike(Eigen::MatrixXcd::Zero(n + stored, n + stored));
    z.topRightCorner(n, stored) = (station / unit).cast<Phasor>();
    z.bottomLeftCorner(stored, n) = (sensor / unit).transpose().cast<Phasor>();
  }
  for (Eigen::Index k = 0; k < stored; ++k) {
    const StationFeedback& f = *b.owner[static_cast<std::size_t>(k)];
    z.col(n + k) *= lag_of(f, nu);
    // With F = k_i j: i nu F / (k_i I) - sensor^T q = 0.
    z(n + k, n + k) = Phasor(0.0, -nu / (f.law.force_per_current * f.law.integral * unit * unit));
  }
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(n + stored);
  right.head(n) = scale.asDiagonal() * load.load;
  const ConditionedSolution solved = lu_solve_conditioned(z, right);
  // Compares 1 / |z^-1| with the scaled terms, about 1, and not with |z|, which is small if both
  // planes are in resonance.
  const double size = z.cwiseAbs().colwise().sum().maxCoeff();
  if (!(solved.reciprocal_condition * size > kSingular)) {
    refuse_steady(scene, nu == 0.0
                             ? "nothing holds the rotor against a constant force or its weight"
                             : "a force turns at " + scene::number_text(nu) +
                                   " rad/s, where the free rotor has a resonance without "
                                   "damping: its orbit has no bound");
  }
  Answer answer{scale.asDiagonal() * solved.x.head(n),
                Eigen::VectorXcd::Zero(m.layout.feedback_states)};
  for (std::size_t k = 0; k < b.stored.size(); ++k) {
    answer.stored[b.stored[k]] =
        solved.x[n + static_cast<Eigen::Index>(k)] / (unit * b.owner[k]->law.force_per_current);
  }
  follow(m, nu, answer);
  return answer;
}

// Amplitude of the current that a magnetic bearing's law demands on each axis at one frequency, A.
Eigen::Vector2d current_amplitude(const Model& m, const StationFeedback& feedback, double frequency,
                                  const Answer& answer) {
  const int n = m.layout.modes;
  const Phasor gain = gain_of(feedback, frequency);
  const auto of = [&](const Eigen::VectorXd& shape, int plane) {
    const Phasor stored =
        feedback.states.stored == kAbsent
            ? Phasor(0.0)
            : answer.stored[feedback.states.stored - m.layout.feedback_state() + plane];
    return std::abs(gain * shape.cast<Phasor>().dot(answer.q.segment(plane * n, n)) + stored);
  };
  return {of(feedback.sensor_shape().x, 0), of(feedback.sensor_shape().y, 1)};
}

// A sampled feedback that works at t = 0; null if there is none.
const StationFeedback* sampled(const Model& m) {
  for (const SampledFeedback& s : m.samplers) {
    for (const std::size_t k : s.bearings) {
      if (m.feedbacks[k].works.at(0.0)) return &m.feedbacks[k];
    }
  }
  return nullptr;
}

// Amplitude with sampled feedbacks, which must work always.
Eigen::VectorXcd sampled_amplitude(const scene::Scene& scene, const Model& m, const Load& load) {
  const std::string why = loop_refusal(m), at = " at " + scene::number_text(m.speed) + " rad/s";
  if (!why.empty()) refuse_steady(scene, why);
  const LinearLoop loop = linear_loop(m, m.speed);
  const auto poles = loop_poles(loop);
  if (!poles) refuse_steady(scene, "the eigenvalues of the free rotor do not converge");
  if (poles->empty() || poles->front().real() >= 0.0)
    refuse_steady(scene, "the free rotor is unstable" + at + "; stabilise the rotor");
  if (load.load.isZero(0.0)) return load.load;
  Eigen::VectorXcd q = loop_amplitude(m, loop, load.frequency, load.load);
  if (!q.allFinite()) refuse_steady(scene, "the rotor has a resonance without damping" + at);
  return q;
}

}  // namespace

scene::Scene without_start(scene::Scene scene) {
  // The angle of the shaft at t = 0 is not part of the motion; it sets the phase between unbalance
  // and forces with their own phase.
  const double spin_angle = scene.initial.spin_angle;
  scene.initial = {};
  scene.initial.spin_angle = spin_angle;
  for (scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (at.stator) at.stator->position = at.stator->velocity = {0.0, 0.0};
  }
  return scene;
}

void refuse_steady(const scene::Scene& scene, const std::string& why) {
  scene::refuse_at(scene, "initial.steady", why);
}

FreeMotion free_motion(const scene::Scene& scene, const Model& m) {
  const Layout& l = m.layout;
  if (const StationFeedback* feedback = sampled(m)) {
    refuse_steady(scene,
                  scene::magnetic_bearing_name(scene, feedback->number) +
                      " is sampled, so no orbit is steady; a steady start is not available. Remove "
                      "this key; the run then starts centred and at rest, so let it settle before "
                      "the bearing fails");
  }
  const Bending b = bending(m);
  check_stability(scene, m);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(2 * l.modes);
  FreeMotion motion{rest, rest, Eigen::VectorXd::Zero(l.feedback_states)};
  motion.orbits.resize(m.auxiliary.size());
  motion.current.assign(m.feedbacks.size(), Eigen::Vector2d::Zero());
  for (const Load& load : loads_of(scene, m)) {
    const Answer found = answer(scene, m, b, load);
    const Eigen::VectorXcd& q = found.q;
    motion.q += q.real();
    motion.v += (Phasor(0.0, load.frequency) * q).real();
    motion.stored += found.stored.real();
    for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
      motion.current[k] += current_amplitude(m, m.feedbacks[k], load.frequency, found);
    }
    const Eigen::VectorXd re = q.real(), im = q.imag();
    for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
      const auto c = equations::at_station(l.modes, m.auxiliary[k].shape, re.data());
      const auto s = equations::at_station(l.modes, m.auxiliary[k].shape, im.data());
      motion.orbits[k].parts.push_back({load.frequency, {Phasor(c.x, s.x), Phasor(c.y, s.y)}});
    }
  }
  return motion;
}

Eigen::VectorXcd unbalance_load(const Model& m, double speed) {
  Loads loads(m.layout.modes);
  for (const DiscUnbalance& u : m.unbalances)
    loads.turn(speed, u.shape, u.static_moment * speed * speed, u.phase);
  if (loads.all().empty()) return Eigen::VectorXcd::Zero(2 * m.layout.modes);
  return loads.all().front().load;
}

Eigen::VectorXcd unbalance_amplitude(const scene::Scene& scene, const Model& m) {
  const Load load{std::abs(m.speed), unbalance_load(m, m.speed)};
  if (sampled(m)) return sampled_amplitude(scene, m, load);
  check_stability(scene, m);
  if (load.load.isZero(0.0)) return load.load;
  return answer(scene, m, bending(m), load).q;
}

}  // namespace rotorub
