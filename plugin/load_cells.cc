#include "plugin/load_cells.h"

#include <algorithm>
#include <string>
#include <type_traits>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/scene/mujoco.h"
#include "plugin/callbacks.h"
#include "plugin/config_cache.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/contact_force.h"
#include "plugin/model/actuators.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

bool carries(const mjModel* m, int body, int geom) {
  int b = m->geom_bodyid[geom];
  while (b > body) b = m->body_parentid[b];
  return b == body;
}

bool is_force(int type) { return type == mjSENS_FORCE || type == mjSENS_TORQUE; }

bool feels(const mjModel* m, int sensor, const ContactPair& pair) {
  if (scene::is_cone(pair.contact_model)) return false;
  const int type = m->sensor_type[sensor];
  if (!is_force(type) && type != mjSENS_TOUCH) return false;
  const int body = m->site_bodyid[m->sensor_objid[sensor]];
  if (is_force(type)) return carries(m, body, pair.rotor_geom) || carries(m, body, pair.ring_geom);
  return pair.contact_model == scene::ContactModel::kRigid &&
         (body == m->geom_bodyid[pair.rotor_geom] || body == m->geom_bodyid[pair.ring_geom]);
}

// MuJoCo's contact sensors show the forces of its own solver.
#if mjVERSION_HEADER >= 335
bool may_be(const mjModel* m, const ContactPair& pair, int type, int id) {
  const auto is = [&](int geom) {
    if (type == mjOBJ_GEOM) return id == geom;
    if (type == mjOBJ_BODY) return id == m->geom_bodyid[geom];
    return type != mjOBJ_XBODY || carries(m, id, geom);
  };
  return is(pair.rotor_geom) || is(pair.ring_geom);
}
bool asks_for_force(const mjModel* m, int sensor, const ContactPair& pair) {
  constexpr int kForces = (1 << mjCONDATA_FORCE) | (1 << mjCONDATA_TORQUE);
  return !scene::is_cone(pair.contact_model) && m->sensor_type[sensor] == mjSENS_CONTACT &&
         (m->sensor_intprm[mjNSENS * sensor] & kForces) &&
         may_be(m, pair, m->sensor_objtype[sensor], m->sensor_objid[sensor]) &&
         may_be(m, pair, m->sensor_reftype[sensor], m->sensor_refid[sensor]);
}
#else
bool asks_for_force(const mjModel*, int, const ContactPair&) { return false; }
#endif

template <typename Model>
bool has_history(const Model* m, int sensor) {
  if constexpr (requires { m->sensor_history; }) return m->sensor_history[2 * sensor] > 0;
  return false;
}

// Negative if the ray from `from` does not meet the site's zone.
template <typename Ray = decltype(&mju_rayGeom)>
double ray_to_site(const mjModel* m, const mjData* d, int site, const mjtNum* from,
                   const mjtNum* along, Ray ray = mju_rayGeom) {
  const mjtNum* place = d->site_xpos + 3 * site;
  const mjtNum* axes = d->site_xmat + 9 * site;
  const mjtNum* size = m->site_size + 3 * site;
  if constexpr (std::is_invocable_v<Ray, const mjtNum*, const mjtNum*, const mjtNum*, const mjtNum*,
                                    const mjtNum*, int, mjtNum*>) {
    return ray(place, axes, size, from, along, m->site_type[site], nullptr);
  } else {
    return ray(place, axes, size, from, along, m->site_type[site]);
  }
}

// The plugin's force on rotor and ring at one contact in this pass.
struct ContactForce {
  ContactPlace place;
  Eigen::Vector2d e_r{0.0, 0.0};
  double normal = 0.0, friction = 0.0, axial = 0.0;  // N, on the rotor along -e_r, e_t and the axis
  bool is_zero() const { return normal == 0.0 && friction == 0.0 && axial == 0.0; }
};

// since: s, time that may have passed since the pass of the force.
ContactForce force_of(const ContactPair& pair, const mjData* d, double since) {
  ContactForce f;
  const ContactEntries& entry = contact_entries(pair, d);
  f.place = contact_place(pair, d);
  if (scene::is_cone(pair.contact_model) || !(f.place.d.norm() > kNoNormal)) return f;
  f.friction = entry.friction_force;
  f.e_r = f.place.d.normalized();
  const bool rigid = pair.contact_model == scene::ContactModel::kRigid;
  if (rigid || pair.further) f.normal = entry.normal_force;
  // Only `rigid` and contacts with friction along the axis record each pass with a force.
  if (!rigid && !pair.axial) return f;
  // Without a normal force there is no friction along the axis; an older note may have one.
  if (!(entry.normal_force > 0.0)) return f;
  const NotedContact* noted = noted_contact(d, pair.userdata);
  // Entries that a copy or a written state brought here have other results.
  if (!noted || noted->normal != entry.normal_force) return f;
  const double passed = d->time - noted->time;
  if (passed != 0.0 && (since == 0.0 || !is_next_step(passed, since, d->time))) return f;
  f.e_r = noted->e_r;
  f.axial = noted->axial;
  return f;
}

// Adds a force and a torque, in the contact's axes, on a body at a point.
void add_wrench(const mjModel* m, mjData* d, int body, const mjtNum* point, const mjtNum* axes,
                const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
  mjtNum wrench[6], turn[3], arm[3];  // wrench: torque about the tree's centre of mass, then force
  mju_mulMatVec(wrench + 3, axes, force.data(), 3, 3);
  mju_mulMatVec(turn, axes, torque.data(), 3, 3);
  mju_sub3(arm, point, d->subtree_com + 3 * m->body_rootid[body]);
  mju_cross(wrench, arm, wrench + 3);
  mju_addTo3(wrench, turn);
  mju_addTo(d->cfrc_ext + 6 * body, wrench, 6);
  for (int b = body; b > 0; b = m->body_parentid[b]) mju_subFrom(d->cfrc_int + 6 * b, wrench, 6);
}

double clipped(const mjModel* m, int sensor, double value, double low) {
  const double cutoff = m->sensor_cutoff[sensor];
  return cutoff > 0.0 ? std::clamp(value, low * cutoff, cutoff) : value;
}

void fill_force(const mjModel* m, mjData* d, int sensor) {
  const int site = m->sensor_objid[sensor], body = m->site_bodyid[site];
  mjtNum local[6];
  mju_transformSpatial(local, d->cfrc_int + 6 * body, 1, d->site_xpos + 3 * site,
                       d->subtree_com + 3 * m->body_rootid[body], d->site_xmat + 9 * site);
  const mjtNum* from = m->sensor_type[sensor] == mjSENS_FORCE ? local + 3 : local;
  for (int i = 0; i < 3; ++i) {
    d->sensordata[m->sensor_adr[sensor] + i] = clipped(m, sensor, from[i], -1.0);
  }
}

void add_touch(const ContactPair& pair, const ContactForce& f, const mjModel* m, mjData* d,
               int sensor) {
  const int site = m->sensor_objid[sensor];
  const bool on_rotor = m->site_bodyid[site] == m->geom_bodyid[pair.rotor_geom];
  mjtNum from[3], along[3];
  for (int i = 0; i < 3; ++i) {
    const double out = f.place.axes[3 * i] * f.e_r.x() + f.place.axes[3 * i + 1] * f.e_r.y();
    from[i] = d->geom_xpos[3 * pair.rotor_geom + i] + pair.contact.radius * out;
    along[i] = on_rotor ? out : -out;
  }
  if (ray_to_site(m, d, site, from, along) < 0.0) return;
  mjtNum& value = d->sensordata[m->sensor_adr[sensor]];
  value = clipped(m, sensor, value + f.normal, 0.0);
}

}  // namespace

void map_load_cells(const mjModel* m, Config& config) {
  bool later = is_preloaded();  // true if the plugin is called after MuJoCo's sensors
  for (int i = 0; i < m->nsensor; ++i) {
    const bool called = m->sensor_type[i] == mjSENS_USER && m->sensor_needstage[i] == mjSTAGE_ACC;
    config.cells_in_callback = config.cells_in_callback || called;
  }
  later = later || config.cells_in_callback;
  for (int i = 0; i < m->nsensor; ++i) {
    for (const ContactPair& pair : config.pairs) {
      const std::string element = message("<sensor name=\"{}\">", m->names + m->name_sensoradr[i]);
      const std::string reason = message(
          "MuJoCo does not see the force of contact model {} in it",
          pair.contact_model == scene::ContactModel::kRigid ? "rigid" : "coulomb (its friction)");
      if (asks_for_force(m, i, pair)) {
        refuse(
            element,
            reason + "; use the user sensors normal_force and friction_force, or name other geoms");
      }
      if (!feels(m, i, pair)) continue;
      config.cells = true;
      if (has_history(m, i)) refuse(element, reason + " if it has a history; set nsample=\"0\"");
      if (later) continue;
      refuse(element, reason +
                          ", and calls the plugin after it only for a user sensor of the "
                          "acceleration stage; add <user name=\"normal_force\" dim=\"1\" "
                          "needstage=\"acc\"/> to <sensor>, or preload the plugin");
    }
  }
}

namespace {

// Adds the force on rotor and ring as J^T does (contact/contact_space.h): at the rotor's centre,
// and at the nearest point of the ring's axis.
void add_wrenches(const ContactPair& pair, const ContactForce& f, const mjModel* m, mjData* d) {
  const Eigen::Vector3d load = contact_load(f.e_r, pair.contact.radius, f.normal, f.friction);
  const Eigen::Vector3d along = f.axial * axial_column(f.e_r, pair.contact.radius);
  const Eigen::Vector3d force(load.x(), load.y(), along.x()),
      torque(along.y(), along.z(), load.z());
  add_wrench(m, d, m->geom_bodyid[pair.rotor_geom], d->geom_xpos + 3 * pair.rotor_geom,
             f.place.axes, force, torque);
  add_wrench(m, d, m->geom_bodyid[pair.ring_geom], f.place.ring_point, f.place.axes, -force,
             -f.place.ring_spin_factor * torque);
}

}  // namespace

void fill_load_cells(const Config& config, const mjModel* m, mjData* d) {
  if (!config.cells) return;
  bool any = false;
  for (const ContactPair& pair : config.pairs) {
    const ContactForce f = force_of(pair, d, 0.0);
    if (f.is_zero()) continue;
    any = true;
    add_wrenches(pair, f, m, d);
    for (int i = 0; i < m->nsensor; ++i) {
      if (m->sensor_type[i] == mjSENS_TOUCH && feels(m, i, pair)) add_touch(pair, f, m, d, i);
    }
  }
  for (int i = 0; any && i < m->nsensor; ++i) {
    if (is_force(m->sensor_type[i]) && !has_history(m, i)) fill_force(m, d, i);
  }
}

namespace {

// MuJoCo's sensors would otherwise use these values, and fill_load_cells would add the forces
// again.
template <typename Data>
void forget_rne(Data* d) {
  if constexpr (requires { d->flg_rnepost; }) d->flg_rnepost = 0;
}

}  // namespace

void rne_post_constraint(const mjModel* m, mjData* d, void (*plain)(const mjModel*, mjData*)) {
  plain(m, d);
  const Config* config = callbacks_active() ? find_config(m, d) : nullptr;
  if (!config) return;
  for (const ContactPair& pair : config->pairs) {
    const ContactForce f = force_of(pair, d, m->opt.timestep);  // also after mj_step
    if (!f.is_zero()) add_wrenches(pair, f, m, d);
  }
  forget_rne(d);
}

void contact_force(const mjModel* m, const mjData* d, int id, mjtNum result[6],
                   void (*plain)(const mjModel*, const mjData*, int, mjtNum*)) {
  plain(m, d, id, result);
  const Config* config =
      callbacks_active() && id >= 0 && id < d->ncon ? find_config(m, d) : nullptr;
  if (!config) return;
  const mjContact& c = d->contact[id];
  for (const ContactPair& pair : config->pairs) {
    const bool regular = c.geom1 == pair.rotor_geom && c.geom2 == pair.ring_geom;
    const bool reverse = c.geom2 == pair.rotor_geom && c.geom1 == pair.ring_geom;
    if (!regular && !reverse) continue;
    const ContactForce f = force_of(pair, d, m->opt.timestep);  // also after mj_step
    // If the geoms change places, e_t and the body that the force acts on both turn round.
    if (pair.contact_model == scene::ContactModel::kRigid || pair.further) result[0] = f.normal;
    if (scene::is_cone(pair.contact_model)) continue;
    result[1] = -f.friction;
    if (result[0] > 0.0) result[2] = regular ? -f.axial : f.axial;
  }
}

}  // namespace rotorub::plugin
