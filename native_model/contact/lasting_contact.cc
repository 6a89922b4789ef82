#include "native_model/contact/lasting_contact.h"

#include <cmath>

namespace rotorub {
namespace {

// The smaller N > 0 of |p + N g| = clearance, from outside; negative: g does not lead back.
double reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g, double clearance) {
  const double a = g.squaredNorm(), b = p.dot(g), c = p.squaredNorm() - clearance * clearance;
  if (!(b < 0.0)) return -1.0;
  const double square = b * b - a * c;
  // Too deep for this direction: the nearest point of the line.
  return square > 0.0 ? c / (std::sqrt(square) - b) : -b / a;
}

class Solver {
 public:
  explicit Solver(const LastingStep& s)
      : s_(s),
        e_(s.d.normalized()),
        end_(s.d + s.h * s.free.head<2>()),
        along_normal_(s.admittance * contact_load(e_, s.radius, 1.0, 0.0)),
        along_friction_(s.admittance * contact_load(e_, s.radius, 0.0, 1.0)) {}

  double slip(const Eigen::Vector3d& velocity) const {
    return -e_.y() * velocity.x() + e_.x() * velocity.y() + s_.radius * velocity.z();
  }

  struct Candidate {
    bool holds = false;
    double normal = 0.0, friction = 0.0;
    double slip = 0.0;  // at the end
  };
  // T = ratio N.
  Candidate slide(double ratio) const {
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const double normal = reach_circle(end_, s_.h * g.head<2>(), s_.clearance);
    return {normal > 0.0, normal, ratio * normal, slip(s_.free + normal * g)};
  }
  // A slip of 0 at the end: T = T_0 + T_1 N.
  Candidate stick() const {
    const double compliance = slip(along_friction_);
    const double constant = -slip(s_.free) / compliance, ratio = -slip(along_normal_) / compliance;
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const Eigen::Vector2d end = end_ + s_.h * constant * along_friction_.head<2>();
    const double normal = reach_circle(end, s_.h * g.head<2>(), s_.clearance);
    return {normal > 0.0, normal, constant + ratio * normal, 0.0};
  }

  LastingResult solve() const {
    LastingResult out;
    out.solutions = 0;
    const auto take = [&out](ContactCase found, const Candidate& c) {
      if (out.solutions++ > 0) return;
      out.contact_case = found;
      out.normal = c.normal;
      out.friction = c.friction;
    };
    const double mu = s_.friction;
    const Candidate plus = slide(-mu);
    if (plus.holds && plus.slip > 0.0) take(ContactCase::kSlidePositive, plus);
    const Candidate minus = slide(mu);
    if (minus.holds && minus.slip < 0.0) take(ContactCase::kSlideNegative, minus);
    const Candidate rest = stick();
    const double margin = mu * rest.normal - std::abs(holding(rest));
    // Between the two ways of sliding there is no gap but for round-off.
    const bool between = plus.holds && minus.holds && out.solutions == 0;
    if (rest.holds && (margin >= 0.0 || between) &&
        (out.solutions == 0 || margin > 1e-9 * mu * rest.normal)) {
      take(ContactCase::kStick, rest);
    }
    if (out.solutions == 1) reverse(out);
    return out;
  }

 private:
  // The share of the step after which a slip that friction brakes comes to 0; 1: none does.
  double braking_time() const {
    const double before = slip(s_.start);
    if (before == 0.0) return 0.0;
    const Candidate through = slide(before > 0.0 ? -s_.friction : s_.friction);
    if (!through.holds || through.slip * before > 0.0) return 1.0;
    return before / (before - through.slip);
  }
  // Of a step that ends sticking: the friction that holds the slip at 0 once it has come to 0, as an
  // impulse over a whole step.
  double holding(const Candidate& rest) const {
    const double share = braking_time(), before = slip(s_.start);
    if (share <= 0.0 || share >= 1.0) return rest.friction;
    const double braking = (before > 0.0 ? -1.0 : 1.0) * s_.friction * rest.normal;
    return (rest.friction - share * braking) / (1.0 - share);
  }
  // The slip of the step before had the other sign: friction has been -mu sign N until it was 0.
  void reverse(LastingResult& out) const {
    if (out.contact_case == ContactCase::kStick) return;
    const double sign = out.contact_case == ContactCase::kSlidePositive ? 1.0 : -1.0;
    if (slip(s_.start) * sign >= 0.0) return;
    const double share = braking_time();
    if (share >= 1.0) return;
    const Candidate mean = slide(s_.friction * sign * (2.0 * share - 1.0));
    if (!mean.holds) return;
    out.normal = mean.normal;
    out.friction = mean.friction;
  }

  const LastingStep& s_;
  Eigen::Vector2d e_, end_;
  Eigen::Vector3d along_normal_, along_friction_;
};

}  // namespace

LastingResult solve_lasting_contact(const LastingStep& step) { return Solver(step).solve(); }

}  // namespace rotorub
