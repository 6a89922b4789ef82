// A page runs no law of a user, because neither shared libraries nor Python exist there, and
// searches no periodic rubs.
#include <stdexcept>

#include "native_model/control/law.h"
#include "native_model/prepare/periodic_start.h"

namespace rotorub {

template <class Kind>
std::unique_ptr<Law<Kind>> open_law(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() + ": a page cannot run your own law");
}

template std::unique_ptr<Law<RingLaw>> open_law(const std::filesystem::path&);
template std::unique_ptr<Law<MagneticLaw>> open_law(const std::filesystem::path&);

namespace rub {

State state_on_periodic_rub(const scene::Scene&, const scene::SceneError& no_form) {
  throw no_form;
}

}  // namespace rub

}  // namespace rotorub
