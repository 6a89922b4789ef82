#include "plugin/fingerprint.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <string_view>

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// Calls action(bytes, count) for each part until it says false.
template <typename Action>
bool for_each_part(const mjModel* m, Action action) {
  const int sizes[] = {count(m->nq),        count(m->nv),     count(m->nu),
                       count(m->njnt),      count(m->ngeom),  count(m->nsensor),
                       count(m->ntextdata), count(m->nnames), count(m->nnumericdata),
                       count(m->nuserdata), count(m->npair),  count(m->nmocap),
                       count(m->nbody),     count(m->na),     count(m->ntext),
                       count(m->nnumeric),  count(m->neq),    count(m->ntendon)};
  const auto part = [&action](const auto* data, auto n) {
    return n == 0 ||
           action(reinterpret_cast<const char*>(data), sizeof *data * static_cast<std::size_t>(n));
  };
  // clang-format off
  return part(sizes, static_cast<int>(std::size(sizes))) &&
         part(m->text_data, m->ntextdata) && part(m->text_adr, m->ntext) &&
         part(m->numeric_data, m->nnumericdata) && part(m->numeric_adr, m->nnumeric) &&
         part(m->names, m->nnames) && part(m->name_textadr, m->ntext) &&
         part(m->name_numericadr, m->nnumeric) && part(m->name_bodyadr, m->nbody) &&
         part(m->name_jntadr, m->njnt) && part(m->name_geomadr, m->ngeom) &&
         part(m->name_sensoradr, m->nsensor) && part(m->name_actuatoradr, actuator_count(m)) &&
         part(m->jnt_type, m->njnt) && part(m->jnt_qposadr, m->njnt) &&
         part(m->jnt_dofadr, m->njnt) && part(m->jnt_bodyid, m->njnt) &&
         part(m->geom_type, m->ngeom) && part(m->geom_bodyid, m->ngeom) &&
         part(m->body_parentid, m->nbody) && part(m->body_mocapid, m->nbody) &&
         part(m->sensor_type, m->nsensor) && part(m->sensor_dim, m->nsensor) &&
         part(m->sensor_adr, m->nsensor) && part(m->sensor_needstage, m->nsensor) &&
         part(m->sensor_objid, m->nsensor) &&
         part(m->actuator_gaintype, actuator_count(m)) &&
         part(m->actuator_biastype, actuator_count(m)) &&
         part(m->actuator_dyntype, actuator_count(m)) &&
         part(m->pair_geom1, m->npair) && part(m->pair_geom2, m->npair) &&
         part(m->pair_dim, m->npair) && part(m->pair_margin, m->npair) &&
         part(m->pair_gap, m->npair) && part(m->pair_solref, mjNREF * m->npair) &&
         part(m->jnt_limited, m->njnt) && part(m->dof_frictionloss, m->nv) &&
         part(m->tendon_limited, m->ntendon) && part(m->tendon_frictionloss, m->ntendon);
  // clang-format on
}

// Most parts are a few words: a call for each would cost more than they do.
bool same_bytes(const char* a, const char* b, std::size_t count) {
  constexpr std::size_t kWord = sizeof(std::uint64_t), kShort = 64;
  if (count > kShort) return std::memcmp(a, b, count) == 0;
  for (; count >= kWord; count -= kWord, a += kWord, b += kWord) {
    std::uint64_t one, other;
    std::memcpy(&one, a, kWord);
    std::memcpy(&other, b, kWord);
    if (one != other) return false;
  }
  for (; count > 0; --count) {
    if (*a++ != *b++) return false;
  }
  return true;
}

class Hash {
 public:
  template <typename T>
  void add(const T* data, int n) {
    add_bytes(reinterpret_cast<const char*>(data), sizeof *data * static_cast<std::size_t>(n));
  }
  void add_bytes(const char* data, std::size_t count) {
    sum_ = std::rotl(sum_, 7) * 0x9e3779b97f4a7c15u ^
           std::hash<std::string_view>{}(std::string_view(data, count));
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace

std::string fingerprint(const mjModel* m) {
  std::string bytes;
  for_each_part(m, [&bytes](const char* part, std::size_t count) {
    bytes.append(part, count);
    return true;
  });
  return bytes;
}

bool has_fingerprint(const mjModel* m, const std::string& kept) {
  const char* at = kept.data();
  const char* const end = at + kept.size();
  const bool same = for_each_part(m, [&](const char* part, std::size_t count) {
    if (static_cast<std::size_t>(end - at) < count) return false;
    if (!same_bytes(at, part, count)) return false;
    at += count;
    return true;
  });
  return same && at == end;
}

ModelHash model_hash(const mjModel* m) {
  Hash kind, numbers;
  for_each_part(m, [&kind](const char* part, std::size_t count) {
    kind.add_bytes(part, count);
    return true;
  });
  numbers.add(m->opt.gravity, 3);
  numbers.add(&m->opt.disableflags, 1);
  numbers.add(m->dof_armature, count(m->nv));
  numbers.add(m->dof_M0, count(m->nv));
  numbers.add(m->dof_damping, count(m->nv));
  numbers.add(m->jnt_stiffness, count(m->njnt));
  numbers.add(m->body_mass, count(m->nbody));
  numbers.add(m->geom_size, 3 * count(m->ngeom));
  numbers.add(m->pair_friction, 5 * count(m->npair));
  numbers.add(m->actuator_ctrlrange, 2 * count(m->nu));
  return {kind.sum(), std::rotl(kind.sum(), 7) ^ numbers.sum()};
}

}  // namespace rotorub::plugin
