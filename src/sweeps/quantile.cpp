#include "sweeps/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pintle {
namespace {

double polynomial(const std::array<double, 8>& c, double x) {
  double y = 0;
  for (std::size_t i = c.size(); i-- > 0;) y = y * x + c[i];
  return y;
}

// M. J. Wichura, Algorithm AS 241: The percentage points of the normal distribution, Applied Statistics 37 (1988), PPND16.
constexpr std::array<double, 8> kA{3.3871328727963666080e0, 1.3314166789178437745e+2, 1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                   4.5921953931549871457e+4, 6.7265770927008700853e+4, 3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr std::array<double, 8> kB{1.0, 4.2313330701600911252e+1, 6.8718700749205790830e+2, 5.3941960214247511077e+3,
                                   2.1213794301586595867e+4, 3.9307895800092710610e+4, 2.8729085735721942674e+4, 5.2264952788528545610e+3};
constexpr std::array<double, 8> kC{1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0, 3.64784832476320460504e0,
                                   1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr std::array<double, 8> kD{1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
                                   1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9};
constexpr std::array<double, 8> kE{6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0, 2.96560571828504891230e-1,
                                   2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array<double, 8> kF{1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
                                   7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15};

double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// A standard normal value between a and b. The upper tail is mirrored, because its probabilities are close to 1.
double normal_between(double a, double b, double u) {
  if (a > 0) return -normal_between(-b, -a, 1 - u);
  const double low = normal_share(a), share = low + u * (normal_share(b) - low);
  if (!(share > 0)) return a;
  return share >= 1 ? b : std::clamp(normal_quantile(share), a, b);
}

double triangular(const Variation& v, double u) {
  const double width = v.to - v.from, below = (v.mode - v.from) / width;
  if (u < below) return v.from + std::sqrt(u * width * (v.mode - v.from));
  return v.to - std::sqrt((1 - u) * width * (v.to - v.mode));
}

double lognormal(const Variation& v, double u) {
  const double ratio = v.deviation / v.mean, variance = std::log1p(ratio * ratio), sigma = std::sqrt(variance);
  const double centre = std::log(v.mean) - 0.5 * variance;
  const double low = v.from > 0 ? std::log(v.from) : -INFINITY;
  return std::exp(centre + sigma * normal_between((low - centre) / sigma, (std::log(v.to) - centre) / sigma, u));
}

}  // namespace

double normal_quantile(double p) {
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kA, r) / polynomial(kB, r);
  }
  const double r = std::sqrt(-std::log(q < 0 ? p : 1 - p));
  const double x = r <= 5 ? polynomial(kC, r - 1.6) / polynomial(kD, r - 1.6) : polynomial(kE, r - 5) / polynomial(kF, r - 5);
  return q < 0 ? -x : x;
}

double quantile(const Variation& v, double u) {
  switch (v.distribution) {
    case Distribution::kNormal:
      return v.mean + v.deviation * normal_between((v.from - v.mean) / v.deviation, (v.to - v.mean) / v.deviation, u);
    case Distribution::kLognormal:
      return lognormal(v, u);
    case Distribution::kUniform:
      return v.from + (v.to - v.from) * u;
    case Distribution::kTriangular:
      return triangular(v, u);
  }
  return v.mean;
}

}  // namespace pintle
