#include "native_model/contact/coupled_law.h"

#include "native_model/contact/disc_law.h"
#include "native_model/contact/impact_friction.h"

namespace rotorub {
namespace {

// The slip of contact i in a vector of all contacts; with two tangential directions, its magnitude.
double slip_among(const ContactVector& y, std::size_t contacts, std::size_t i) {
  const Eigen::Index rows = y.size() / static_cast<Eigen::Index>(contacts);
  const Eigen::Index at = rows * static_cast<Eigen::Index>(i);
  return rows == 3 ? y.segment<2>(at + 1).norm() : y[at + 1];
}

// The expansion after `compressed` (0: Coulomb's law alone). The mu of each contact is improved
// until it fits the slips: improve(friction, normal impulse, impulse along the slip, slip,
// mobility).
template <typename Friction, typename Improve>
CoupledSolution solve_with_friction(const ContactMatrix& a, const ContactVector& b,
                                    std::span<const ImpactLaw> laws,
                                    const ContactVector& compressed,
                                    std::array<Friction, kMaxContacts>& friction, Improve improve) {
  std::array<ContactSet, kMaxContacts> sets{};
  std::array<DiscSet, kMaxContacts> discs{};
  const std::size_t n = laws.size();
  const auto rows = b.size() / static_cast<Eigen::Index>(n);
  for (;;) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = rows * static_cast<Eigen::Index>(i);
      const double mu = friction[i].mu();
      if (rows == 3) {
        discs[i] = expansion_disc(laws[i], mu, compressed[at], compressed.segment<2>(at + 1));
      } else {
        sets[i] = expansion_set(laws[i], mu, compressed[at], compressed[at + 1]);
      }
    }
    const CoupledSolution s = rows == 3 ? solve_discs(a, b, std::span(discs).first(n))
                                        : solve_coupled(a, b, std::span(sets).first(n));
    bool improved = false;
    for (std::size_t i = 0; i < n && s.is_unique(); ++i) {
      const auto at = rows * static_cast<Eigen::Index>(i);
      const double along_slip = rows == 3 ? -friction[i].mu() * s.p[at] : s.p[at + 1];
      improved =
          improve(friction[i], s.p[at], along_slip, slip_among(s.y, n, i), a(at + 1, at + 1)) ||
          improved;
    }
    if (!improved) return s;
  }
}

}  // namespace

CoupledSolution solve_coupled_coulomb(const ContactMatrix& a, const ContactVector& b,
                                      std::span<const ImpactLaw> laws) {
  return solve_coupled_expansion(a, b, laws, ContactVector::Zero(b.size()));
}

CoupledSolution solve_coupled_expansion(const ContactMatrix& a, const ContactVector& b,
                                        std::span<const ImpactLaw> laws,
                                        const ContactVector& compressed) {
  std::array<ImpactFriction, kMaxContacts> friction;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    friction[i] = {laws[i].friction, slip_among(b, laws.size(), i)};
  }
  return solve_with_friction(
      a, b, laws, compressed, friction,
      [](ImpactFriction& mu, double normal, double rubbed, double slip, double mobility) {
        return mu.improve(normal, rubbed, slip, mobility);
      });
}

CoupledSolution solve_coupled_lasting(const ContactMatrix& a, const ContactVector& b,
                                      std::span<const ImpactLaw> laws,
                                      std::span<const double> before) {
  std::array<SlipFriction, kMaxContacts> friction;
  for (std::size_t i = 0; i < laws.size(); ++i) friction[i] = {laws[i].friction, before[i]};
  return solve_with_friction(a, b, laws, ContactVector::Zero(b.size()), friction,
                             [](SlipFriction& mu, double normal, double, double slip,
                                double mobility) { return mu.improve(slip, mobility * normal); });
}

CoupledSolution solve_coupled_impact(const ContactMatrix& a, const ContactVector& b,
                                     std::span<const ImpactLaw> laws) {
  if (laws.size() == 1 && b.size() == 2 && moves_both_ways(a)) {
    const ImpactResult r = solve_impact({a(0, 0), a(0, 1), a(1, 0), a(1, 1)}, b[0], b[1], laws[0]);
    CoupledSolution s;
    s.solutions = r.status == Status::kOk ? 1 : r.status == Status::kNoSolution ? 0 : 2;
    s.p = Eigen::Vector2d(r.normal(), r.friction());
    s.y = Eigen::Vector2d(r.gap_rate, r.slip);
    s.sticks[0] = r.slip == 0.0;
    return s;
  }
  const CoupledSolution c = solve_coupled_coulomb(a, b, laws);
  if (!c.is_unique()) return c;
  CoupledSolution e = solve_coupled_expansion(a, c.y, laws, c.p);
  e.p += c.p;
  return e;
}

}  // namespace rotorub
