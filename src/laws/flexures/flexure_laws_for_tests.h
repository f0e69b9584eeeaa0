// Laws of flexures made from their keys, and what they report.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "laws/law_setting_for_tests.h"

namespace pintle::flexure {

using Vec = Planar::Vec;
using Mat = Planar::Mat;
using Values = std::map<std::string, std::vector<double>>;

inline Law made(const char* word, const Values& values) {
  const LawInfo& info = *find_law(word);
  const LawSetting at = setting_of(info, values);
  EXPECT_EQ(info.fault(at).key, "");
  Law law;
  info.make(at, law);
  return law;
}
inline LawFault fault_of(const char* word, const Values& values) {
  const LawInfo& info = *find_law(word);
  const LawFault fault = info.fault(setting_of(info, values));
  EXPECT_EQ(fault.key.empty(), fault.remedy.empty());
  return fault;
}
inline Vec force(const Law& law, const Vec& gap, const Vec& rate = Vec::Zero()) { return law.force({0, gap, rate, nullptr}); }
inline LawTangents tangents(const Law& law, const Vec& gap, const Vec& rate = Vec::Zero()) {
  LawTangents r;
  law.linearize({0, gap, rate, nullptr}, r);
  return r;
}
inline std::vector<double> observed(const Law& law, const Vec& gap) {
  std::vector<double> values;
  const Vec still = Vec::Zero();
  law.observe({0, gap, still, nullptr}, still, values);
  return values;
}

/// The gap and the force of the joint with its ends exchanged and turned round, where the unloaded second marker is at `rest` relative to the first.
struct Exchanged {
  Vec gap, force;
};
inline Exchanged exchange_ends(const Vec& gap, const Vec& force, const Eigen::Vector2d& rest) {
  const Eigen::Vector2d apart = rest + gap.head<2>();
  const Eigen::Rotation2Dd back(-gap[2]);
  Exchanged other;
  other.gap << back * apart - rest, -gap[2];
  other.force << back * force.head<2>(), -force[2] - (apart.x() * force.y() - apart.y() * force.x());
  return other;
}

}  // namespace pintle::flexure
