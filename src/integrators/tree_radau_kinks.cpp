// Steps over a joint tree end where a law or a load has a kink or a jump. theory/time section 7, as RadauStepper.
#include <algorithm>
#include <limits>

#include "integrators/tree_radau.h"

namespace pintle {
namespace {

constexpr int kHalvings = 46;
constexpr double kCrossing = 1e-9;  // of the usual step: the least that is gone to cross
constexpr int kCrossings = 5;       // each ten times longer, until the side has changed

}  // namespace

// The sides at share x of the step, on the curve through its stages.
std::uint64_t TreeRadau::sides(double x, double h) {
  TreeState at;
  at.u = begin_.u;
  at.y = begin_.y + x * h * begin_.u;
  at.rate = begin_.rate;
  at.gap = begin_.gap + x * h * begin_.rate;
  for (int i = 0; i < n_; ++i) {
    double power = x, first = 0, second = 0;
    for (int k = 0; k < n_; ++k, power *= x) {
      first += table_.stages_to_powers(k, i) * power / (k + 1);
      second += table_.stages_to_powers(k, i) * power * x / ((k + 1) * (k + 2));
    }
    const TreeState& stage = stages_.states()[i];
    at.u += h * first * stage.w;
    at.y += h * h * second * stage.w;
    at.rate += h * first * stage.accel;
    at.gap += h * h * second * stage.accel;
  }
  inside_at_.place_only(begin_.t + x * h, at.y, at.u);
  return inside_at_.branches(at.gap, at.rate);
}

TreeRadau::Kink TreeRadau::first_kink(double h) {
  double before = 0;
  for (int i = 0; i < 2 * n_; ++i) {
    const double x = i % 2 == 0 ? 0.5 * (table_.nodes[i / 2] + table_.nodes[i / 2 + 1]) : table_.nodes[i / 2 + 1];
    if (sides(x, h) == side_) {
      before = x;
      continue;
    }
    double after = x;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (before + after);
      (sides(middle, h) == side_ ? before : after) = middle;
    }
    return {before, after};
  }
  return {};
}

// Moves the end over the kink that it stands just before, by Taylor's series, and renews its accelerations there.
void TreeRadau::cross_kink(double distance) {
  double beyond = std::max(kCrossing * usual_h_, 4 * std::numeric_limits<double>::epsilon() * std::abs(end_.t));
  for (int i = 0; i < kCrossings; ++i, beyond *= 10) {
    const double d = (i == 0 ? distance : 0) + beyond, half = 0.5 * d * d;
    end_.t += d;
    end_.y += d * end_.u + half * end_.w;
    end_.u += d * end_.w;
    end_.gap += d * end_.rate + half * end_.accel;
    end_.rate += d * end_.accel;
    end_at_.place(end_.t, end_.y, end_.u);
    const std::uint64_t now = end_at_.branches(end_.gap, end_.rate);
    if (now == side_) continue;
    side_ = now;
    break;
  }
  balance_end();
  have_history_ = false;
}

// What the laws and loads really give at the end.
void TreeRadau::balance_end() {
  end_at_.forces(end_.gap, end_.rate, end_.force);
  if (projector_.prepare(end_at_, 1, end_.gap, end_.rate)) projector_.accelerations(end_at_, end_.force, end_.w);
  end_at_.accelerate(end_.w);
  end_at_.gap_accelerations(end_.accel);
  const auto [supplied, lost] = end_at_.power(end_.gap, end_.rate, end_.force);
  end_state_.supply_power = supplied;
  end_state_.loss_power = lost;
  finish_end(end_.w);
}

}  // namespace pintle
