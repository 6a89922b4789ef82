// Checks for errors in a scene that only the model can show, and for runs that are too large; all
// other errors are rejected when the scene file is read. All checks throw scene::SceneError.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/run.h"

namespace rotorub {

void check_size(const scene::Scene& scene, int nq);
void check_unbalances(const scene::Scene& scene, std::size_t count);
// kg m^2, the part of the spin's inertia that moves with the eccentric discs: the largest value of
// b(phi)' M^-1 b(phi) over a turn, where b are the rows of M that couple spin and bending. With the
// sums over discs X_k = sum m e shape_x,k exp(i phase), and Y_k likewise,
// b_x,k = -Im(X_k e^{i phi}), b_y,k = Re(Y_k e^{i phi}), and the largest value is
//   sum (|X_k|^2/m_x,k + |Y_k|^2/m_y,k)/2 + |sum (Y_k^2/m_y,k - X_k^2/m_x,k)|/2
// It is also the largest over time, because blades may be lost. 0 if the spin is prescribed or
// nothing is eccentric.
double unbalance_inertia(const Model& model);
// Checks that M(phi) is positive definite at every angle: the spin's inertia exceeds
// unbalance_inertia().
void check_spin_inertia(const scene::Scene& scene, const Model& model);
// With max_frequency the required length of these lists is known only now.
void check_initial_lists(const scene::Scene& scene, const Layout& layout);
// The start must lie inside the ring, or within twice the clearance if the contact is compliant.
// Only the mode values show this, because a mode with a node at the contact does not move the
// contact point.
void check_initial_gap(const scene::Scene& scene, const Model& model, std::size_t bearing);
// `euler` and MuJoCo's own step need instantaneous impacts (kNone). `verlet` supports impacts with
// a duration, but no controller samples within them (kUnsampled), because it holds loads and
// command constant during an impact.
enum class FiniteImpacts { kNone, kUnsampled };
void refuse_finite_impacts(const scene::Scene& scene, FiniteImpacts accepted);
// `euler` supports only rigid contacts.
void refuse_compliance(const scene::Scene& scene, scene::Integrator integrator);
// `verlet` and `euler` support currents that lag (coil_lag) only with a single contact.
void refuse_lag_with_several(const scene::Scene& scene, const Model& model);
// In MuJoCo, `coulomb` and `cone-coulomb` support compliant contacts if all contacts are compliant.
// (MuJoCo's own cone is lifted by the slip so far that a soft contact stays open.)
void refuse_compliance_in_mujoco(const scene::Scene& scene);
// In MuJoCo, several contacts need passive rings and no shadow; with a cone they also need a
// segment rotor.
void refuse_several_in_mujoco(const scene::Scene& scene);
// A ring cannot start inside the core of an electromagnet.
void check_initial_ring(const scene::Scene& scene, std::size_t bearing);

// Limit on the steps of a run, which would take days on any machine. It is checked before the first
// step.
inline constexpr double kMostRunSteps = 1e10;
// Limit on the numbers of a series: 2 GB of memory, 5 GB of text.
inline constexpr double kMostSeriesValues = 2.5e8;

// Rejects more than kMostRunSteps steps of `fixed_step` (s) or samples of the controller.
void check_steps(const scene::Scene& scene, double fixed_step);

// Does the same as check_steps() and rejects a series that is too large. fixed_step: s, absent for
// an integrator with adaptive steps. times: s, times of the rows if they differ from the scene's.
void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times = nullptr);

}  // namespace rotorub
