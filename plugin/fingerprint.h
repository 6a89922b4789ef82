// The data by which an mjModel is recognised.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <string>
#include <vector>

namespace rotorub::plugin {

// Two models with the same fingerprint have the same Config except for its numbers. It contains
// sizes, custom text and numbers, names, types and addresses, the numbers that decide who solves a
// pair, and the objects that equalities, tendons and contact filters connect.
std::string fingerprint(const mjModel* m);

// A copy of the ranges of mjModel's buffer that contain the fingerprint, for a fast comparison. The
// arrays of the fingerprint lie close together, so that a few ranges cover them and the bytes in
// between. If the ranges differ, only bytes in between may have changed, so the fingerprint itself
// must then be compared.
class ModelImage {
 public:
  bool equals(const mjModel* m) const;
  void take(const mjModel* m);

 private:
  struct Range {
    const char* at;
    std::size_t size, offset;  // offset: in bytes_
  };

  void merge();

  const void* buffer_ = nullptr;  // null: nothing was taken yet
  bool freely_ = false, pairs_ = false;
  std::string sizes_;  // from the beginning of mjModel to its options
  std::vector<Range> ranges_;
  std::string bytes_;
};

}  // namespace rotorub::plugin
