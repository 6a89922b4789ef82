#include "plugin/contact/noted_contact.h"

#include <array>

#include "native_model/contact/most_contacts.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

NotedContact& noted(int data) {
  static thread_local std::array<NotedContact, kMaxContacts> all;
  return all[static_cast<std::size_t>(data / kEntries<ContactEntries>) % all.size()];
}

}  // namespace

const NotedContact& noted_contact(int data) { return noted(data); }

void note_contact(const mjData* d, int data, const Eigen::Vector2d& e_r, double axial) {
  noted(data) = {d, d->time, data, e_r, axial};
}

}  // namespace rotorub::plugin
