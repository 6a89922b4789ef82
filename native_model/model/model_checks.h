// What of a scene only the model shows to be wrong, and runs that are too large; everything else is
// refused with the scene's file. All of them throw scene::SceneError.
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
// The part of the spin's inertia that the eccentric discs take with them, kg m^2: the largest over
// a turn of b(phi)' M^-1 b(phi), b the rows of M that couple spin and bending. With the sums over
// discs X_k = sum m e shape_x,k exp(i phase), Y_k as well, b_x,k = -Im(X_k e^{i phi}), b_y,k =
// Re(Y_k e^{i phi}):
//   sum (|X_k|^2/m_x,k + |Y_k|^2/m_y,k)/2 + |sum (Y_k^2/m_y,k - X_k^2/m_x,k)|/2
// the largest over time too, as blades are lost. 0 where the spin is held or nothing is eccentric.
double unbalance_inertia(const Model& model);
// M(phi) is positive definite at every angle: the spin's inertia is above unbalance_inertia.
void check_spin_inertia(const scene::Scene& scene, const Model& model);
// With max_frequency the length of these lists is known only now.
void check_initial_lists(const scene::Scene& scene, const Layout& layout);
// A mode with a node at the contact moves the contact point by nothing: that is known only now.
void check_initial_gap(const scene::Scene& scene, const Model& model, std::size_t bearing);
// `euler` and MuJoCo's own step solve an impact in no time. `verlet` knows impacts that
// take time (kUnsampled), but not samples of a controller within one: loads and command are held
// over it.
enum class FiniteImpacts { kNone, kUnsampled };
void refuse_finite_impacts(const scene::Scene& scene, FiniteImpacts accepted);
// `euler` knows rigid contacts alone; `verlet` contacts of which all are rigid or all give.
void refuse_compliance(const scene::Scene& scene, scene::Integrator integrator);
// In MuJoCo `coulomb` and `cone-coulomb` know contacts that give, if all of them do. (MuJoCo's own
// cone is lifted by the slip, so far that a soft one never presses.)
void refuse_compliance_in_mujoco(const scene::Scene& scene);
// MuJoCo's side of several contacts is a segment rotor with rings that nothing drives, without a
// shadow.
void refuse_several_in_mujoco(const scene::Scene& scene);
// Within an electromagnet's core there is no start.
void check_initial_ring(const scene::Scene& scene, std::size_t bearing);

// Whether a run can be done at all is known before its first step. Days of computing on any
// machine.
inline constexpr double kMostRunSteps = 1e10;
// Numbers of a series: 2 GB of memory, 5 GB of text.
inline constexpr double kMostSeriesValues = 2.5e8;

// More than kMostRunSteps of `fixed_step`, s, or samples of the controller.
void check_steps(const scene::Scene& scene, double fixed_step);

// These and the rows of the series. fixed_step: s, absent for an integrator that chooses its own.
// times: of the rows, if they are not those of the scene.
void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times = nullptr);

}  // namespace rotorub
