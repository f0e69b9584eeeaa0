#include "integrators/dense/dense_forces.h"

#include "integrators/dense/lane_dense_forces.h"
#include "simd/processor_registers.h"

namespace pintle {
namespace {

template <class S>
class NarrowForces final : public LaneForces<S> {
 public:
  using LaneForces<S>::LaneForces;
  void find(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, typename BasicDenseForces<S>::Sampled& sampled) override { this->find_all(begin, end, nodes, sampled); }
};

template <class S>
class WideForces final : public LaneForces<S> {
 public:
  using LaneForces<S>::LaneForces;
  PINTLE_WIDE void find(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, typename BasicDenseForces<S>::Sampled& sampled) override { this->find_all(begin, end, nodes, sampled); }
};

template <class S>
class WidestForces final : public LaneForces<S> {
 public:
  using LaneForces<S>::LaneForces;
  PINTLE_WIDEST void find(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, typename BasicDenseForces<S>::Sampled& sampled) override { this->find_all(begin, end, nodes, sampled); }
};

}  // namespace

template <class S>
std::unique_ptr<BasicDenseForces<S>> make_dense_forces(const BasicSystem<S>& system) {
  using Widest = std::conditional_t<S::kCurved, WideForces<S>, WidestForces<S>>;
  return make_for_processor<BasicDenseForces<S>, NarrowForces<S>, WideForces<S>, Widest>(system);
}

template std::unique_ptr<BasicDenseForces<Planar>> make_dense_forces(const BasicSystem<Planar>& system);
PINTLE_IN_SPACE(template std::unique_ptr<BasicDenseForces<Spatial>> make_dense_forces(const BasicSystem<Spatial>& system);)

}  // namespace pintle
