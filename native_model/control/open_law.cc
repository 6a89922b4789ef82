#include "native_model/control/law.h"
#include "native_model/control/python_law.h"
#include "native_model/control/shared_law.h"

namespace rotorub {

template <class Kind>
std::unique_ptr<Law<Kind>> open_law(const std::filesystem::path& file) {
  if (file.extension() == ".py") return std::make_unique<PythonLaw<Kind>>(file);
  return std::make_unique<SharedLaw<Kind>>(file);
}

template std::unique_ptr<Law<RingLaw>> open_law(const std::filesystem::path&);
template std::unique_ptr<Law<MagneticLaw>> open_law(const std::filesystem::path&);

}  // namespace rotorub
