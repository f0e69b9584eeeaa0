// How contacts and stops are damped: the same choice of models, by keys of their own names.
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
  /// Why they do not go together; no key: they do.
  LawFault fault(const LawSetting& at) const;
};

}  // namespace pintle
