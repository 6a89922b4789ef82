// A page runs no law of a user: neither shared libraries nor Python exist there.
#include <stdexcept>

#include "native_model/control/law.h"

namespace rotorub {

template <class Kind>
std::unique_ptr<Law<Kind>> open_law(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() + ": a page cannot run your own law");
}

template std::unique_ptr<Law<RingLaw>> open_law(const std::filesystem::path&);
template std::unique_ptr<Law<MagneticLaw>> open_law(const std::filesystem::path&);

}  // namespace rotorub
