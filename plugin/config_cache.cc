#include "plugin/config_cache.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "plugin/fingerprint.h"
#include "plugin/make_config.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/thread_memory.h"
#include "plugin/model/user_data.h"
#include "plugin/model_parameters.h"
#include "plugin/own/instances.h"
#include "plugin/own/load_warnings.h"
#include "plugin/own/own_config.h"

namespace rotorub::plugin {
namespace {

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

// Hashes to find a model among many: of its fingerprint, and of the numbers that model_parameters.h
// also reads.
struct ModelHash {
  std::uint64_t kind, numbers;
};
ModelHash model_hash(const mjModel* m) {
  Hash kind, numbers;
  const std::string bytes = fingerprint(m);
  kind.add_bytes(bytes.data(), bytes.size());
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

using ConfigPointer = std::shared_ptr<const Config>;

// True if the config still belongs to m.
bool fits(const Config& config, const mjModel* m) {
  return fingerprint(m) == config.fingerprint && has_parameters(config, m);
}

// The configs that any thread of the process holds, so that threads share them.
class Registry {
 public:
  ConfigPointer find_or_make(const mjModel* m) {
    const ModelHash hash = model_hash(m);
    ConfigPointer near;
    if (ConfigPointer known = find(m, hash, &near)) return known;
    // The lock is not held while the config is made.
    auto own = std::make_shared<Config>(near ? with_parameters(*near, m) : make_config(m));
    own->warnings = near ? near->warnings : load_warnings(m, *own);  // not again after an edit
    const ConfigPointer made = std::move(own);
    const std::lock_guard<std::mutex> lock(mutex_);
    // another thread has made it meanwhile
    if (ConfigPointer known = among(m, hash.numbers)) return known;
    if (all_.size() >= room_) sweep();
    all_.emplace(hash.numbers, made);
    latest_[hash.kind] = made;
    return made;
  }

 private:
  // The config; if there is none, null, and `near` is a config with the same fingerprint and other
  // numbers, if there is one.
  ConfigPointer find(const mjModel* m, const ModelHash& hash, ConfigPointer* near) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ConfigPointer known = among(m, hash.numbers)) return known;
    const auto at = latest_.find(hash.kind);
    if (at != latest_.end()) *near = at->second.lock();
    if (*near && !(fingerprint(m) == (*near)->fingerprint && same_motion(**near, m))) near->reset();
    return nullptr;
  }
  ConfigPointer among(const mjModel* m, std::uint64_t numbers) const {
    const auto [first, last] = all_.equal_range(numbers);
    for (auto at = first; at != last; ++at) {
      ConfigPointer config = at->second.lock();
      if (config && fits(*config, m) && same_motion(*config, m)) return config;
    }
    return nullptr;
  }
  // Deletes the configs that no thread holds any more.
  void sweep() {
    const auto gone = [](const auto& entry) { return entry.second.expired(); };
    std::erase_if(all_, gone);
    std::erase_if(latest_, gone);
    room_ = std::max<std::size_t>(64, 2 * all_.size());
  }

  using Held = std::weak_ptr<const Config>;
  std::mutex mutex_;
  std::unordered_multimap<std::uint64_t, Held> all_;
  std::unordered_map<std::uint64_t, Held> latest_;  // the latest one for each fingerprint
  std::size_t room_ = 64;
};

// Never destroyed, because other threads may still step when the process ends.
Registry& registry() {
  static Registry* const all = new Registry;
  return *all;
}

struct Known {
  ConfigPointer config;  // null: a foreign model, with these names in its <custom>:
  std::string names;
  decltype(mjModel::nbuffer) bytes;  // size of the model
  ModelImage image;                  // of a model with a config
  const mjData* compared = nullptr;  // the mjData and the time of the pass that compared them
  double time = 0.0;
};
thread_local InTurns<const mjModel*, Known> recent;

// The names in <custom>, which MuJoCo stores consecutively.
std::string_view custom_names(const mjModel* m) {
  const char* begin = m->names + count(m->nnames);
  const char* end = m->names;
  const auto include = [&](const int* addresses, int n) {
    if (n == 0) return;
    const char* last = m->names + addresses[n - 1];
    begin = std::min<const char*>(begin, m->names + addresses[0]);
    end = std::max(end, last + std::strlen(last));
  };
  include(m->name_numericadr, count(m->nnumeric));
  include(m->name_textadr, count(m->ntext));
  return {begin, static_cast<std::size_t>(end - begin)};
}

// Compares the names once in a pass, because another model may have this address now.
bool is_still_foreign(Known& known, const mjModel* m, const mjData* d, bool check) {
  if (known.bytes != m->nbuffer) return false;
  if (!check) {
    known.compared = nullptr;
    return true;
  }
  if (known.compared == d && known.time == d->time) return true;
  known.compared = d;
  known.time = d->time;
  return !has_instances(m) && known.names == custom_names(m);
}

// mju_error may leave by longjmp (it does while a model is compiled), so the frame that calls it
// contains nothing with a destructor.
thread_local char raised_text[1000];

// Checks what the fingerprint and the numbers of a config do not contain. Throws ConfigError.
void check_known(const mjModel* m, const Config& config) {
  check_structure(m, config);
  if (m->opt.timestep > 0.0) return;
  refuse("<option>", message("timestep=\"{}\" must be > 0", m->opt.timestep));
}

const Config* look_up(const mjModel* m) {
  try {
    const Known* known = recent.find(m);
    if (known && known->config && fits(*known->config, m) && same_motion(*known->config, m)) {
      check_known(m, *known->config);
      return known->config.get();
    }
    ConfigPointer config = registry().find_or_make(m);
    check_known(m, *config);
    Known& made = recent.add(m, {std::move(config), {}, m->nbuffer, {}});
    made.image.take(m);
    return made.config.get();
  } catch (const std::exception& error) {
    copy_lines(error.what(), raised_text);
  }
  return nullptr;
}

// True if the known config still belongs to m, whose numbers or whole structure may have been
// edited.
bool still_fits(Known& known, const mjModel* m) {
  if (!same_motion(*known.config, m)) return false;
  if (known.image.equals(m)) return has_parameters(*known.config, m);
  if (!fits(*known.config, m)) return false;
  known.image.take(m);
  return true;
}

// True if mjData carries the mark of the config.
bool is_marked(const mjModel* m, const mjData* d, const Config& config) {
  return m->nuserdata > config.memory && config.id == model_entries(config, d).config_id;
}

const Config* find(const mjModel* m, const mjData* d, bool check) {
  if (m->ntext == 0 && m->nnumeric == 0 && !has_instances(m)) return nullptr;
  if (Known* known = recent.find(m)) {
    if (!known->config) {
      if (is_still_foreign(*known, m, d, check)) return nullptr;
    } else if (is_marked(m, d, *known->config) && (!check || still_fits(*known, m))) {
      return known->config.get();
    }
  }
  if (!is_ours(m)) {
    recent.add(
        m, {nullptr, std::string(custom_names(m)), m->nbuffer, {}, check ? d : nullptr, d->time});
    return nullptr;
  }
  const Config* config = look_up(m);
  if (!config) {
    raise_error(raised_text);
    return nullptr;
  }
  if (!block_is_ours(*config, d)) {
    refuse_clash(*config, m);
    return nullptr;
  }
  mjData* marked = const_cast<mjData*>(d);  // only userdata changes, which d points to
  model_entries(*config, marked).config_id = config->id;
  seal_block(*config, marked);
  return config;
}

}  // namespace

const Config* find_config(const mjModel* m, const mjData* d) { return find(m, d, false); }
const Config* find_config_checked(const mjModel* m, const mjData* d) { return find(m, d, true); }

}  // namespace rotorub::plugin
