// The data by which an mjModel is recognised.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <string>
#include <vector>

namespace rotorub::plugin {

// Models with the same bytes are mapped in the same way. They are sizes, custom text and numbers,
// names, types and addresses, the numbers that decide who solves a pair, and what equalities,
// tendons and contact filters connect.
std::string fingerprint(const mjModel* m);

// The bytes of a model in which its fingerprint lies, as they were when it was last compared. In
// mjModel's buffer the arrays of the fingerprint stand near one another, so that they and what
// stands between them are a few ranges, which are compared much faster. If only the bytes between
// have changed, the fingerprint itself must be compared again.
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
