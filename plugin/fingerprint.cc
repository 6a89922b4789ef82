#include "plugin/fingerprint.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>

#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// The same for what a sensor shows; some of it exists only in later versions of MuJoCo.
template <typename Model, typename Part>
void for_each_sensor_part(const Model* m, Part part) {
  part(m->sensor_user, m->nsensor * m->nuser_sensor);
  part(m->sensor_objtype, m->nsensor);
  if constexpr (requires { m->sensor_reftype; }) {
    part(m->sensor_reftype, m->nsensor);
    part(m->sensor_refid, m->nsensor);
  }
#if mjVERSION_HEADER >= 335
  part(m->sensor_intprm, mjNSENS * m->nsensor);
#endif
  if constexpr (requires { m->sensor_history; }) {
    part(m->sensor_history, 2 * m->nsensor);
    part(m->sensor_delay, m->nsensor);
    part(m->sensor_interval, 2 * m->nsensor);
  }
}

// Calls action(bytes, count) for each part of the fingerprint.
template <typename Action>
void for_each_part(const mjModel* m, Action action) {
  const std::span<const int> instances = plugin_slots(m);
  const std::string_view attributes = plugin_attributes(m);
  const int sizes[] = {count(m->nq),
                       count(m->nv),
                       count(m->nu),
                       count(m->njnt),
                       count(m->ngeom),
                       count(m->nsensor),
                       count(m->ntextdata),
                       count(m->nnames),
                       count(m->nnumericdata),
                       count(m->nuserdata),
                       count(m->npair),
                       count(m->nmocap),
                       count(m->nbody),
                       count(m->na),
                       count(m->ntext),
                       count(m->nnumeric),
                       count(m->neq),
                       count(m->ntendon),
                       count(m->nwrap),
                       count(m->nsite),
                       count(m->nuser_sensor),
                       m->opt.cone,
                       collides_freely(m),
                       collides_pairs(m),
                       count(instances.size()),
                       count(attributes.size())};
  const auto part = [&action](const auto* data, auto n) {
    action(reinterpret_cast<const char*>(data), sizeof *data * static_cast<std::size_t>(n));
  };
  // clang-format off
  part(sizes, static_cast<int>(std::size(sizes)));
  part(m->text_data, m->ntextdata); part(m->text_adr, m->ntext);
  part(instances.data(), instances.size());
  part(attributes.data(), attributes.size());
  part(m->numeric_data, m->nnumericdata); part(m->numeric_adr, m->nnumeric);
  part(m->names, m->nnames); part(m->name_textadr, m->ntext);
  part(m->name_numericadr, m->nnumeric); part(m->name_bodyadr, m->nbody);
  part(m->name_jntadr, m->njnt); part(m->name_geomadr, m->ngeom);
  part(m->name_sensoradr, m->nsensor); part(m->name_actuatoradr, actuator_count(m));
  part(m->jnt_type, m->njnt); part(m->jnt_qposadr, m->njnt);
  part(m->jnt_dofadr, m->njnt); part(m->jnt_bodyid, m->njnt);
  part(m->geom_type, m->ngeom); part(m->geom_bodyid, m->ngeom);
  part(m->body_parentid, m->nbody); part(m->body_mocapid, m->nbody);
  part(m->sensor_type, m->nsensor); part(m->sensor_dim, m->nsensor);
  part(m->sensor_adr, m->nsensor); part(m->sensor_needstage, m->nsensor);
  part(m->sensor_objid, m->nsensor);
  for_each_sensor_part(m, part);
  part(m->actuator_gaintype, actuator_count(m));
  part(m->actuator_biastype, actuator_count(m));
  part(m->actuator_dyntype, actuator_count(m));
  part(m->pair_geom1, m->npair); part(m->pair_geom2, m->npair);
  part(m->pair_dim, m->npair); part(m->pair_margin, m->npair);
  part(m->pair_gap, m->npair); part(m->pair_solref, mjNREF * m->npair);
  part(m->jnt_limited, m->njnt); part(m->dof_frictionloss, m->nv);
  part(m->tendon_limited, m->ntendon); part(m->tendon_frictionloss, m->ntendon);
  part(m->tendon_adr, m->ntendon); part(m->tendon_num, m->ntendon);
  part(m->wrap_type, m->nwrap); part(m->wrap_objid, m->nwrap);
  part(m->site_bodyid, m->nsite);
  part(m->geom_contype, m->ngeom); part(m->geom_conaffinity, m->ngeom);
  part(m->eq_type, m->neq); part(equality_end_types(m), m->neq);
  part(m->eq_obj1id, m->neq); part(m->eq_obj2id, m->neq);
  // clang-format on
}

}  // namespace

std::string fingerprint(const mjModel* m) {
  std::string bytes;
  for_each_part(m, [&bytes](const char* part, std::size_t n) { bytes.append(part, n); });
  return bytes;
}

bool ModelImage::equals(const mjModel* m) const {
  return buffer_ && m->buffer == buffer_ && collides_freely(m) == freely_ &&
         collides_pairs(m) == pairs_ && std::memcmp(sizes_.data(), m, sizes_.size()) == 0 &&
         std::ranges::all_of(ranges_, [this](const Range& r) {
           return std::memcmp(r.at, bytes_.data() + r.offset, r.size) == 0;
         });
}

void ModelImage::take(const mjModel* m) {
  buffer_ = m->buffer;
  freely_ = collides_freely(m);
  pairs_ = collides_pairs(m);
  const char* begin = reinterpret_cast<const char*>(m);
  sizes_.assign(begin, reinterpret_cast<const char*>(&m->opt));
  ranges_.clear();
  for_each_part(m, [this, m](const char* part, std::size_t n) {
    // The first part is made of sizes, and stands outside the model.
    const char* buffer = static_cast<const char*>(m->buffer);
    if (n > 0 && part >= buffer && part < buffer + m->nbuffer) ranges_.push_back({part, n, 0});
  });
  merge();
  bytes_.clear();
  for (Range& r : ranges_) {
    r.offset = bytes_.size();
    bytes_.append(r.at, r.size);
  }
}

void ModelImage::merge() {
  constexpr std::ptrdiff_t kBetween = 1024;  // bytes
  std::ranges::sort(ranges_, {}, &Range::at);
  std::size_t last = 0;
  for (std::size_t i = 1; i < ranges_.size(); ++i) {
    Range& before = ranges_[last];
    const Range& next = ranges_[i];
    if (next.at - (before.at + before.size) > kBetween) {
      ranges_[++last] = next;
    } else {
      before.size =
          std::max(before.size, static_cast<std::size_t>(next.at - before.at) + next.size);
    }
  }
  ranges_.resize(std::min(ranges_.size(), last + 1));
}

}  // namespace rotorub::plugin
