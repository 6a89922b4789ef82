// A law from a user's shared library, for either of the structures of rotorub/controller.h: loads
// it, creates it, calls it at each sample, and ends the run with a message if it fails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/control/abi/rotorub/controller.h"
#include "native_model/control/controller.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {

// Functions is rotorub_controller or rotorub_magnetic_controller.
template <class Functions>
class LibraryLaw {
 public:
  // Loads the library and checks its ABI and functions; does not call create(). The scene names the
  // library at `table`.library. Throws scene::SceneError there.
  LibraryLaw(const scene::Scene& scene, const std::string& table, const std::string& file,
             const char* symbol, std::uint32_t abi)
      : scene_(&scene), table_(table) {
    const std::filesystem::path path = library_path(scene, named(file));
    name_ = path.string();
    library_ = opened_library(scene, named(file), path);
    const auto get = reinterpret_cast<const Functions* (*)()>(symbol_of(library_.get(), symbol));
    if (get == nullptr) refuse_absent(symbol, file);
    functions_ = get();
    if (functions_ == nullptr) refuse("returns no controller");
    if (functions_->abi != abi) {
      refuse("is of controller ABI " + std::to_string(functions_->abi) +
             ", but this program needs ABI " + std::to_string(abi) +
             ". Rebuild it with this program's rotorub/controller.h.");
    }
    if (functions_->create == nullptr || functions_->step == nullptr)
      refuse("has no create() or no step()");
    name_ = functions_->name != nullptr ? scene::printable(functions_->name, 80)
                                        : path.filename().string();
  }
  ~LibraryLaw() {
    if (created_ && functions_->destroy != nullptr) functions_->destroy(self_);
  }
  LibraryLaw(const LibraryLaw&) = delete;
  LibraryLaw& operator=(const LibraryLaw&) = delete;

  // Calls the library's create(). Call it once, while the scene exists. setup: complete except for
  // its entries, which are set from `config`.
  template <class Setup>
  void create(Setup setup, const std::vector<scene::ConfigEntry>& config, std::size_t most_state) {
    std::vector<rotorub_entry> entries;
    for (const scene::ConfigEntry& e : config) {
      entries.push_back({e.key.c_str(), e.text ? e.text->c_str() : nullptr, e.number});
    }
    setup.entries = entries.size();
    setup.config = entries.data();
    const std::string refused = failure_of(
        [&](char* reason) { return functions_->create(&setup, &self_, reason, kReasonRoom); });
    if (!refused.empty())
      scene::refuse_at(*scene_, table_ + ".config", name_ + " refuses: " + refused);
    created_ = true;
    if (functions_->state_size != nullptr) state_size_ = functions_->state_size(self_);
    if (state_size_ > most_state) {
      refuse("a state of " + std::to_string(state_size_) + " numbers is too large; the limit is " +
             std::to_string(most_state));
    }
  }

  std::size_t state_size() const { return state_size_; }
  // state: 0 on entry.
  void start(double* state) const {
    if (functions_->start != nullptr) functions_->start(self_, state);
  }
  // told: receives `commands` numbers. Throws ControllerError.
  template <class Measurement>
  void step(const Measurement& now, double* state, double* told, std::size_t commands) const {
    const std::string failed = failure_of([&](char* reason) {
      return functions_->step(self_, &now, state, told, reason, kReasonRoom);
    });
    const auto finite = [](const double* from, std::size_t count) {
      return std::all_of(from, from + count, [](double x) { return std::isfinite(x); });
    };
    if (!failed.empty()) fail(now.t, failed);
    if (!finite(told, commands)) fail(now.t, "its command is not finite");
    if (!finite(state, state_size_)) fail(now.t, "its state is not finite");
  }

  const Functions& functions() const { return *functions_; }
  // Throws scene::SceneError at the key that names the library. Call it only while the scene
  // exists.
  [[noreturn]] void refuse(const std::string& why) const {
    scene::refuse_at(*scene_, table_ + ".library", name_ + ": " + why);
  }

 private:
  // Refuses a library without the function. It may have the function for the other kind of law.
  [[noreturn]] void refuse_absent(const std::string& symbol, const std::string& file) const {
    const std::string ring = ROTORUB_CONTROLLER_SYMBOL,
                      magnets = ROTORUB_MAGNETIC_CONTROLLER_SYMBOL;
    const std::string shown = scene::printable(std::filesystem::path(file).filename().string(), 80);
    std::string why = shown + " does not export " + symbol + ", so it is not a controller for " +
                      (symbol == ring ? "rotorub" : "magnetic bearings") +
                      " (see rotorub/controller.h).";
    if (symbol == ring && symbol_of(library_.get(), magnets.c_str()) != nullptr) {
      why = shown + " commands magnetic bearings (" + magnets +
            "), but this key sets a ring's controller. Set [magnetic_control] kind = \"library\" "
            "and library = \"" +
            shown + "\".";
    } else if (symbol == magnets && symbol_of(library_.get(), ring.c_str()) != nullptr) {
      why = shown + " commands a ring (" + ring +
            "), but this key sets the law of magnetic bearings. Set [controller] kind = "
            "\"library\" and library = \"" +
            shown + "\".";
    }
    scene::refuse_at(*scene_, table_ + ".library", why);
  }
  NamedLibrary named(const std::string& file) const { return {table_ + ".library", file}; }
  [[noreturn]] void fail(double t, const std::string& reason) const {
    throw ControllerError("controller " + name_ + " at t = " + std::to_string(t) + " s: " + reason);
  }

  const scene::Scene* scene_;  // used only in the constructor and create()
  std::string table_;
  std::shared_ptr<void> library_;  // keeps `functions_` valid
  const Functions* functions_ = nullptr;
  void* self_ = nullptr;
  bool created_ = false;
  std::size_t state_size_ = 0;
  std::string name_;
};

}  // namespace rotorub
