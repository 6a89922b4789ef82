// The law of a file that a scene names: opens it, creates it, calls it at each sample, and ends the
// run with a message if it fails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/control/controller.h"
#include "native_model/control/law.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/record.h"

namespace rotorub {

// Kind is RingLaw or MagneticLaw.
template <class Kind>
class LibraryLaw {
 public:
  // Opens the file, which the scene names at `table`.library; does not call create(). Throws
  // scene::SceneError there.
  LibraryLaw(const scene::Scene& scene, const std::string& table, const std::string& file)
      : scene_(&scene), table_(table) {
    const NamedLibrary named{table + ".library", file};
    const std::filesystem::path path = library_path(scene, named);
    try {
      law_ = open_law<Kind>(path);
    } catch (const std::runtime_error& error) {
      scene::refuse_at(scene, named.key, error.what());
    }
  }

  // Calls the law's create(). Call it once, while the scene exists. setup: complete except for its
  // entries, which are set from `config`.
  void create(typename Kind::Setup setup, const std::vector<scene::ConfigEntry>& config,
              std::size_t most_state) {
    std::vector<rotorub_entry> entries;
    for (const scene::ConfigEntry& e : config) {
      entries.push_back({e.key.c_str(), e.text ? e.text->c_str() : nullptr, e.number});
    }
    setup.entries = entries.size();
    setup.config = entries.data();
    const std::string refused = law_->create(setup);
    if (!refused.empty())
      scene::refuse_at(*scene_, table_ + ".config", law_->name() + " refuses: " + refused);
    if (state_size() > most_state) {
      refuse("a state of " + std::to_string(state_size()) + " numbers is too large; the limit is " +
             std::to_string(most_state));
    }
  }

  std::uint32_t command() const { return law_->command(); }
  std::size_t state_size() const { return law_->state_size(); }
  // state: 0 on entry.
  void start(double* state) const { law_->start(state); }
  // output: receives `commands` numbers. Throws ControllerError.
  void step(const typename Kind::Measurement& now, double* state, double* output,
            std::size_t commands) const {
    const std::string failed = law_->step(now, state, output);
    const auto finite = [](const double* from, std::size_t count) {
      return std::all_of(from, from + count, [](double x) { return std::isfinite(x); });
    };
    if (!failed.empty()) fail(now.t, failed);
    if (!finite(output, commands)) fail(now.t, "its command is not finite");
    if (!finite(state, state_size())) fail(now.t, "its state is not finite");
  }

  // Throws scene::SceneError at the key that names the file. Call it only while the scene exists.
  [[noreturn]] void refuse(const std::string& why) const {
    scene::refuse_at(*scene_, table_ + ".library", law_->name() + ": " + why);
  }

 private:
  [[noreturn]] void fail(double t, const std::string& reason) const {
    throw ControllerError("controller " + law_->name() + " at t = " + std::to_string(t) +
                          " s: " + reason);
  }

  const scene::Scene* scene_;  // used only in the constructor and create()
  std::string table_;
  std::unique_ptr<Law<Kind>> law_;
};

}  // namespace rotorub
