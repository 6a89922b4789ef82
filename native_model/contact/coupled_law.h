// The laws of impact and friction for several contacts on the same bodies. Each law is a coupled
// problem (coupled_problem.h) y = a p + b for the impulses p and the rates y of all contacts,
// solved with a mu of each contact that fits its slips.
#pragma once

#include <span>

#include "native_model/contact/coupled_problem.h"

namespace rotorub {

// Coulomb's law of all contacts. With two rows of b for each contact the contacts are planar; with
// three they have the friction discs of disc_law.h.
CoupledSolution solve_coupled_coulomb(const ContactMatrix& a, const ContactVector& b,
                                      std::span<const ImpactLaw> laws);
// Coulomb's law over a step, (12)-(13), with mu at the slips at its end. before: m/s, slips at the
// start of the step, one for each contact.
CoupledSolution solve_coupled_lasting(const ContactMatrix& a, const ContactVector& b,
                                      std::span<const ImpactLaw> laws,
                                      std::span<const double> before);
// The expansion alone, after a compression with the impulses `compressed`; b: rates after the
// compression.
CoupledSolution solve_coupled_expansion(const ContactMatrix& a, const ContactVector& b,
                                        std::span<const ImpactLaw> laws,
                                        const ContactVector& compressed);
// An instantaneous impact of all contacts: compression, then expansion. b: rates before it; the
// result's p is the sum of both phases.
CoupledSolution solve_coupled_impact(const ContactMatrix& a, const ContactVector& b,
                                     std::span<const ImpactLaw> laws);

}  // namespace rotorub
