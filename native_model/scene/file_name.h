// The name of a file, as every value of a scene carries it: one copy for all of them, so that trees
// of values are copied at no cost.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace rotorub::scene {

class FileName {
 public:
  FileName() = default;
  FileName(std::string_view name) : name_(std::make_shared<const std::string>(name)) {}  // NOLINT
  FileName(const std::string& name) : FileName(std::string_view(name)) {}                // NOLINT
  FileName(const char* name) : FileName(std::string_view(name)) {}                       // NOLINT
  const std::string& text() const {
    static const std::string none;
    return name_ ? *name_ : none;
  }
  operator const std::string&() const { return text(); }  // NOLINT
  bool operator==(const FileName& other) const { return text() == other.text(); }

 private:
  std::shared_ptr<const std::string> name_;  // null: no name
};

}  // namespace rotorub::scene
