// The name of a file, as every value of a scene carries it: one copy in the process, so that trees
// of values are copied at no cost.
#pragma once

#include <string>
#include <string_view>

namespace rotorub::scene {

class FileName {
 public:
  FileName() : FileName(std::string_view()) {}
  FileName(std::string_view name) : name_(&kept(name)) {}                  // NOLINT: is a name
  FileName(const std::string& name) : FileName(std::string_view(name)) {}  // NOLINT: is a name
  FileName(const char* name) : FileName(std::string_view(name)) {}         // NOLINT: is a name
  operator const std::string&() const { return *name_; }                   // NOLINT: is a name
  bool operator==(const FileName& other) const { return name_ == other.name_; }

 private:
  // From any thread; names are kept to the end of the process: there are few.
  static const std::string& kept(std::string_view name);
  const std::string* name_;
};

}  // namespace rotorub::scene
