// Mechanisms that are kept between calls: those that are dragged, and those that move.
#pragma once

#include <map>

#include "pintle/live.h"
#include "studio/kernel/exchange.h"

namespace pintle::studio {

class MotionSessions {
 public:
  Json open_drag(Exchange& call);
  Json drag(Exchange& call);
  Json close_drag(Exchange& call);
  Json open_live(Exchange& call);
  Json advance(Exchange& call);
  Json close_live(Exchange& call);

 private:
  struct Names {
    std::vector<std::string> bodies, joints;
    int body(const std::string& name) const;
  };
  struct Drag {
    Names names;
    KinematicDrag linkage;
  };
  struct Live {
    Names names;
    LiveMotion motion;
  };
  static Names names_of(const Model& model);
  /// Positions and velocities of another motion, for bodies of the same names.
  static void start_like(const Live& other, Model& model);

  int next_ = 1;
  std::map<int, Drag> drags_;
  std::map<int, Live> lives_;
};

}  // namespace pintle::studio
