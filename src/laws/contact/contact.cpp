#include "laws/contact/contact.h"

#include <cmath>

namespace pintle {
namespace {

// ln((1 + h) / (1 - h e)) - h (1 + e), which grows with e and with h; h e < 1.
double missing(double h, double e) { return std::log1p(h) - std::log1p(-h * e) - h * (1 + e); }

// The root of a function that changes sign once between low and high, from minus to plus.
template <class F>
double root(double low, double high, const F& f) {
  double middle = 0.5 * (low + high);
  for (; middle > low && middle < high; middle = 0.5 * (low + high)) (f(middle) > 0 ? high : low) = middle;
  return middle;
}

}  // namespace

double restitution_of(double hysteresis) {
  const double h = hysteresis;
  if (h < 1e-9) return 1;  // e = 1 - 2 h / 3
  return root(0.0, std::min(1.0, 1 / h), [h](double e) { return missing(h, e); });
}

double hysteresis_of(ContactModel model, double restitution) {
  const double e = restitution;
  switch (model) {
    case ContactModel::kExact:
      return e >= 1 ? 0 : root(0.0, 1 / e, [e](double h) { return h > 0 ? missing(h, e) : -1; });
    case ContactModel::kLankaraniNikravesh:
      return 0.75 * (1 - e * e);
    case ContactModel::kHuntCrossley:
      return 1.5 * (1 - e);
    case ContactModel::kFlores:
      return 8 * (1 - e) / (5 * e);
    case ContactModel::kGonthier:
      return (1 - e * e) / e;
    case ContactModel::kViscous:
      break;
  }
  return 0;
}

double hertz_stiffness(double modulus, double poisson, double journal, double bearing) {
  const double radius = std::isfinite(bearing) ? journal * bearing / (bearing - journal) : journal;
  return 2.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(radius);
}

}  // namespace pintle
