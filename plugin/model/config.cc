#include "plugin/model/config.h"

#include <algorithm>

#include "mjcf/names.h"

namespace rotorub::plugin {

const char* scene_text(const mjModel* m) { return custom_text(m, mjcf_names::kSceneText); }

const char* custom_text(const mjModel* m, std::string_view name) {
  for (int i = 0; i < m->ntext; ++i) {
    if (name == m->names + m->name_textadr[i]) return m->text_data + m->text_adr[i];
  }
  return nullptr;
}

int find_pair(const mjModel* m, int geom_a, int geom_b) {
  for (int i = 0; i < m->npair; ++i) {
    if (are_geoms(geom_a, geom_b, m->pair_geom1[i], m->pair_geom2[i])) return i;
  }
  return -1;
}

int count_pairs(const mjModel* m, int geom_a, int geom_b) {
  int found = 0;
  for (int i = 0; i < m->npair; ++i) {
    if (are_geoms(geom_a, geom_b, m->pair_geom1[i], m->pair_geom2[i])) ++found;
  }
  return found;
}

bool Config::has_rigid() const {
  const auto rigid = [](const ContactPair& p) {
    return p.contact_model == scene::ContactModel::kRigid;
  };
  return std::any_of(pairs.begin(), pairs.end(), rigid);
}

bool Config::has_soft() const {
  const auto soft = [](const ContactPair& p) {
    return p.contact_model != scene::ContactModel::kRigid;
  };
  return std::any_of(pairs.begin(), pairs.end(), soft);
}

}  // namespace rotorub::plugin
