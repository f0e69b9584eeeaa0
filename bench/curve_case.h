// One mechanism of the curves, ready to run: both sets of equations, their truths, and the competing methods.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/curve_problems.h"
#include "bench/groups.h"
#include "bench/pintle_methods.h"
#include "bench/work_precision.h"

namespace pintle::bench {

struct CaseOptions {
  bool quick = false;
  double cap = 10;  // seconds for any run
};

/// A truth and the uncertainty of its own error.
struct Truth {
  std::unique_ptr<Samples> samples;  // none: it could not be computed
  std::string method;
  double force_doubt = 0, place_doubt = 0;  // difference from the previous run, with ten times the tolerance [-, m]
};

/// Computes the truth of a problem at a tolerance and at ten times that, and stores it where CurveCase finds it.
void store_truth(const CurveProblem& about, double tolerance);

class CurveCase {
 public:
  CurveCase(CurveProblem problem, const CaseOptions& options);

  const CurveProblem& about() const { return about_; }
  const Truth& truth(const std::string& equations) const { return equations == kIdeal ? ideal_truth_ : compliant_truth_; }
  std::vector<Contestant> contestants() const;
  /// Both truths and the difference of each from the previous run, in Markdown.
  std::string truths() const;
  int n_bodies() const { return compliant_->system.n_bodies(); }

 private:
  void find_compliant_truth();
  void find_ideal_truth();
  void add_own(std::vector<Contestant>& list) const;
  void add_sundials(std::vector<Contestant>& list) const;
  void add_simbody(std::vector<Contestant>& list) const;
  void add_mujoco(std::vector<Contestant>& list) const;

  CurveProblem about_;
  CaseOptions options_;
  std::unique_ptr<ReadyModel> compliant_, ideal_;
  Problem compliant_problem_, ideal_problem_;
  Truth compliant_truth_, ideal_truth_;
};

}  // namespace pintle::bench
