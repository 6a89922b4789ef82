#include "plugin/own/own_config.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "native_model/contact/coupled_law.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/model/contact_sensors.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"
#include "plugin/own/own_names.h"
#include "plugin/own/pair_checks.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

struct Range {
  double low, high;
  bool open_below;  // true: `low` itself is refused
  const char* text;
};
constexpr Range kLength{0.0, 1e300, true, "> 0"};
constexpr Range kCoefficient{0.0, 1e300, false, ">= 0"};
constexpr Range kShare{0.0, 1.0, false, "between 0 and 1"};

double value_or(const mjModel* m, const std::string& name, double otherwise, const Range& range) {
  const double value = own_value(m, name).value_or(otherwise);
  const bool below = range.open_below ? !(value > range.low) : !(value >= range.low);
  if (below || !(value <= range.high)) {
    refuse(own_element(m, name), message("{} must be {}", value, range.text));
  }
  return value;
}

// One number mu, or static, kinetic, Stribeck speed and viscous part, as in [contact.friction] of a
// scene.
FrictionLaw own_friction(const mjModel* m, const std::string& name) {
  const std::optional<OwnNumber> said = own_number(m, name);
  if (!said || said->size == 1) return value_or(m, name, 0.0, kCoefficient);
  if (said->size != 4) {
    refuse(own_element(m, name),
           message("has {} numbers; give one, or four: static, kinetic, Stribeck speed, viscous",
                   said->size));
  }
  const std::array<mjtNum, 4>& given = said->values;
  FrictionLaw law = given[0];
  law.coefficient = given[1];
  law.excess = given[0] - given[1];
  law.stribeck_speed = given[2];
  law.viscous = given[3];
  const bool bounded =
      std::ranges::all_of(given, [](double value) { return value <= kCoefficient.high; });
  if (!(bounded && given[1] >= 0.0 && law.excess >= 0.0 && given[2] > 0.0 && given[3] >= 0.0)) {
    refuse(own_element(m, name),
           message("{} {} {} {} is not a friction law; give one number, or static, kinetic >= 0 "
                   "and at most static, Stribeck speed > 0, viscous >= 0",
                   given[0], given[1], given[2], given[3]));
  }
  return law;
}

// Half the length of a geom along the contact's axis if its shape has one; else `otherwise`.
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

// Each further contact must have all the names of the first one: a missing name does not mean 0,
// because the first contact's number may have been meant for all.
void check_series(const mjModel* m, const PairName& name, Refusals& refusals) {
  if (name.suffix.empty()) return;
  const PairName first{name.prefix, ""};
  const auto missing = [&](const char* key, const char* what) {
    refusals.attempt([&] {
      refuse(own_element(m, name.of(key)),
             message("missing, but {} is given; give {}", first.of(key), what));
    });
  };
  for (const char* key : {names::kOwnFriction, names::kOwnRestitution, names::kOwnTangential,
                          names::kOwnFrictionReference}) {
    if (!own_number(m, name.of(key)) && own_number(m, first.of(key)))
      missing(key, "a number for each contact");
  }
  const char* model = names::kContactText;
  if (!own_text(m, name.of(model)) && own_text(m, first.of(model)))
    missing(model, "a contact model for each contact");
}

// Refuses two geoms on one body, or on bodies without a joint between them.
void check_bodies(const mjModel* m, const PairName& name, const ContactPair& p) {
  const int rotor = m->geom_bodyid[p.rotor_geom], ring = m->geom_bodyid[p.ring_geom];
  if (p.rotor_geom == p.ring_geom) {
    refuse(own_element(m, name.of(names::kOwnRingGeom)), "is the rotor's geom");
  }
  if (m->body_weldid[rotor] != m->body_weldid[ring]) return;
  refuse(
      own_element(m, name.of(names::kOwnRingGeom)),
      message("geom \"{}\" cannot move against the rotor's, \"{}\": {}; use bodies with a joint "
              "between them",
              m->names + m->name_geomadr[p.ring_geom], m->names + m->name_geomadr[p.rotor_geom],
              rotor == ring ? "both are on one body" : "there is no joint between their bodies"));
}

void check_across(const mjModel* m, const ContactPair& p) {
  if (!lies_across(m, p)) return;
  refuse(message("<geom name=\"{}\">", m->names + m->name_geomadr[p.rotor_geom]),
         message("its axis stands across the axis of its ring, geom \"{}\", in qpos0; tilt it by "
                 "less than 60 degrees",
                 m->names + m->name_geomadr[p.ring_geom]));
}

// Reads one contact from <custom>; empty if its geoms do not exist or cannot move against each
// other. All errors are added to the refusals.
std::optional<ContactPair> make_pair(const mjModel* m, const PairName& name, Refusals& refusals) {
  ContactPair p;
  const auto check = [&refusals](auto action) { return refusals.attempt(action); };
  const bool known = check([&] {
    p.contact_model = contact_model(m, name.of(names::kContactText), scene::ContactModel::kRigid);
  });
  const bool rotor = check([&] { p.rotor_geom = own_geom(m, name, names::kOwnRotorGeom); });
  const bool ring = check([&] { p.ring_geom = own_geom(m, name, names::kOwnRingGeom); });
  check_series(m, name, refusals);
  bool numbers = true;
  const auto number = [&](double& value, const char* key, double otherwise, const Range& range) {
    if (!check([&] { value = value_or(m, name.of(key), otherwise, range); })) numbers = false;
  };
  ContactParameters& c = p.contact;
  numbers = check([&] {
    if (own_number(m, name.of(names::kOwnClearance))) return;
    refuse(own_element(m, name.of(names::kOwnClearance)),
           "missing; give the radial clearance in m, > 0");
  });
  if (numbers) number(c.clearance, names::kOwnClearance, 0.0, kLength);
  const double drawn = rotor ? m->geom_size[3 * p.rotor_geom] : 1.0;
  number(c.radius, names::kOwnRadius, drawn, kLength);
  if (!check([&] { c.friction = own_friction(m, name.of(names::kOwnFriction)); })) numbers = false;
  number(c.restitution, names::kOwnRestitution, 0.0, kShare);
  number(c.tangential_restitution, names::kOwnTangential, 0.0, kShare);
  number(p.friction_reference, names::kOwnFrictionReference, 0.0, kCoefficient);
  double width = 0.0;
  if (own_number(m, name.of(names::kOwnWidth))) number(width, names::kOwnWidth, 0.0, kLength);
  check([&] {
    if (!known || !(p.friction_reference > 0.0) || p.contact_model == scene::ContactModel::kCone)
      return;
    refuse(
        own_element(m, name.of(names::kOwnFrictionReference)),
        message("contact model {} has no friction reference; remove it, or use contact model cone",
                scene::to_string(p.contact_model)));
  });
  check([&] { p.sensors = contact_sensors(m, name.prefix, name.suffix); });
  if (!rotor || !ring || !check([&] { check_bodies(m, name, p); })) return std::nullopt;
  check([&] { check_across(m, p); });
  p.pair = find_pair(m, p.rotor_geom, p.ring_geom);
  p.reach = half_length(m, p.rotor_geom, 0.0) +
            (width > 0.0 ? 0.5 * width : half_length(m, p.ring_geom, 1e300));
  p.read = own_numbers(m, p);
  p.axial = slides_along_axis(m, p);
  if (known && numbers) check_pair(m, name, p, refusals);
  return p;
}

bool share_tree(const mjModel* m, const ContactPair& a, const ContactPair& b) {
  for (const int i : {a.rotor_geom, a.ring_geom}) {
    for (const int j : {b.rotor_geom, b.ring_geom}) {
      const int root = m->body_rootid[m->geom_bodyid[i]];
      if (root > 0 && root == m->body_rootid[m->geom_bodyid[j]]) return true;
    }
  }
  return false;
}

// Checks two contacts of one machine against each other.
void check_two_contacts(const mjModel* m, const ContactPair& a, const ContactPair& b,
                        const PairName& name) {
  if (a.pair == b.pair) {
    refuse(own_element(m, name.of(names::kOwnRotorGeom)),
           message("{} already has a contact, and two geoms can have only one; remove this one",
                   pair_element(m, b)));
  }
  const auto solved_here = [](const ContactPair& p) { return !scene::is_cone(p.contact_model); };
  if (a.contact_model != b.contact_model && solved_here(a) && solved_here(b) &&
      share_tree(m, a, b)) {
    refuse(own_element(m, name.of(names::kContactText)),
           message("differs from the contact model of {}, which moves with it; use one contact "
                   "model for both",
                   pair_element(m, a)));
  }
}

// Refuses a contact's own <pair> in rotorub_cone_coulomb_pair: `rotorub_contact` determines its
// law.
void check_corrected(const mjModel* m, const Config& config) {
  for (const ContactPair& p : config.pairs) {
    const auto& corrected = config.corrected_pairs;
    if (std::find(corrected.begin(), corrected.end(), p.pair) == corrected.end()) continue;
    refuse(pair_element(m, p), message("belongs to a contact of contact model {}, but is also "
                                       "listed in rotorub_cone_coulomb_pair; use rotorub_contact "
                                       "\"cone-coulomb\" instead, which includes this correction",
                                       scene::to_string(p.contact_model)));
  }
}

}  // namespace

std::array<mjtNum, 10> own_numbers(const mjModel* m, const ContactPair& pair) {
  std::array<mjtNum, 10> numbers{};
  std::copy_n(m->geom_size + 3 * pair.rotor_geom, 3, numbers.begin());
  std::copy_n(m->geom_size + 3 * pair.ring_geom, 3, numbers.begin() + 3);
  if (pair.pair >= 0) std::copy_n(m->pair_friction + 5 * pair.pair, 2, numbers.begin() + 6);
  numbers[8] = m->geom_friction[3 * pair.rotor_geom];
  numbers[9] = m->geom_friction[3 * pair.ring_geom];
  return numbers;
}

bool same_motion(const Config& config, const mjModel* m) {
  return !config.own ||
         std::all_of(config.pairs.begin(), config.pairs.end(), [m](const ContactPair& p) {
           return p.axial == slides_along_axis(m, p) && !lies_across(m, p);
         });
}

void map_own_contacts(const mjModel* m, Config& config) {
  config.own = true;
  Refusals refusals;
  refusals.attempt([&] { config.memory = own_memory(m); });
  const std::vector<PairName> found = own_pair_names(m, refusals);
  for (const PairName& name : found) {
    std::optional<ContactPair> p = make_pair(m, name, refusals);
    if (!p) continue;
    for (const ContactPair& other : config.pairs)
      refusals.attempt([&] { check_two_contacts(m, other, *p, name); });
    p->userdata = config.memory + kFirstContact +
                  kEntries<ContactEntries> * static_cast<int>(config.pairs.size());
    config.pairs.push_back(*p);
  }
  refusals.attempt([&] {
    config.corrected_pairs = corrected_pairs(m);
    check_corrected(m, config);
  });
  const int contacts = static_cast<int>(found.size());
  refusals.attempt([&] {
    if (contacts <= static_cast<int>(kMaxContacts)) return;
    refuse("<custom>",
           message("has {} contacts; a model can have up to {}", contacts, kMaxContacts));
  });
  config.memory_size =
      kEntries<ModelEntries> + kEntries<ContactEntries> * std::max(contacts - 1, 0);
  refusals.attempt([&] {
    const int needed = config.memory + config.memory_size;
    if (m->nuserdata >= needed) return;
    refuse(message("<size nuserdata=\"{}\">", count(m->nuserdata)),
           message("set nuserdata=\"{}\" or more{}", needed,
                   config.memory == 0 ? std::string()
                                      : message(": {} entries from index {} on", config.memory_size,
                                                config.memory)));
  });
  refusals.raise();
}

}  // namespace rotorub::plugin
