// Which stiffness is stiff enough: the paper's procedure (section 8), with the extrapolated limit of ideal joints and its error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pintle/simulate.h"

namespace pintle {

struct StiffenRequest {
  int digits = 4;                        ///< significant figures to which the chosen quantities must agree
  bool motion_only = false;              ///< coordinates instead of joint forces
  double damping = 500;                  ///< of every joint [N*s/m]
  std::optional<double> damping_ratio;   ///< alternative to damping: ratio to critical damping, for each gap component on its own [-]
  std::vector<std::string> joints;       ///< the joints whose forces count; empty: all
  double first = 0;                      ///< stiffness to start from [N/m]; 0: 1e6, or 1e5 for motion_only
  double last = 1e12;                    ///< stiffness beyond which the procedure gives up [N/m]
};

/// One run of the procedure, with the same stiffness in every joint that is stiffened.
struct StiffenStep {
  double stiffness = 0;               ///< [N/m]
  double change = 0;                  ///< largest change of a chosen quantity from the previous step, relative to its peak [-]; NaN in the first step
  std::string where;                  ///< the joint or column of that change
  double error_estimate = 0;          ///< the run's own estimate, the largest over the chosen joints [-]
  std::vector<double> peaks;          ///< of each chosen quantity
  std::vector<double> changes;        ///< of each chosen quantity, relative to its peak [-]
};

/// A chosen quantity and its limit.
struct StiffenLimit {
  std::string name, unit;
  double peak = 0;        ///< in the stiffest run
  double limit = 0;       ///< extrapolated to infinite stiffness: Richardson in 1/stiffness
  double error = 0;       ///< estimated error of the limit: the change between two such extrapolations plus the runs' own errors
  int digits = 0;         ///< to which the last two runs agree, over all output times
};

struct StiffenJoint {
  std::string name, type;
  bool kept = false;               ///< its own stiffness is part of the mechanism and was left unchanged
  double stated = 0;               ///< smallest stiffness stated in the model [N/m]
  double stiffness = 0, damping = 0;                  ///< recommended [N/m, N*s/m]
  double angular_stiffness = 0, angular_damping = 0;  ///< where the joint forbids an angle [N*m/rad, N*m*s/rad]
  double influence = 0;            ///< effect of its compliance on the chosen quantities at the recommended stiffness [-]; 0: not determined
};

struct Stiffening {
  StiffenRequest request;
  bool found = false;
  double stiffness = 0;               ///< at which the digits agree [N/m]
  std::vector<std::string> quantities;  ///< the quantities to which the peaks and changes of the steps belong
  std::vector<StiffenStep> steps;
  std::vector<StiffenLimit> limits;
  std::vector<StiffenJoint> joints;
  double kept_influence = 0;          ///< change of the chosen quantities if the kept joints were stiff too [-]
  std::string kept_where;
  std::string reason;                 ///< why there is no answer, or what qualifies it
  std::vector<std::string> notes;
};

/// Runs `model` repeatedly with increasing joint stiffness. Throws AssemblyError, and InputError for a joint that does not exist.
Stiffening stiffen(const Model& model, const StiffenRequest& request, const Observer& observer = {});

/// The model with the recommended values in its joints.
Model stiffened(const Model& model, const std::vector<StiffenJoint>& joints);

}  // namespace pintle
