// Built into a copy of the sources by tools/mutants.py: each of its changes has a number, and PINTLE_MUTANT selects the change with which the program runs.
// When the program ends, the numbers of the changes that it has reached are appended to the file PINTLE_MUTANTS_REACHED, one per line.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace pintle_mutants {

inline constexpr int kMost = 1 << 15;

struct Switch {
  int active = std::getenv("PINTLE_MUTANT") ? std::atoi(std::getenv("PINTLE_MUTANT")) : 0;
  bool reached[kMost];  // used also before the constructor is called: functions may run while other files are initialized

  Switch() {}
  ~Switch() {
    const char* path = std::getenv("PINTLE_MUTANTS_REACHED");
    std::FILE* file = path ? std::fopen(path, "a") : nullptr;
    if (!file) return;
    for (int i = 0; i < kMost; ++i)
      if (reached[i]) std::fprintf(file, "%d\n", i);
    std::fclose(file);
  }
};
inline Switch the_switch;

inline bool is_active(int mutant) {
  the_switch.reached[mutant] = true;
  return the_switch.active == mutant;
}

inline int sign(int mutant) { return is_active(mutant) ? -1 : 1; }

template <class T>
T number(int mutant, T value) {
  return !is_active(mutant) ? value : value == T(0) ? T(1) : T(2 * value);
}

// `a < b` is built in as `a < Less{number} < b`, which binds like the original.
#define PINTLE_COMPARISON(Name, op, opposite)                                       \
  struct Name {                                                                     \
    int mutant;                                                                     \
  };                                                                                \
  template <class A>                                                                \
  struct Name##With {                                                               \
    const A& a;                                                                     \
    int mutant;                                                                     \
  };                                                                                \
  template <class A>                                                                \
  Name##With<A> operator op(const A& a, Name change) {                              \
    return {a, change.mutant};                                                      \
  }                                                                                 \
  template <class A, class B>                                                       \
  auto operator op(Name##With<A> left, const B& b) {                                \
    return is_active(left.mutant) ? left.a opposite b : left.a op b;                \
  }
PINTLE_COMPARISON(Less, <, >=)
PINTLE_COMPARISON(LessEqual, <=, >)
PINTLE_COMPARISON(Greater, >, <=)
PINTLE_COMPARISON(GreaterEqual, >=, <)
PINTLE_COMPARISON(Equal, ==, !=)
PINTLE_COMPARISON(NotEqual, !=, ==)
#undef PINTLE_COMPARISON

}  // namespace pintle_mutants
