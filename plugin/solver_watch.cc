#include "plugin/solver_watch.h"

#include <algorithm>

#include "plugin/contact/contact_status.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

bool solves(const Config& config, const mjModel* m, const mjContact& c) {
  if (c.efc_address < 0) return false;
  const auto is = [&c](int geom1, int geom2) { return are_geoms(geom1, geom2, c.geom1, c.geom2); };
  return std::any_of(config.pairs.begin(), config.pairs.end(),
                     [&](const ContactPair& p) { return is(p.rotor_geom, p.ring_geom); }) ||
         std::any_of(config.corrected_pairs.begin(), config.corrected_pairs.end(),
                     [&](int p) { return is(m->pair_geom1[p], m->pair_geom2[p]); });
}

}  // namespace

void watch_solver(const Config& config, const mjModel* m, mjData* d) {
  ContactStatus status(model_entries(config, d).contact.status);
  if (!status.has(kInSolver) || status.has(kSolverWarned)) return;
  // MuJoCo's default tolerance. With a smaller one the solver may stop at round-off.
  constexpr double kMatters = 1e-8;
  const double left = unconverged(m, d);
  if (!(left > kMatters)) return;
  status.set(kSolverWarned, true);
  // Newton stops improving at round-off, which a tiny tolerance never accepts.
  const char* remedy = m->opt.solver != mjSOL_NEWTON ? "allow more iterations, or use "
                                                       "solver=\"Newton\""
                       : m->opt.tolerance < kMatters
                           ? "set the default tolerance, 1e-8"
                           : "allow more iterations or a larger tolerance";
  warn(message(
           "rotorub: MuJoCo's solver stopped at iterations=\"{}\" at t = {} s, in a step with a "
           "contact of the plugin; its last iteration still improved by {} (tolerance {}), so the "
           "contact force of that step is inexact; {}",
           m->opt.iterations, d->time, left, m->opt.tolerance, remedy)
           .c_str());
}

void note_solved_contacts(const Config& config, const mjModel* m, mjData* d) {
  const bool any = (config.has_soft() || !config.corrected_pairs.empty()) &&
                   std::any_of(d->contact, d->contact + d->ncon,
                               [&](const mjContact& c) { return solves(config, m, c); });
  ContactStatus status(model_entries(config, d).contact.status);
  if (any != status.has(kInSolver)) status.set(kInSolver, any);
}

}  // namespace rotorub::plugin
