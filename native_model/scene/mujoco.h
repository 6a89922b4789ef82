// [mujoco] of a scene (scene.h).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rotorub::scene {

enum class MujocoRotor { kModal, kSegments };                       // modes, or rigid segments
enum class ContactModel { kRigid, kCoulomb, kCone, kConeCoulomb };  // kContactModels
enum class MujocoIntegrator { kEuler, kImplicit, kRk4 };            // MuJoCo's own
enum class MujocoSolver { kNewton, kCg, kPgs };                     // MuJoCo's own

struct Mujoco {  // how the scene is modelled and solved in MuJoCo
  MujocoRotor rotor = MujocoRotor::kModal;
  int segments = 16;  // of the segment rotor, [2, 200]
  ContactModel contact = ContactModel::kRigid;
  MujocoIntegrator integrator = MujocoIntegrator::kEuler;
  MujocoSolver solver = MujocoSolver::kNewton;
  double solref_stiffness = 0.0;    // 1/s^2, > 0: direct solref K (0: see mjcf/soft_contact.h)
  double solref_damping = 0.0;      // 1/s, > 0: direct solref B (0: from contact.restitution)
  double friction_reference = 0.0;  // 1/s, > 0: B_t of the cone's friction rows (0: MuJoCo's B)
  bool shadow = false;              // runs the native model alongside, in user sensors
  bool bearing_currents = false;    // actuators that add to the currents asked of the amplifiers
};

// A contact model of MuJoCo and its word in scene files, options, columns and reports.
struct ContactWord {
  ContactModel model;
  const char* word;
};

// In the order of the enum, which every table follows.
inline constexpr std::array kContactModels{ContactWord{ContactModel::kRigid, "rigid"},
                                           ContactWord{ContactModel::kCoulomb, "coulomb"},
                                           ContactWord{ContactModel::kCone, "cone"},
                                           ContactWord{ContactModel::kConeCoulomb, "cone-coulomb"}};

// The word of a contact model in scene files and outputs.
constexpr const char* to_string(ContactModel model) {
  return kContactModels[static_cast<std::size_t>(model)].word;
}

// The model that `word` names, or nothing.
constexpr std::optional<ContactModel> contact_model(std::string_view word) {
  for (const ContactWord& w : kContactModels) {
    if (word == w.word) return w.model;
  }
  return std::nullopt;
}

// True if MuJoCo's solver computes both normal force and friction, in its friction cone.
constexpr bool is_cone(ContactModel model) {
  return model == ContactModel::kCone || model == ContactModel::kConeCoulomb;
}

// A container of the words, as schemas and options need it.
template <typename Words>
Words contact_words() {
  Words words;
  for (const ContactWord& w : kContactModels) words.emplace_back(w.word);
  return words;
}

}  // namespace rotorub::scene
