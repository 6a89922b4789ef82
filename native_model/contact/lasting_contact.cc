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
    // Where friction can carry more than the normal row, the laws need not have one solution.
    const double nn = -e_.dot(along_normal_.head<2>()), nt = -e_.dot(along_friction_.head<2>());
    return s_.friction * std::abs(nt) < nn ? unique() : enumerate();
  }

 private:
  static LastingResult result(ContactCase found, const Candidate& c) {
    return {c.normal, c.friction, found, c.holds ? 1 : 0};
  }
  static ContactCase sliding(double sign) {
    return sign > 0.0 ? ContactCase::kSlidePositive : ContactCase::kSlideNegative;
  }

  LastingResult unique() const {
    const double before = slip(s_.start), mu = s_.friction;
    const Candidate rest = stick();
    if (before == 0.0) {
      if (std::abs(rest.friction) <= mu * rest.normal) return result(ContactCase::kStick, rest);
      const double sign = rest.friction > 0.0 ? -1.0 : 1.0;
      return result(sliding(sign), slide(-mu * sign));
    }
    const double sign = before > 0.0 ? 1.0 : -1.0;
    const Candidate through = slide(-mu * sign);
    if (through.slip * sign > 0.0) return result(sliding(sign), through);
    // Friction brakes until the slip is 0; the force that then holds it there, over a whole step.
    const double share = before / (before - through.slip);
    const double hold = (rest.friction + share * sign * mu * rest.normal) / (1.0 - share);
    if (share >= 1.0 || hold * sign <= mu * rest.normal) return result(ContactCase::kStick, rest);
    return result(sliding(-sign), slide(mu * sign * (1.0 - 2.0 * share)));
  }

  LastingResult enumerate() const {
    LastingResult out;
    out.solutions = 0;
    const auto take = [&out](ContactCase found, const Candidate& c) {
      if (out.solutions++ == 0) {
        out.contact_case = found;
        out.normal = c.normal;
        out.friction = c.friction;
      }
    };
    const double mu = s_.friction;
    if (const Candidate c = slide(-mu); c.holds && c.slip > 0.0) {
      take(ContactCase::kSlidePositive, c);
    }
    if (const Candidate c = slide(mu); c.holds && c.slip < 0.0) take(ContactCase::kSlideNegative, c);
    if (const Candidate c = stick(); c.holds && std::abs(c.friction) <= mu * c.normal) {
      take(ContactCase::kStick, c);
    }
    return out;
  }

  const LastingStep& s_;
  Eigen::Vector2d e_, end_;
  Eigen::Vector3d along_normal_, along_friction_;
};

}  // namespace

LastingResult solve_lasting_contact(const LastingStep& step) { return Solver(step).solve(); }

}  // namespace rotorub
