// Damping of contacts and stops: the same choice of models, with different key names.
#pragma once

#include <string_view>

#include "laws/catalog.h"
#include "laws/contact/contact.h"

namespace pintle {

struct DampingKeys {
  std::string_view model, restitution, factor, damper, exponent, least_speed;

  ContactModel model_of(const LawSetting& at) const;
  /// Exponent and damping of the contact, from the model and its keys.
  void set(const LawSetting& at, ContactForce& contact) const;
  /// Why they are inconsistent; an empty key: they are consistent.
  LawFault fault(const LawSetting& at) const;
};

}  // namespace pintle
