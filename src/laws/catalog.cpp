#include "laws/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "base/text/article.h"
#include "laws/bushing.h"
#include "laws/catalog_parts.h"
#include "laws/maxwell.h"
#include "laws/tension.h"
#include "linalg/dense_factors.h"

namespace pintle {
namespace {

constexpr std::array<KeyInfo, 4> kLinearKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 1e8, .minimum_exclusive = true, .per_component = true,
     .meaning = "force per forbidden displacement"},
    {.key = "damping", .unit = "N*s/m", .fallback = 3e3, .per_component = true,
     .meaning = "force per rate of forbidden displacement"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 1e6, .minimum_exclusive = true,
     .meaning = "moment per forbidden rotation, for joints that forbid it"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 30,
     .meaning = "moment per rate of forbidden rotation"},
}};

constexpr std::array<KeyInfo, 16> kBushingKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 5e5, .per_component = true, .meaning = "on the diagonal of the matrix, in the axes of the first marker"},
    {.key = "damping", .unit = "N*s/m", .fallback = 500, .per_component = true, .meaning = "on the diagonal of the damping matrix"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 100, .meaning = "moment per forbidden angle, in joints that forbid one"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 0.1, .meaning = "moment per rate of that angle"},
    {.key = "stiffness_xy", .unit = "N/m", .minimum = kAny, .meaning = "off the diagonal: force along x per displacement along y, and the reverse"},
    {.key = "stiffness_xa", .unit = "N/rad", .minimum = kAny, .meaning = "force along x per angle; moment per displacement along x"},
    {.key = "stiffness_ya", .unit = "N/rad", .minimum = kAny, .meaning = "force along y per angle; moment per displacement along y"},
    {.key = "damping_xy", .unit = "N*s/m", .minimum = kAny, .meaning = "off the diagonal of the damping matrix: x and y"},
    {.key = "damping_xa", .unit = "N*s/rad", .minimum = kAny, .meaning = "x and angle"},
    {.key = "damping_ya", .unit = "N*s/rad", .minimum = kAny, .meaning = "y and angle"},
    {.key = "preload_x", .unit = "N", .minimum = kAny, .meaning = "force on the second body in the rest position, along x of the first marker"},
    {.key = "preload_y", .unit = "N", .minimum = kAny, .meaning = "the same along y"},
    {.key = "preload_moment", .unit = "N*m", .minimum = kAny, .meaning = "moment on the second body in the rest position"},
    {.key = "offset_x", .unit = "m", .minimum = kAny, .meaning = "rest position of the second marker, along x of the first"},
    {.key = "offset_y", .unit = "m", .minimum = kAny, .meaning = "the same along y"},
    {.key = "offset_angle", .unit = "rad", .minimum = kAny, .meaning = "angle of the second marker against the first at rest"},
}};

constexpr std::array<KeyInfo, 9> kMaxwellKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 5e5, .minimum_exclusive = true, .per_component = true, .meaning = "what is left when all branches have relaxed"},
    {.key = "damping", .unit = "N*s/m", .fallback = 500, .per_component = true, .meaning = "of a damper beside the branches"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 100, .minimum_exclusive = true, .meaning = "the same for a forbidden angle"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 0.1, .meaning = "moment per rate of that angle"},
    {.key = "branch_ratio", .unit = "", .minimum_exclusive = true, .required = true, .list = true,
     .meaning = "stiffness of each relaxing branch over the relaxed one, a list, in every forbidden component alike"},
    {.key = "branch_time", .unit = "s", .minimum_exclusive = true, .required = true, .list = true, .meaning = "time in which the force of each branch falls to 1/e, a list as long"},
    {.key = "hardening", .unit = "m^-2", .meaning = "of the relaxed spring in the held lengths: at a displacement r it is stiffer by the share hardening*r^2"},
    {.key = "hysteresis_force", .unit = "N", .meaning = "largest friction inside the rubber, in the held lengths, whatever the speed"},
    {.key = "hysteresis_displacement", .unit = "m", .minimum_exclusive = true, .otherwise = "required with hysteresis_force", .meaning = "displacement from rest over which this friction reaches all but 1/e of its maximum; after a reversal it takes 1.69 times that"},
}};

constexpr std::array<std::string_view, 4> kPoseJoints{"revolute", "prismatic", "fixed", "slot"};

Planar::Mat matrix(const LawSetting& at, const char* linear, const char* angular, const std::array<const char*, 3>& beside) {
  Planar::Mat m = at.by_component(linear, angular).asDiagonal();
  constexpr std::array<std::pair<int, int>, 3> kPlaces{{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t i = 0; i < 3; ++i) m(kPlaces[i].first, kPlaces[i].second) = m(kPlaces[i].second, kPlaces[i].first) = at.number(beside[i]);
  return m;
}

constexpr std::array<const char*, 3> kStiffnessBeside{"stiffness_xy", "stiffness_xa", "stiffness_ya"}, kDampingBeside{"damping_xy", "damping_xa", "damping_ya"};

BushingLaw bushing_of(const LawSetting& at) {
  BushingLaw law;
  law.K = matrix(at, "stiffness", "angular_stiffness", kStiffnessBeside);
  law.C = matrix(at, "damping", "angular_damping", kDampingBeside);
  law.preload << at.number("preload_x"), at.number("preload_y"), at.number("preload_moment");
  law.offset << at.number("offset_x"), at.number("offset_y"), at.number("offset_angle");
  return law;
}

// Lengths and angles are made comparable by the diagonal, so that the sign of the least eigenvalue is not lost in rounding.
bool is_semi_definite(const Planar::Mat& m) {
  Planar::Vec size = m.diagonal().cwiseAbs().cwiseSqrt();
  for (int i = 0; i < 3; ++i)
    if (size[i] == 0) size[i] = 1;
  const Planar::Mat scaled = size.cwiseInverse().asDiagonal() * m * size.cwiseInverse().asDiagonal();
  SymmetricEigen eigen;
  return eigen.compute(scaled) && eigen.eigenvalues().minCoeff() > -1e-12;
}

LawFault bushing_fault(const LawSetting& at) {
  constexpr std::array<std::array<const char*, 6>, 3> kOf{{{"stiffness_xy", "damping_xy", "stiffness_xa", "damping_xa", "preload_x", "offset_x"},
                                                           {"stiffness_xy", "damping_xy", "stiffness_ya", "damping_ya", "preload_y", "offset_y"},
                                                           {"stiffness_xa", "damping_xa", "stiffness_ya", "damping_ya", "preload_moment", "offset_angle"}}};
  constexpr std::array<const char*, 3> kNames{"x", "y", "the angle"};
  for (int k = 0; k < 3; ++k)
    for (const char* key : kOf[k])
      if (!at.held[k] && at.number(key) != 0)
        return {key, fmt::format("{} joint leaves {} free, so that nothing can act there", with_article(at.joint_type), kNames[k]), "delete it, or another type of joint"};
  const BushingLaw law = bushing_of(at);
  for (const auto& [m, word, beside] : {std::tuple(&law.K, "stiffness", &kStiffnessBeside), std::tuple(&law.C, "damping", &kDampingBeside)}) {
    if (is_semi_definite(*m)) continue;
    constexpr std::array<std::pair<int, int>, 3> kPlaces{{{0, 1}, {0, 2}, {1, 2}}};
    const char* key = word;  // the coupling term with the largest ratio
    double boldest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double beside_it = std::abs(at.number((*beside)[i])), on_it = std::sqrt((*m)(kPlaces[i].first, kPlaces[i].first) * (*m)(kPlaces[i].second, kPlaces[i].second));
      if (!(beside_it > boldest * on_it)) continue;
      boldest = on_it > 0 ? beside_it / on_it : std::numeric_limits<double>::max();
      key = (*beside)[i];
    }
    return {key, fmt::format("the {} matrix is not positive semi-definite: such a bushing feeds energy into the mechanism", word),
            "smaller terms off the diagonal: each at most the root of the product of the two on it"};
  }
  return {};
}

void make_bushing(const LawSetting& at, Law& law) { law.add(std::make_unique<LawPartOf<BushingLaw>>(bushing_of(at))); }

// The held lengths in which rubber hardens or has internal friction.
std::vector<int> held_lengths(const LawSetting& at) {
  std::vector<int> all;
  for (int k = 0; k < 2; ++k)
    if (at.held[k] && (at.number("hardening") > 0 || at.number("hysteresis_force") > 0)) all.push_back(k);
  return all;
}

LawFault maxwell_fault(const LawSetting& at) {
  const std::size_t ratios = at.list("branch_ratio").size(), times = at.list("branch_time").size();
  if (ratios != times) return {"branch_time", fmt::format("{} times for {} branches", times, ratios), "one time for each entry of branch_ratio"};
  const auto held = static_cast<std::size_t>(std::count(at.held.begin(), at.held.end(), true));
  if (at.number("hysteresis_force") > 0 && !(at.number("hysteresis_displacement") > 0))
    return {"hysteresis_displacement", "the friction inside the rubber grows over a displacement, which is not stated", "hysteresis_displacement = \"0.1 mm\", or what it is"};
  const std::size_t inside = at.number("hysteresis_force") > 0 ? held_lengths(at).size() : 0;
  if (held * ratios + inside > static_cast<std::size_t>(kMostLawStates))
    return {"branch_ratio", fmt::format("{} branches in {} components are more than {} states", ratios, held, kMostLawStates), "fewer branches"};
  return {};
}

void make_maxwell(const LawSetting& at, Law& law) {
  MaxwellLaw maxwell{at.by_component("stiffness", "angular_stiffness"), at.by_component("damping", "angular_damping"), {}, at.number("hardening"), at.number("hysteresis_force"), 1, held_lengths(at)};
  if (maxwell.hysteresis_force > 0) maxwell.hysteresis_displacement = at.number("hysteresis_displacement");
  const std::vector<double> ratio = at.list("branch_ratio"), time = at.list("branch_time");
  for (int k = 0; k < 3; ++k)
    for (std::size_t b = 0; at.held[k] && b < ratio.size(); ++b) maxwell.branches.push_back({k, ratio[b] * maxwell.k[k], time[b]});
  law.add(std::make_unique<LawPartOf<MaxwellLaw>>(maxwell));
}

std::vector<LawInfo> own_laws() {
  std::vector<LawInfo> all{
      {.word = "linear", .meaning = "a spring and a damper in each forbidden displacement (the paper's axioms)", .keys = kLinearKeys, .stiffens = true, .make = make_linear},
      {.word = "bushing", .meaning = "full matrices of stiffness and damping, with a preload and a rest position of its own", .keys = kBushingKeys, .joints = kPoseJoints, .make = make_bushing, .fault = bushing_fault},
      {.word = "maxwell", .meaning = "rubber: a spring that may harden, a damper, branches of both in series that relax, and friction inside", .keys = kMaxwellKeys, .joints = kTwoSided, .make = make_maxwell, .fault = maxwell_fault},
  };
  add_friction_laws(all);
  add_contact_laws(all);
  add_bearing_laws(all);
  add_flexure_laws(all);
  add_stop_laws(all);
  add_detent_laws(all);
  return all;
}

std::vector<LawInfo>& laws() {
  static std::vector<LawInfo> all = own_laws();
  return all;
}

}  // namespace

// A rope's spring and damper only pull.
void make_linear(const LawSetting& at, Law& law) {
  const LinearLaw linear{at.by_component("stiffness", "angular_stiffness"), at.by_component("damping", "angular_damping")};
  if (at.one_sided) law.add(std::make_unique<LawPartOf<TensionLaw>>(TensionLaw{linear.k[0], linear.c[0]}));
  else law.set_linear(linear);
}

void LawSetting::take(const std::map<std::string, double>& geometry) {
  if (const auto angle = geometry.find("pressure_angle"); angle != geometry.end()) pressure_angle = angle->second;
  const auto stroke = geometry.find("stroke");
  if (stroke == geometry.end()) return;
  lower_end = 0;
  upper_end = stroke->second;
}

double LawSetting::number(std::string_view key, std::size_t place) const {
  const std::vector<double> values_of_key = list(key);
  if (!values_of_key.empty()) return values_of_key[std::min(place, values_of_key.size() - 1)];
  const KeyInfo* info = find_key(keys, key);
  return info ? info->fallback : 0;
}

std::vector<double> LawSetting::list(std::string_view key) const {
  const auto it = values ? values->find(std::string(key)) : std::map<std::string, std::vector<double>>::const_iterator{};
  return values && it != values->end() ? it->second : std::vector<double>{};
}

Planar::Vec LawSetting::by_component(std::string_view linear, std::string_view angular) const {
  Planar::Vec x = Planar::Vec::Zero();
  for (int k = 0, place = 0; k < 3; ++k)
    if (held[k]) x[k] = k == 2 ? number(angular) : number(linear, place++);
  return x;
}

std::string_view key_of(LawRole role) { return role == LawRole::kHolds ? "law" : role == LawRole::kFriction ? "friction" : role == LawRole::kStops ? "stops" : "detent"; }

std::span<const LawInfo> law_catalog() { return laws(); }

const LawInfo* find_law(std::string_view word) {
  const auto catalog = law_catalog();
  const auto it = std::find_if(catalog.begin(), catalog.end(), [&](const LawInfo& law) { return law.word == word; });
  return it == catalog.end() ? nullptr : &*it;
}

void register_law(const LawInfo& info) {
  if (find_law(info.word)) throw std::logic_error(fmt::format("there is a law '{}' already", info.word));
  laws().push_back(info);
}

bool suits(const LawInfo& law, std::string_view joint_type) {
  return law.joints.empty() || std::find(law.joints.begin(), law.joints.end(), joint_type) != law.joints.end();
}

}  // namespace pintle
