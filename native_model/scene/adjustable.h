// The numbers of a scene that people change when they look for a better machine: friction,
// clearance, gains, speeds, loads. The sliders of a page and the parameters of an FMU come from
// this one list.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

struct Adjustable {
  std::string path;  // as in an override: "rotor.disc[1].eccentricity"
  const Key* key;    // its row: quantity, range, meaning
  double value;      // SI
  // The number is x or y of a vector [x, y], which follow each other in a list.
  enum class Part { kWhole, kX, kY } part = Part::kWhole;

  std::string name() const {  // "force[0].vector.x"
    return path + (part == Part::kX ? ".x" : part == Part::kY ? ".y" : "");
  }
};

// The adjustable numbers that the scene sets; those of a controller also at their defaults. root:
// of the scene's text.
std::vector<Adjustable> adjustable_numbers(const TomlNode& root);

// The further speeds that the scene sets: the drive's, and the frequencies of forces.
std::vector<Adjustable> speeds_beside_the_rotors(const TomlNode& root);

// Overrides that give the numbers other values, as many and in their order. Numbers that keep their
// value have none.
std::vector<std::string> overrides_to(const std::vector<Adjustable>& numbers,
                                      const std::vector<double>& values);

}  // namespace rotorub::scene
