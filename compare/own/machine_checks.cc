#include "compare/own/machine_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/engine/mujoco_model.h"
#include "mjcf/names.h"
#include "plugin/model/message.h"
#include "plugin/own/own_names.h"

namespace rotorub {

namespace names = mjcf_names;

namespace {

// The degrees of freedom that move a geom.
std::vector<int> dofs_of(const mjModel* m, int geom) {
  std::vector<int> dofs;
  for (int body = m->geom_bodyid[geom]; body > 0; body = m->body_parentid[body]) {
    for (int k = 0; k < m->body_dofnum[body]; ++k) dofs.push_back(m->body_dofadr[body] + k);
  }
  return dofs;
}

bool is_round(int type) {
  return type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER;
}

}  // namespace

void check_keyframes(const mjModel* m) {
  if (m->nkey == 0 || start_keyframe(m) >= 0) return;
  std::string found;
  for (int i = 0; i < m->nkey; ++i) {
    const char* name = mj_id2name(m, mjOBJ_KEY, i);
    found += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", name ? name : "");
  }
  plugin::refuse("<keyframe>",
                 fmt::format("has only {}, but a run starts from the key \"{}\" or \"{}\"; give a "
                             "key one of these names, or remove all keyframes to start at qpos0",
                             found, names::kStartKey, names::kTestKey));
}

void check_contact_texts(const mjModel* m) {
  for (const plugin::PairName& pair : plugin::own_pair_names(m)) {
    const std::string name = pair.of(names::kContactText);
    if (!plugin::own_text(m, name)) plugin::refuse(plugin::own_element(m, name), kNoContactText);
  }
}

void check_starts(const mjModel* m, const plugin::Config& config) {
  constexpr double kRounding = 1e-9;  // share of the clearance
  const MujocoData start = make_start(m);
  mj_kinematics(m, start.get());
  for (const plugin::ContactPair& pair : config.pairs) {
    const mjtNum* axes = start->geom_xmat + 9 * pair.ring_geom;
    double in_plane[2] = {};
    for (int i = 0; i < 3; ++i) {
      const mjtNum apart =
          start->geom_xpos[3 * pair.rotor_geom + i] - start->geom_xpos[3 * pair.ring_geom + i];
      for (int k = 0; k < 2; ++k) in_plane[k] += axes[3 * i + k] * apart;
    }
    const double distance = std::hypot(in_plane[0], in_plane[1]);
    if (distance <= pair.contact.clearance * (1.0 + kRounding)) continue;
    const int key = start_keyframe(m);
    const char* name = key >= 0 ? mj_id2name(m, mjOBJ_KEY, key) : nullptr;
    plugin::refuse(
        fmt::format("<geom name=\"{}\">", m->names + m->name_geomadr[pair.rotor_geom]),
        fmt::format("in {} the rotor is {:.6g} m from the centre of its ring, geom \"{}\", but the "
                    "clearance is {:.6g} m; move the body or {}",
                    name ? fmt::format("the keyframe \"{}\"", name) : std::string("qpos0"),
                    distance, m->names + m->name_geomadr[pair.ring_geom], pair.contact.clearance,
                    name ? "change the keyframe" : "add a keyframe \"start\""));
  }
}

void check_equalities(const mjModel* m, const plugin::Config& config) {
  if (m->neq == 0) return;
  const MujocoData start = make_start(m);
  mj_fwdPosition(m, start.get());
  std::vector<mjtNum> rate(static_cast<std::size_t>(m->nv)),
      rows(static_cast<std::size_t>(start->nefc));
  for (const plugin::ContactPair& pair : config.pairs) {
    for (const int geom : {pair.rotor_geom, pair.ring_geom}) {
      for (const int dof : dofs_of(m, geom)) {
        std::fill(rate.begin(), rate.end(), 0.0);
        rate[static_cast<std::size_t>(dof)] = 1.0;
        mj_mulJacVec(m, start.get(), rows.data(), rate.data());
        for (int i = 0; i < start->nefc; ++i) {
          if (start->efc_type[i] != mjCNSTR_EQUALITY || rows[static_cast<std::size_t>(i)] == 0.0)
            continue;
          const int id = start->efc_id[i];
          const char* name = mj_id2name(m, mjOBJ_EQUALITY, id);
          plugin::refuse(
              name && *name ? fmt::format("<equality> \"{}\"", name)
                            : fmt::format("<equality> number {}", id + 1),
              fmt::format(
                  "acts on {}, which moves geom \"{}\": the native model has no constraints, so it "
                  "would be a different machine; replace the equality by a motor or a stiffness on "
                  "the joint itself, or replace a weld by removing that joint",
                  plugin::joint_of_dof(m, dof), m->names + m->name_geomadr[geom]));
        }
      }
    }
  }
}

void add_drawn_clearances(const mjModel* m, const plugin::Config& config,
                          std::vector<std::string>& limits) {
  constexpr double kAlike = 0.01;
  for (const plugin::ContactPair& pair : config.pairs) {
    const int rotor = pair.rotor_geom, ring = pair.ring_geom;
    if (!is_round(m->geom_type[rotor]) || !is_round(m->geom_type[ring])) continue;
    const double drawn = m->geom_size[3 * ring] - m->geom_size[3 * rotor];
    const double clearance = pair.contact.clearance;
    if (std::abs(drawn - clearance) <= kAlike * clearance) continue;
    limits.push_back(fmt::format(
        "the drawn shapes of geoms \"{}\" and \"{}\": their radii differ by {:.6g} m, but both "
        "sides use the clearance of {:.6g} m",
        m->names + m->name_geomadr[rotor], m->names + m->name_geomadr[ring], drawn, clearance));
  }
}

}  // namespace rotorub
