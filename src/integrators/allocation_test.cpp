// No memory is allocated between two accepted steps. The global operator new is replaced in this file; it counts while a
// flag is set and is otherwise plain malloc.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/dense/dense_output.h"
#include "integrators/general/dopri5.h"
#include "integrators/start_states_for_tests.h"

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* try_to_allocate(std::size_t size, std::size_t alignment) noexcept {
  if (counting.load(std::memory_order_relaxed)) allocations.fetch_add(1, std::memory_order_relaxed);
  if (size == 0) size = 1;
  return alignment <= alignof(std::max_align_t) ? std::malloc(size)
                                                : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocate(std::size_t size, std::size_t alignment) {
  void* memory = try_to_allocate(size, alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

// Not inlined: the compiler would see a pointer from new given to free.
[[gnu::noinline]] void release(void* memory) noexcept { std::free(memory); }

}  // namespace

// Every form is replaced: a sanitizer's own form next to one of these would mismatch new and delete.
void* operator new(std::size_t size) { return allocate(size, 1); }
void* operator new[](std::size_t size) { return allocate(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, static_cast<std::size_t>(alignment)); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return allocate(size, static_cast<std::size_t>(alignment)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return try_to_allocate(size, 1); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return try_to_allocate(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return try_to_allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return try_to_allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }

namespace pintle {
namespace {

template <class F>
long allocations_during(F&& work) {
  allocations = 0;
  counting = true;
  work();
  counting = false;
  return allocations;
}

TEST(Allocations, TheHookCounts) {
  EXPECT_EQ(allocations_during([] { std::vector<double>(100).swap(*std::make_unique<std::vector<double>>()); }), 2);
}

// A pendulum with every kind of load, and the four-bar with a drive.
std::vector<Model> stepped_models() {
  Model loaded = sample::pendulum(1e8, 3000);
  loaded.ground.push_back({"H", {1, 2}, 0});
  loaded.motors = {sample::motor("M", "pin", MotorKind::kEffort,
                                 sample::expression("0.5*sin(t)^2 - 0.3*rate + if(angle > 0, 1, 2) * 0.01 * pin.angle", {"t", "rate", "angle", "pin.angle"})),
                   sample::motor("W", "pin", MotorKind::kPosition, sample::expression("0.2*sin(3*t)"))};
  loaded.springs = {sample::spring("T", true, {"ground", "O"}, {"rod", "O"}, 8, 0.7), sample::spring("S", false, {"ground", "H"}, {"rod", "O"}, 8, 0.7)};
  for (Spring& s : loaded.springs) s.free_length = 0.3;
  AppliedForce force;
  force.name = "F";
  force.on = {"rod", "O"};
  force.force = {sample::expression("sin(5*t)"), sample::expression("exp(-t)")};
  force.torque = sample::expression("0.1*cos(t)");
  loaded.forces = {force};
  Model driven = sample::four_bar(1e8, 3000);
  driven.gravity = {0, -9.81};
  driven.motors = {sample::motor("M", "O2", MotorKind::kEffort, sample::expression("-0.1*rate", {"rate"}))};
  return {loaded, driven};
}

TEST(Allocations, NoneBetweenAcceptedImplicitSteps) {
  for (const Model& model : stepped_models())
    for (const int stages : {3, 5}) {
      const System system = build_system(model);
      RadauStepper stepper(system, 1e-6, stages);
      stepper.start(sample::plain_start(model, system), 1e-4);
      for (int i = 0; i < 3; ++i) ASSERT_TRUE(stepper.step(1));
      int steps = 0;
      EXPECT_EQ(allocations_during([&] {
                  while (steps < 200 && stepper.state().t < 1 && stepper.step(1)) ++steps;
                }),
                0)
          << model.bodies[0].name << " " << stages;
      EXPECT_GT(steps, 20) << stepper.failure();
    }
}

// Passes the kinks of two loads: 40 of them in a second.
TEST(Allocations, NoneAcrossEvents) {
  Model model = sample::pendulum(1e8, 3000);
  AppliedForce force;
  force.name = "F";
  force.on = {"rod", "O"};
  force.force = {sample::expression("if(sin(60*t) > 0, 1, -1)"), sample::expression("abs(cos(60*t))")};
  model.forces = {force};
  const System system = build_system(model);
  for (const int stages : {3, 5}) {
    RadauStepper stepper(system, 1e-5, stages);
    stepper.start(sample::plain_start(model, system), 1e-4);
    while (stepper.state().t < 0.1) ASSERT_TRUE(stepper.step(1));
    EXPECT_EQ(allocations_during([&] {
                while (stepper.state().t < 1 && stepper.step(1)) {}
              }),
              0);
    EXPECT_EQ(stepper.state().t, 1) << stepper.failure();
  }
}

TEST(Allocations, NoneBetweenAcceptedExplicitSteps) {
  for (const Model& model : stepped_models()) {
    const System system = build_system(model);
    Dopri5 stepper(system, 1e-3);
    stepper.start(sample::plain_start(model, system), 1e-6);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(stepper.step(1)) << stepper.failure();
    int steps = 0;
    EXPECT_EQ(allocations_during([&] {
                while (steps < 100 && stepper.step(1)) ++steps;
              }),
              0);
    EXPECT_EQ(steps, 100);
  }
}

TEST(Allocations, NoneForStatesInsideAStep) {
  for (const Model& model : stepped_models()) {
    const System system = build_system(model);
    RadauStepper stepper(system, 1e-6, 5);
    DenseOutput dense(system);
    stepper.start(sample::plain_start(model, system), 1e-4);
    ASSERT_TRUE(stepper.step(1));
    const State &a = stepper.previous(), &b = stepper.state();
    const auto middle = [&](double share) { dense.at(a.t + share * (b.t - a.t), a, b), dense.at(a.t + share * (b.t - a.t), a, b, stepper.nodes()); };
    middle(0.5);
    EXPECT_EQ(allocations_during([&] {
                for (const double share : {0.1, 0.3, 0.9}) middle(share);
              }),
              0);
  }
}

}  // namespace
}  // namespace pintle
