#include "native_model/periodic/flow_derivative.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "native_model/model/control_states.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/periodic/contact_gradients.h"
#include "native_model/periodic/impact_derivative.h"

namespace rotorub::periodic {
namespace {

// The differences of fourth order: sum of weight f(y + at eps w) / eps.
struct Node {
  double at, weight;
};
constexpr std::array<Node, 4> kNodes{
    {{-2.0, 1.0 / 12.0}, {-1.0, -8.0 / 12.0}, {1.0, 8.0 / 12.0}, {2.0, -1.0 / 12.0}}};
// eps w relative to the sizes of the state; where a compliant contact has a force, at most
// kOfPenetration of its penetration.
constexpr double kShare = 2e-4, kOfPenetration = 3e-3;
// The steps of the motion may be too long for its variations. They are halved until the error of a
// variation in one stretch is below kStepError of it.
constexpr double kStepError = 3e-11;
constexpr int kMostParts = 64;
constexpr double kFalls = 0.1;
constexpr double kRoundOff = 3e-15;
// Relative to the speeds; an event whose surface is reached more slowly counts as grazing.
constexpr double kGrazing = 1e-10;

// The state at the end of a stretch, before samples that are taken there. A control keeps its
// memory between samples, so the memory is still that of the stretch's start.
std::vector<double> before_samples(const Model& m, const Stretch& stretch, const Stretch& next) {
  std::vector<double> y = next.y;
  const auto keep = [&](int first, int end) {
    std::copy(stretch.y.begin() + m.nq() + first, stretch.y.begin() + m.nq() + end,
              y.begin() + m.nq() + first);
  };
  keep(m.sampled_states(), m.layout.coil());
  keep(m.layout.control_state(), m.nq());
  return y;
}

}  // namespace

FlowDerivative::FlowDerivative(const Model& model, const Eigen::VectorXd& sizes,
                               const EventParameters& parameters)
    : model_(&model),
      parameters_(parameters),
      sizes_(sizes),
      n_(2 * model.nq()),
      system_(model),
      step_(n_ + integral_count(model)),
      y_(static_cast<std::size_t>(step_.size())),
      slope_(y_),
      tolerance_(y_.size(), kInfinity) {
  const Layout& l = model.layout;
  for (int i = 0; i < l.mechanical(); ++i) {
    if (!l.turns(i)) speed_ = std::max(speed_, sizes[model.nq() + i]);
  }
}

void FlowDerivative::set_states(const ContactStates& states) {
  for (std::size_t k = 0; k < states.size(); ++k) system_.set(k, states[k]);
}

Eigen::VectorXd FlowDerivative::slope(double t, const std::vector<double>& y,
                                      const ContactStates& states) {
  set_states(states);
  std::fill(y_.begin(), y_.end(), 0.0);
  std::copy_n(y.begin(), n_, y_.begin());
  system_.derivative(t, y_.data(), slope_.data());
  return Eigen::Map<const Eigen::VectorXd>(slope_.data(), n_);
}

// The eps for which eps w is a small share of the sizes; 0 if w is 0.
double FlowDerivative::share_of(const Eigen::VectorXd& w) const {
  const double size = w.head(n_).cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
  if (!(size > 0.0) || !std::isfinite(size)) return 0.0;
  return share_ / size;
}

// The change of the stretch's end by the change w of its start, in `parts` steps of equal length.
Eigen::VectorXd FlowDerivative::varied(const Stretch& s, const ContactStates& states,
                                       const Eigen::VectorXd& w, int parts) {
  const double before_end = std::nextafter(s.end(), s.t), h = s.length / parts;
  const auto f = [&](double t, const double* y, double* dy) {
    system_.derivative(std::min(t, before_end), y, dy);
  };
  const double eps = share_of(w);
  Eigen::VectorXd to = w.head(n_);
  if (eps == 0.0) return to;
  to.setZero();
  for (const Node& node : kNodes) {
    std::fill(y_.begin(), y_.end(), 0.0);
    for (int i = 0; i < n_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      y_[at] = s.y[at] + node.at * eps * w[i];
    }
    ContactStates changed = states;
    for (std::size_t k = 0; k < changed.size(); ++k) {
      changed[k].hunt_crossley += node.at * eps * w[n_ + static_cast<Eigen::Index>(k)];
    }
    set_states(changed);
    f(s.t, y_.data(), step_.first_slope());
    for (int part = 0; part < parts; ++part) {
      step_.trial(f, s.t + part * h, y_.data(), h, tolerance_.data());
      std::copy_n(step_.end(), y_.size(), y_.begin());
      step_.advance();
    }
    to += node.weight / eps * Eigen::Map<const Eigen::VectorXd>(y_.data(), n_);
  }
  return to;
}

void FlowDerivative::pass(const Stretch& s, const ContactStates& states, Eigen::MatrixXd& w) {
  if (!(s.length > 0.0)) return;
  // A direction that contains all columns.
  Eigen::VectorXd all = Eigen::VectorXd::Zero(w.rows());
  for (Eigen::Index j = 0; j < w.cols(); ++j) all += share_of(w.col(j)) * w.col(j);
  int parts = std::clamp(static_cast<int>(std::ceil(s.length / longest_)), 1, kMostParts);
  Eigen::VectorXd coarse = varied(s, states, all, parts);
  for (double last = kInfinity; parts < kMostParts;) {
    const Eigen::VectorXd fine = varied(s, states, all, 2 * parts);
    const double size = fine.cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
    const double error = (fine - coarse).cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
    // An error that does not fall is round-off.
    const double round_off = kRoundOff / share_;
    if (!(error > std::max(kStepError, round_off) * size) || error > kFalls * last) break;
    if (std::isfinite(last)) longest_ = s.length / parts;
    coarse = fine;
    parts *= 2;
    last = error;
  }
  for (Eigen::Index j = 0; j < w.cols(); ++j) {
    w.col(j).head(n_) = varied(s, states, w.col(j), parts);
  }
}

// Passes the samples that are taken at t (s). before: the state before them.
void FlowDerivative::sample(double t, const std::vector<double>& before, Eigen::MatrixXd& w) {
  const int nq = model_->nq();
  // The changes of all states v by the sample take(q, v), one column per direction.
  const auto changes = [&](const auto& take) {
    const Eigen::Map<const Eigen::VectorXd> y(before.data(), n_);
    Eigen::MatrixXd change = w.middleRows(nq, nq);
    for (Eigen::Index j = 0; j < w.cols(); ++j) {
      const double eps = share_of(w.col(j));
      if (eps == 0.0) continue;
      change.col(j).setZero();
      for (const Node& node : kNodes) {
        Eigen::VectorXd at = y + node.at * eps * w.col(j).head(n_);
        take(at.data(), at.data() + nq);
        change.col(j) += node.weight / eps * at.tail(nq);
      }
    }
    return change;
  };
  const auto put = [&](const Eigen::MatrixXd& change, int first, Eigen::Index count) {
    w.middleRows(nq + first, count) = change.middleRows(first, count);
  };
  for (std::size_t k = 0; k < model_->auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = model_->auxiliary[k];
    if (!has_control_states(at) || !falls_on_sample(at.sample_time, t)) continue;
    const Eigen::MatrixXd change =
        changes([&](const double* q, double* v) { take_control_sample(*model_, k, t, q, v); });
    put(change, at.control_state, control_states(at));
  }
  for (const SampledFeedback& s : model_->samplers) {
    if (!falls_on_sample(s.sample_time, t)) continue;
    const Eigen::MatrixXd change =
        changes([&](const double* q, double* v) { take_sample(*model_, s, t, q, v); });
    put(change, s.command, s.law.ports() * (1 + s.delay));
    put(change, s.state, s.law.states());
  }
}

FlowDerivative::Kind FlowDerivative::kind_of(const Jump& jump, const ContactStates& before) const {
  const ContactState &from = before[jump.contact], &to = jump.states[jump.contact];
  if (from.mode == ContactMode::kSlide) {
    const bool goes_on = to.mode == ContactMode::kSlide && to.slip_sign == from.slip_sign;
    return to.mode == ContactMode::kFree || goes_on ? Kind::kSmooth : Kind::kSlipEnds;
  }
  if (from.mode != ContactMode::kFree || from.in_wall) return Kind::kSmooth;
  if (model_->auxiliary[jump.contact].is_compliant()) return Kind::kTouch;
  // A redundant contact has a force again without an impact, unless its gap had opened.
  const auto half = static_cast<std::ptrdiff_t>(jump.before.size() / 2);
  const bool jumps =
      !std::equal(jump.before.begin() + half, jump.before.end(), jump.after.begin() + half);
  return from.redundant && !jumps ? Kind::kSmooth : Kind::kImpact;
}

double FlowDerivative::approach(const Jump& jump) const {
  const double* y = jump.before.data();
  return -contact_point(*model_, y, y + model_->nq(), jump.contact).gap_rate;
}

// If the jump at the end of stretch `from` is a slow impact of an accumulation: the stretch whose
// jump is the last of the accumulation, which ends in lasting contact; otherwise `from`.
std::size_t FlowDerivative::capture(const MotionRecord& motion, std::size_t from) const {
  const Stretch& first = motion.stretches[from];
  const std::size_t contact = first.jump->contact;
  if (approach(*first.jump) > kCaptured * speed_) return from;
  for (std::size_t i = from; i < motion.stretches.size(); ++i) {
    const Stretch& s = motion.stretches[i];
    if (!s.jump) continue;
    if (s.jump->contact != contact || kind_of(*s.jump, s.states) != Kind::kImpact) return from;
    if (s.jump->states[contact].mode != ContactMode::kFree) return i;
  }
  return from;
}

void FlowDerivative::cross(const Stretch& s, const ContactStates& after, bool captured,
                           Eigen::MatrixXd& w) {
  const Jump& jump = *s.jump;
  const Kind kind = kind_of(jump, s.states);
  if (kind == Kind::kSmooth) return;
  const double t = s.end();
  const ContactGradients gradients(*model_, jump.before, jump.contact);
  const Eigen::VectorXd surface = kind == Kind::kSlipEnds ? gradients.slip() : gradients.gap();
  const Eigen::VectorXd f_before = slope(t, jump.before, s.states);
  const Eigen::VectorXd f_after = slope(t, jump.after, after);
  const double rate = surface.dot(f_before);
  const double scale = surface.cwiseAbs().dot(f_before.cwiseAbs());
  if (!(std::abs(rate) > kGrazing * scale)) {
    grazes_ = true;
    return;
  }
  std::optional<ImpactDerivative> impact;
  if (kind == Kind::kImpact) {
    impact.emplace(*model_, t, jump, s.states, sizes_,
                   captured || -rate < parameters_.zeno_velocity_threshold);
  }
  const auto a_row = n_ + static_cast<Eigen::Index>(jump.contact);
  for (Eigen::Index j = 0; j < w.cols(); ++j) {
    const double dt = -surface.dot(w.col(j).head(n_)) / rate;
    const Eigen::VectorXd on_surface = w.col(j).head(n_) + dt * f_before;
    if (kind == Kind::kTouch) {
      const CompliantLaw& law = model_->auxiliary[jump.contact].contact->compliance;
      const bool by_speed = law.rebound != 0.0 && -rate > CompliantLaw::kLeastSpeed;
      w(a_row, j) =
          by_speed ? law.rebound / (rate * rate) * gradients.gap_rate().dot(on_surface) : 0.0;
    }
    w.col(j).head(n_) = (impact ? impact->along(on_surface) : on_surface) - dt * f_after;
  }
}

// The largest penetration of compliant contacts, relative to the size of a displacement.
double FlowDerivative::deepest(const MotionRecord& motion) const {
  double depth = 0.0;
  for (const Stretch& s : motion.stretches) {
    for (std::size_t k = 0; k < s.states.size(); ++k) {
      if (!model_->auxiliary[k].is_compliant() || s.states[k].mode == ContactMode::kFree) continue;
      const double* y = s.y.data();
      depth = std::max(depth, -contact_point(*model_, y, y + model_->nq(), k).gap);
    }
  }
  return depth / sizes_[0];
}

Eigen::MatrixXd FlowDerivative::along(const MotionRecord& motion,
                                      const Eigen::MatrixXd& directions) {
  grazes_ = false;
  longest_ = kInfinity;
  share_ = kShare;
  const double depth = deepest(motion);
  if (depth > 0.0) share_ = std::min(share_, kOfPenetration * depth);
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(
      n_ + static_cast<Eigen::Index>(model_->auxiliary.size()), directions.cols());
  w.topRows(n_) = directions;
  for (std::size_t i = 0; i < motion.stretches.size(); ++i) {
    const Stretch& s = motion.stretches[i];
    pass(s, s.states, w);
    if (!s.jump) {
      if (i + 1 < motion.stretches.size())
        sample(s.end(), before_samples(*model_, s, motion.stretches[i + 1]), w);
      continue;
    }
    if (kind_of(*s.jump, s.states) != Kind::kImpact) {
      cross(s, s.jump->states, false, w);
      continue;
    }
    const std::size_t last = capture(motion, i);
    const ContactStates& after = motion.stretches[last].jump->states;
    cross(s, after, last != i, w);
    for (; i < last; ++i) pass(motion.stretches[i + 1], after, w);
  }
  return w.topRows(n_);
}

}  // namespace rotorub::periodic
