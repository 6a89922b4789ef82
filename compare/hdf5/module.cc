#include "compare/hdf5/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "compare/base/module_file.h"

namespace rotorub::hdf5 {

ImageOf load(std::string& missing) {
  const std::filesystem::path file = module_file("librotorub_hdf5.so");
  if (file.empty()) {
    missing = fmt::format("built without it; install {} and build again", kPackage);
    return nullptr;
  }
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* symbol = module ? dlsym(module, kModuleSymbol) : nullptr;
  if (!symbol) {
    const char* why = dlerror();
    missing = fmt::format("{}; {} is needed", why ? why : "no reason given", kPackage);
  }
  return reinterpret_cast<ImageOf>(symbol);
}

}  // namespace rotorub::hdf5
