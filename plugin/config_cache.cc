#include "plugin/config_cache.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>

#include "plugin/fingerprint.h"
#include "plugin/model_parameters.h"
#include "plugin/mujoco_versions.h"
#include "plugin/own/own_config.h"
#include "plugin/own/user_block.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

using ConfigPointer = std::shared_ptr<const Config>;

// All configs of the process, so that threads share one. The oldest goes when it is full; threads
// that still use it keep it alive.
class Registry {
 public:
  ConfigPointer find_or_make(const mjModel* m) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ConfigPointer near;
    for (const ConfigPointer& config : configs_) {
      if (!config || !has_fingerprint(m, config->fingerprint) || !same_motion(*config, m)) continue;
      if (has_parameters(*config, m)) return config;
      near = config;
    }
    ConfigPointer made =
        std::make_shared<const Config>(near ? with_parameters(*near, m) : make_config(m));
    configs_[next_] = made;
    next_ = (next_ + 1) % configs_.size();
    return made;
  }

 private:
  std::mutex mutex_;
  std::array<ConfigPointer, 64> configs_;
  std::size_t next_ = 0;
};

// Never destroyed: other threads may still step when the process ends.
Registry& registry() {
  static Registry* const all = new Registry;
  return *all;
}

struct Known {
  const mjModel* model = nullptr;
  ConfigPointer config;
};
// The models that this thread used last.
struct Recent {
  std::array<Known, 4> known;
  std::size_t next = 0;
};
thread_local Recent recent;

// mju_error may leave by longjmp (it does while a model is compiled): nothing with a destructor
// lives in the frame that calls it.
thread_local char raised_text[1000];

const Config* look_up(const mjModel* m) {
  try {
    ConfigPointer config = registry().find_or_make(m);
    auto at = std::find_if(recent.known.begin(), recent.known.end(),
                           [m](const Known& k) { return k.model == m; });
    if (at == recent.known.end()) {
      at = recent.known.begin() + static_cast<std::ptrdiff_t>(recent.next);
      recent.next = (recent.next + 1) % recent.known.size();
    }
    *at = {m, std::move(config)};
    return at->config.get();
  } catch (const std::exception& error) {
    std::snprintf(raised_text, sizeof raised_text, "%s", error.what());
  }
  return nullptr;
}

const Config* known_config(const mjModel* m, const mjData* d) {
  for (const Known& k : recent.known) {
    if (k.model != m || m->nuserdata <= k.config->memory + kConfigId) continue;
    if (k.config->id == d->userdata[k.config->memory + kConfigId]) return k.config.get();
  }
  return nullptr;
}

const Config* find(const mjModel* m, const mjData* d, bool check) {
  if (m->ntext == 0 && m->nnumeric == 0) return nullptr;
  const Config* config = known_config(m, d);
  const auto still = [m](const Config& c) {
    return has_fingerprint(m, c.fingerprint) && has_parameters(c, m);
  };
  if (config && (!check || still(*config))) return config;
  if (!is_ours(m)) return nullptr;
  config = look_up(m);
  if (!config) {
    raise_error(raised_text);
    return nullptr;
  }
  if (!block_is_ours(*config, d)) {
    refuse_clash(*config, m);
    return nullptr;
  }
  d->userdata[config->memory + kConfigId] = config->id;
  seal_block(*config, d);
  return config;
}

}  // namespace

const Config* find_config(const mjModel* m, const mjData* d) { return find(m, d, false); }
const Config* find_config_checked(const mjModel* m, const mjData* d) { return find(m, d, true); }

}  // namespace rotorub::plugin
