// Several lasting contacts over one fixed step, solved together by Newton's method
// (lasting_contacts.h): first with each contact in its state of the step before, then as a coupled
// problem. Internal to this folder.
#pragma once

#include <span>

#include "native_model/contact/lasting_contacts.h"

namespace rotorub {

// Does the same as solve_lasting_contacts() for two or more contacts.
Status solve_several_on_circles(double h, std::span<LastingContact> contacts,
                                const ContactAdmittance& admittance);

}  // namespace rotorub
