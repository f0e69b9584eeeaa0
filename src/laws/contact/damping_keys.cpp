#include "laws/contact/damping_keys.h"

#include <fmt/format.h>

#include <string>

namespace pintle {

ContactModel DampingKeys::model_of(const LawSetting& at) const { return static_cast<ContactModel>(static_cast<int>(at.number(model))); }

void DampingKeys::set(const LawSetting& at, ContactForce& contact) const {
  const ContactModel chosen = model_of(at);
  const bool linear = chosen == ContactModel::kViscous;
  contact.exponent = linear ? 1 : at.number(exponent);
  contact.fixed_damping = linear ? 0 : at.number(factor);
  contact.hysteresis = linear || contact.fixed_damping > 0 ? 0 : hysteresis_of(chosen, at.number(restitution));
  contact.viscous = linear ? at.number(damper) : 0;
  contact.least_approach = at.number(least_speed);
}

LawFault DampingKeys::fault(const LawSetting& at) const {
  const double e = at.number(restitution);
  if (e > 1) return {std::string(restitution), fmt::format("{:g} is above 1: every impact would gain energy", e), "a value between 0 and 1, such as 0.8"};
  if (model_of(at) != ContactModel::kViscous) {
    if (at.number(damper) > 0) return {std::string(damper), "it is the damper of the linear model only", fmt::format("{} = \"linear\", or {} instead", model, restitution)};
    if (at.number(factor) > 0 && at.states(restitution)) return {std::string(restitution), fmt::format("the damping is that of {}", factor), "one of the two"};
    return {};
  }
  for (const std::string_view key : {restitution, factor})
    if (at.states(key)) return {std::string(key), fmt::format("the linear model is damped by {} alone", damper), fmt::format("{} = \"exact\", or {} instead", model, damper)};
  if (at.number(exponent) != 1 && at.states(exponent)) return {std::string(exponent), "the force of the linear model goes as the depth itself", fmt::format("1, or {} = \"exact\"", model)};
  return {};
}

}  // namespace pintle
