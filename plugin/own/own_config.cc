#include "plugin/own/own_config.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "mjcf/names.h"
#include "mjcf/soft_contact.h"
#include "native_model/scene/diagnostic.h"
#include "plugin/message.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

std::string text_element(const char* name) {
  return "<custom><text name=\"" + std::string(name) + "\">";
}

const mjtNum* numeric(const mjModel* m, const char* name) {
  const int id = mj_name2id(m, mjOBJ_NUMERIC, name);
  return id < 0 ? nullptr : m->numeric_data + m->numeric_adr[id];
}

struct Range {
  double low, high;
  bool open_below;  // low itself is refused
  const char* text;
};
constexpr Range kLength{0.0, 1e300, true, "> 0"};
constexpr Range kCoefficient{0.0, 1e300, false, ">= 0"};
constexpr Range kShare{0.0, 1.0, false, "between 0 and 1"};

double checked(const char* name, double value, const Range& range) {
  const bool below = range.open_below ? !(value > range.low) : !(value >= range.low);
  if (below || !(value <= range.high)) {
    refuse("<custom><numeric name=\"" + std::string(name) + "\">",
           std::to_string(value) + "; accepted: " + range.text);
  }
  return value;
}

double value_or(const mjModel* m, const char* name, double otherwise, const Range& range) {
  const mjtNum* given = numeric(m, name);
  return checked(name, given ? *given : otherwise, range);
}

int geom(const mjModel* m, const char* text) {
  const char* name = custom_text(m, text);
  if (!name) refuse(text_element(text), "missing, but the other geom of the contact is named");
  const int id = mj_name2id(m, mjOBJ_GEOM, name);
  if (id < 0) refuse(text_element(text), "no geom is called \"" + std::string(name) + "\"");
  const int type = m->geom_type[id];
  if (type < mjGEOM_SPHERE || type > mjGEOM_BOX) {
    refuse("<geom name=\"" + std::string(name) + "\">",
           "as rotor or ring, accepted types: sphere, capsule, ellipsoid, cylinder, box");
  }
  return id;
}

// Nothing of ours may be misspelt: it would count as not given.
void check_names(const mjModel* m) {
  static constexpr std::string_view kTexts[] = {names::kSceneText, names::kContactText,
                                                names::kOwnRotorGeom, names::kOwnRingGeom};
  static constexpr std::string_view kNumbers[] = {names::kOwnClearance,   names::kOwnRadius,
                                                  names::kOwnFriction,    names::kOwnRestitution,
                                                  names::kOwnTangential,  names::kOwnWidth};
  const auto check = [](std::string_view name, std::span<const std::string_view> known,
                        const char* kind) {
    if (!name.starts_with(names::kOwnPrefix)) return;
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    const std::string_view meant = scene::nearest(name, known);
    refuse("<custom><" + std::string(kind) + " name=\"" + std::string(name) + "\">",
           (meant.empty() ? "unknown" : "unknown, did you mean \"" + std::string(meant) + "\"?") +
               "; accepted: " + scene::join(known));
  };
  for (int i = 0; i < m->ntext; ++i) check(m->names + m->name_textadr[i], kTexts, "text");
  for (int i = 0; i < m->nnumeric; ++i) check(m->names + m->name_numericadr[i], kNumbers, "numeric");
}

std::string pair_element(const mjModel* m, const Config& config) {
  const auto name = [m](int id) { return std::string(m->names + m->name_geomadr[id]); };
  return "<contact><pair geom1=\"" + name(config.rotor_geom) + "\" geom2=\"" +
         name(config.ring_geom) + "\">";
}

// MuJoCo's solver bounces by solref; what <custom> says must be that.
void check_bounce(const mjModel* m, const Config& config) {
  constexpr double kScatter = 0.03;  // what MuJoCo's steps make of it is not finer
  if (config.model.contact->tangential_restitution > 0.0) {
    refuse(std::string("<custom><numeric name=\"") + names::kOwnTangential + "\">",
           "contact models coulomb and cone have none; accepted: 0, or contact model rigid");
  }
  if (!numeric(m, names::kOwnRestitution)) return;
  const double wanted = config.model.contact->restitution;
  const mjtNum* solref = m->pair_solref + mjNREF * config.pair;
  const bool direct = solref[0] <= 0.0;
  const double zeta = direct ? -solref[1] / (2.0 * std::sqrt(-solref[0])) : solref[1];
  const double met = soft_restitution(zeta);
  if (std::abs(met - wanted) <= kScatter) return;
  const SoftContact soft = soft_contact(wanted, m->opt.timestep);
  refuse(pair_element(m, config),
         "solref bounces with " + std::to_string(met) + ", " + names::kOwnRestitution + " is " +
             std::to_string(wanted) + "; accepted: solref=\"" + std::to_string(-soft.stiffness) +
             " " + std::to_string(-soft.damping) + "\" solimp=\"0.9999 0.9999 0.001\"");
}

void check_cone(const mjModel* m, const Config& config) {
  for (const char* name : {names::kNormalForce, names::kFrictionForce}) {
    const int id = mj_name2id(m, mjOBJ_SENSOR, name);
    if (id < 0 || m->sensor_type[id] != mjSENS_USER || m->sensor_needstage[id] == mjSTAGE_ACC) continue;
    refuse("<user name=\"" + std::string(name) + "\">",
           "contact model cone: the force is found by MuJoCo's solver; accepted: needstage=\"acc\"");
  }
  const double mu = config.model.contact->friction, given = m->pair_friction[5 * config.pair];
  if (mu > 0.0 && m->pair_dim[config.pair] < 3) {
    refuse(pair_element(m, config),
           "contact model cone with friction: accepted: condim=\"3\" or more");
  }
  if (m->pair_dim[config.pair] >= 3 && std::abs(given - mu) > 1e-9 + mjMINMU) {
    refuse(pair_element(m, config), "friction is " + std::to_string(given) + ", " +
                                        names::kOwnFriction + " is " + std::to_string(mu) +
                                        "; accepted: one value in both");
  }
}

// The contact model wants its own kind of pair: MuJoCo must not solve beside `rigid`, nor add
// friction beside `coulomb`.
void check_pair(const mjModel* m, const Config& config) {
  const int pair = config.pair;
  const std::string element = pair_element(m, config);
  if (pair < 0) refuse(element, "missing");
  const double clearance = config.model.contact->clearance;
  const double kept_out = m->pair_gap[pair] - m->pair_margin[pair];
  if (config.contact == scene::ContactModel::kRigid) {
    if (kept_out >= 10.0 * clearance) return;
    refuse(element,
           "contact model rigid keeps the contact from MuJoCo's solver: accepted: gap "
           "above margin by at least ten clearances");
  }
  if (m->pair_gap[pair] != 0.0) refuse(element, "accepted: gap=\"0\"");
  if (config.contact == scene::ContactModel::kCoulomb) {
    if (m->pair_dim[pair] != 1) refuse(element, "contact model coulomb: accepted: condim=\"1\"");
  } else {
    check_cone(m, config);
  }
  check_bounce(m, config);
}

// Half the length of a geom along the contact's axis, where its shape has one; else `otherwise`.
double half_length(const mjModel* m, int geom, double otherwise) {
  const mjtNum* size = m->geom_size + 3 * geom;
  switch (m->geom_type[geom]) {
    case mjGEOM_CYLINDER:
    case mjGEOM_CAPSULE:
      return size[1];
    case mjGEOM_BOX:
      return size[2];
    default:
      return otherwise;
  }
}

}  // namespace

bool has_own_contact(const mjModel* m) {
  const auto ours = [m](int address) {
    return std::string_view(m->names + address).starts_with(names::kOwnPrefix);
  };
  return std::any_of(m->name_textadr, m->name_textadr + m->ntext, ours) ||
         std::any_of(m->name_numericadr, m->name_numericadr + m->nnumeric, ours);
}

void refuse_own_beside_scene(const mjModel* m) {
  check_names(m);
  for (const char* name : {names::kOwnRotorGeom, names::kOwnRingGeom}) {
    if (custom_text(m, name)) refuse(text_element(name), "beside a scene's text; accepted: one");
  }
  for (int i = 0; i < m->nnumeric; ++i) {
    const std::string name = m->names + m->name_numericadr[i];
    if (!name.starts_with(names::kOwnPrefix)) continue;
    refuse("<custom><numeric name=\"" + name + "\">",
           "the scene's text has its own; accepted: the value in the scene");
  }
}

void map_own_contact(const mjModel* m, Config& config) {
  check_names(m);
  config.own = true;
  config.contact = contact_model(m, scene::ContactModel::kRigid);
  config.rotor_geom = geom(m, names::kOwnRotorGeom);
  config.ring_geom = geom(m, names::kOwnRingGeom);
  if (config.rotor_geom == config.ring_geom) {
    refuse(text_element(names::kOwnRingGeom), "is the rotor's geom");
  }
  if (!numeric(m, names::kOwnClearance)) {
    refuse("<custom><numeric name=\"" + std::string(names::kOwnClearance) + "\">", "missing");
  }
  ContactParameters c{};
  c.clearance = value_or(m, names::kOwnClearance, 0.0, kLength);
  config.radius_is_drawn = !numeric(m, names::kOwnRadius);
  c.radius = value_or(m, names::kOwnRadius, m->geom_size[3 * config.rotor_geom], kLength);
  c.friction = value_or(m, names::kOwnFriction, 0.0, kCoefficient);
  c.restitution = value_or(m, names::kOwnRestitution, 0.0, kShare);
  c.tangential_restitution = value_or(m, names::kOwnTangential, 0.0, kShare);
  config.model.contact = c;
  config.pair = find_pair(m, config.rotor_geom, config.ring_geom);
  check_pair(m, config);
  config.reach = half_length(m, config.rotor_geom, 0.0) +
                 (numeric(m, names::kOwnWidth)
                      ? 0.5 * value_or(m, names::kOwnWidth, 0.0, kLength)
                      : half_length(m, config.ring_geom, 1e300));
  if (m->nuserdata < names::kUserDataSingle) {
    refuse("<size nuserdata>", "at least " + std::to_string(names::kUserDataSingle) + " needed");
  }
}

}  // namespace rotorub::plugin
