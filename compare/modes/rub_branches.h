// Branches of periodic rubs over a key of a scene, stable and unstable, for machines of any kind:
// `rotorub modes --periodic --across`. At each value of the key, and of a second one, runs settle
// to periodic rubs (periodic_rubs.h). Each rub that lies on no branch yet is continued over the
// first key in both directions (native_model/periodic/continuation.h). Where a period doubles, the
// branch of twice the period is followed too. Then each branch is carried over to the neighbouring
// values of the second key, where runs may settle to something else.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/modes/periodic_rubs.h"
#include "compare/modes/rub_key_map.h"
#include "native_model/periodic/continuation.h"

namespace rotorub {

// `settled` of the rub has no run, except at the branch's start.
struct RubOnBranch {
  double value = 0.0;  // of the first key
  periodic::PointKind point = periodic::PointKind::kRegular;
  PeriodicRub rub;
};

// The period doubling at which a branch begins.
struct DoublingOrigin {
  std::size_t branch = 0;  // index in RubBranches::branches
  double value = 0.0;      // of the first key
};

struct RubBranch {
  double up = 0.0;                  // value of the second key, if there is one
  double from = 0.0;                // value of the first key where the branch was found
  std::vector<std::string> starts;  // of the runs that settle to it, or the branch beside it
  std::vector<RubOnBranch> points;  // in the order of the branch
  std::string first_end, last_end;  // why it ends at its first and at its last point
  std::optional<DoublingOrigin> origin{};
};

// True if a rub that was found at a value of the first key lies between two points of the branch,
// up to 2 % of its figures.
bool lies_on(const RubBranch& branch, double value, const PeriodicRub& rub);

// A start whose run settles to no periodic rub.
struct UnsettledValue {
  double value = 0.0, up = 0.0;
  std::string start, why;
};

struct RubBranches {
  MapAxis across;             // runs begin at its values; the branches lie within its range
  std::optional<MapAxis> up;  // one diagram for each of its values
  std::vector<std::string> contacts;
  std::vector<RubBranch> branches;  // by rising `up`
  std::vector<UnsettledValue> without;
  std::string sampling;  // a sentence if a sampled control is changed anywhere, or empty
};

struct BranchOptions {
  ShootingOptions shooting{};
  int most_points = 150;  // of a branch in one direction
  // Period doublings in a row that are followed from a branch on which runs settle, >= 0.
  int most_doublings = 2;
  // Limit of the effort in one direction, in stretches as SettlingParameters::most_stretches.
  std::int64_t most_stretches = 15'000'000;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double share)> progress{};
};

// The scene at values of the first and the second key, for several threads at once. Throws
// scene::SceneError if it is refused.
using SceneAt = std::function<scene::Scene(double value, double up)>;

// Throws scene::SceneError if the scene is refused at all values. Ends early if interrupted.
RubBranches rub_branches(const SceneAt& scene_at, const MapAxis& across,
                         const std::optional<MapAxis>& up, const BranchOptions& options = {});
// If rotor.speed varies, each load keeps its ratio to the spin.
RubBranches rub_branches(const scene::Variants& scenes, const MapAxis& across,
                         const std::optional<MapAxis>& up, const BranchOptions& options = {});

}  // namespace rotorub
