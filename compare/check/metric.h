// The metrics that the rules of [[check]] limit. Each is a number and a pure function of the run,
// its scene and a reference.
//
//   <key>            a number of the run's summary: max_penetration, contact_fraction, impacts, ...
//   error.<column>   largest difference from the reference over the rows that both have
//   end.<column>     value in the last row
//   largest.<column> largest absolute value over all rows
//   residual.<name>  deviation of the rows from the laws of contact (compare/metrics/residuals.h)
//   count.<event>    number of events of a kind: impact, slide, stick, lift_off, reverse
#pragma once

#include <stdexcept>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

// The metric does not exist; the message lists the existing ones.
class NoSuchMetric : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr const char* kErrorPrefix = "error.";
bool needs_reference(const std::string& metric);

// Throws NoSuchMetric for a name that no run can have. The name of a column is not checked.
void check_name(const std::string& metric);

// reference: null unless the metric is error.<column>. Throws NoSuchMetric for a column that the
// run does not have.
double measure(const std::string& metric, const scene::Scene& scene, const Trajectory& trajectory,
               const Trajectory* reference);

}  // namespace rotorub::check
