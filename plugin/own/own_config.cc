#include "plugin/own/own_config.h"

#include <string>
#include <string_view>

#include "mjcf/names.h"
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

// The contact model wants its own kind of pair: MuJoCo must not solve beside `rigid`, nor add
// friction beside `coulomb`.
void check_pair(const mjModel* m, const Config& config) {
  const int pair = config.pair;
  const auto name = [m](int id) { return std::string(m->names + m->name_geomadr[id]); };
  const std::string element = "<contact><pair geom1=\"" + name(config.rotor_geom) + "\" geom2=\"" +
                              name(config.ring_geom) + "\">";
  if (pair < 0) refuse(element, "missing");
  const double clearance = config.model.contact->clearance;
  const double kept_out = m->pair_gap[pair] - m->pair_margin[pair];
  switch (config.contact) {
    case scene::ContactModel::kRigid:
      if (kept_out < 10.0 * clearance) {
        refuse(element,
               "contact model rigid keeps the contact from MuJoCo's solver: accepted: gap "
               "above margin by at least ten clearances");
      }
      return;
    case scene::ContactModel::kCoulomb:
      if (m->pair_dim[pair] != 1) refuse(element, "contact model coulomb: accepted: condim=\"1\"");
      break;
    case scene::ContactModel::kCone:
      break;
  }
  if (m->pair_gap[pair] != 0.0) refuse(element, "accepted: gap=\"0\"");
}

}  // namespace

bool has_own_contact(const mjModel* m) {
  return custom_text(m, names::kOwnRotorGeom) || custom_text(m, names::kOwnRingGeom);
}

void map_own_contact(const mjModel* m, Config& config) {
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
  if (m->nuserdata < names::kUserDataSingle) {
    refuse("<size nuserdata>", "at least " + std::to_string(names::kUserDataSingle) + " needed");
  }
}

}  // namespace rotorub::plugin
