#include "plugin/own/load_warnings.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "mjcf/names.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/contact_sensors.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/own/own_names.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

// The names of all user sensors that the plugin fills in such a model.
std::vector<std::string> filled_sensors(const mjModel* m, const Config& config) {
  std::vector<std::string> all;
  std::vector<PairName> contacts;
  if (config.own) {
    contacts = own_pair_names(m);
  } else {
    for (std::size_t k = 0; k < config.pairs.size(); ++k)
      contacts.push_back({"", names::of_bearing(k, "")});
    all.assign({names::kActive, names::kControlForce, names::kCurrent});
    if (config.shadow)
      all.insert(all.end(),
                 {names::kRotorPosition, names::kShadowRotor, names::kShadowStator,
                  names::kShadowGap, names::kShadowNormalForce, names::kShadowFrictionForce});
  }
  for (const PairName& contact : contacts) {
    for (const char* name : contact_sensor_names()) all.push_back(contact.of(name));
  }
  return all;
}

void warn_of_sensors(const mjModel* m, const Config& config, std::vector<std::string>& all) {
  const std::vector<std::string> filled = filled_sensors(m, config);
  const std::vector<std::string_view> known(filled.begin(), filled.end());
  for (int i = 0; i < m->nsensor; ++i) {
    if (m->sensor_type[i] != mjSENS_USER) continue;
    const std::string_view name = m->names + m->name_sensoradr[i];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string_view meant = scene::nearest(name, known);
    if (meant.empty()) continue;  // a sensor of the user's own callback
    all.push_back(
        message("rotorub: <user name=\"{}\">: the plugin does not know this sensor, so it stays "
                "0; did you mean \"{}\"?",
                name, meant));
  }
}

void warn_of_pyramids(const mjModel* m, const Config& config, std::vector<std::string>& all) {
  if (!mj_isPyramidal(m)) return;
  std::vector<int> slide = config.corrected_pairs;
  for (const ContactPair& p : config.pairs) {
    if (config.own && p.axial && scene::is_cone(p.contact_model)) slide.push_back(p.pair);
  }
  std::erase_if(slide, [m](int pair) { return m->pair_dim[pair] < 3; });
  if (slide.empty()) return;
  const int pair = slide.front();
  const std::string more =
      slide.size() > 1 ? message(" and {} more", static_cast<int>(slide.size()) - 1) : "";
  all.push_back(
      message("rotorub: <pair geom1=\"{}\" geom2=\"{}\">{}: with MuJoCo's pyramidal cone the "
              "friction is up "
              "to 29 % too small where the slip is between the axes of the contact's frame; set "
              "<option cone=\"elliptic\"/>",
              m->names + m->name_geomadr[m->pair_geom1[pair]],
              m->names + m->name_geomadr[m->pair_geom2[pair]], more));
}

}  // namespace

std::shared_ptr<LoadWarnings> load_warnings(const mjModel* m, const Config& config) {
  auto all = std::make_shared<LoadWarnings>();
  warn_of_sensors(m, config, all->texts);
  warn_of_pyramids(m, config, all->texts);
  return all->texts.empty() ? nullptr : all;
}

void tell_load_warnings(const Config& config, const mjData* d) {
  if (!config.warnings || !(d->time > 0.0) || config.warnings->told.exchange(true)) return;
  for (const std::string& text : config.warnings->texts) warn(text.c_str());
}

}  // namespace rotorub::plugin
