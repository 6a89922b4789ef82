// [mujoco] of a scene (scene.h).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rotorub::scene {

enum class MujocoRotor { kModal, kSegments };                       // modes, or rigid pieces
enum class ContactModel { kRigid, kCoulomb, kCone, kConeCoulomb };  // kContactModels
enum class MujocoIntegrator { kEuler, kImplicit, kRk4 };            // MuJoCo's own
enum class MujocoSolver { kNewton, kCg, kPgs };                     // MuJoCo's own

struct Mujoco {  // how the scene is put into MuJoCo, and solved there
  MujocoRotor rotor = MujocoRotor::kModal;
  int segments = 16;  // of the segment rotor, [2, 200]
  ContactModel contact = ContactModel::kRigid;
  MujocoIntegrator integrator = MujocoIntegrator::kEuler;
  MujocoSolver solver = MujocoSolver::kNewton;
  double solref_stiffness = 0.0;    // 1/s^2, > 0: direct solref K (0: mjcf/soft_contact.h)
  double solref_damping = 0.0;      // 1/s, > 0: direct solref B (0: that of contact.restitution)
  double friction_reference = 0.0;  // 1/s, > 0: B_t of the cone's friction rows (0: MuJoCo's, B)
  bool shadow = false;              // the native model runs alongside, in user sensors
  bool bearing_currents = false;    // actuators that add to what the amplifiers are asked for
};

// The contact models of MuJoCo's side and their words: in scene files, options, columns and
// reports.
struct ContactWord {
  ContactModel model;
  const char* word;
};

// In the order of the enum, which is that of every table.
inline constexpr std::array kContactModels{ContactWord{ContactModel::kRigid, "rigid"},
                                           ContactWord{ContactModel::kCoulomb, "coulomb"},
                                           ContactWord{ContactModel::kCone, "cone"},
                                           ContactWord{ContactModel::kConeCoulomb, "cone-coulomb"}};

constexpr const char* to_string(ContactModel model) {  // its word
  return kContactModels[static_cast<std::size_t>(model)].word;
}

// Of a word; none: no contact model is called so.
constexpr std::optional<ContactModel> contact_model(std::string_view word) {
  for (const ContactWord& w : kContactModels) {
    if (word == w.word) return w.model;
  }
  return std::nullopt;
}

// Normal force and friction are both found by MuJoCo's solver, in its friction cone.
constexpr bool is_cone(ContactModel model) {
  return model == ContactModel::kCone || model == ContactModel::kConeCoulomb;
}

// Container of words, as schemas and options take them.
template <typename Words>
Words contact_words() {
  Words words;
  for (const ContactWord& w : kContactModels) words.emplace_back(w.word);
  return words;
}

}  // namespace rotorub::scene
