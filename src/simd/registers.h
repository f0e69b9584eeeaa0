// Two, four and eight numbers that go through the same arithmetic, and integers of the same bits. Eight are two registers of four: as one vector of the
// compiler's, they would pass through general registers, one by one, wherever the processor's registers are narrower.
#pragma once

// Code that uses lanes must be inlined into the function compiled for wide registers.
#define PINTLE_LANES [[gnu::always_inline]] inline

namespace pintle {

typedef double TwoReals __attribute__((vector_size(16)));
typedef unsigned long long TwoBits __attribute__((vector_size(16)));
typedef double FourReals __attribute__((vector_size(32)));
typedef unsigned long long FourBits __attribute__((vector_size(32)));

struct EightBits {
  FourBits low, high;
  PINTLE_LANES friend EightBits operator&(const EightBits& a, const EightBits& b) { return {a.low & b.low, a.high & b.high}; }
  PINTLE_LANES friend EightBits operator|(const EightBits& a, const EightBits& b) { return {a.low | b.low, a.high | b.high}; }
  PINTLE_LANES friend EightBits operator^(const EightBits& a, const EightBits& b) { return {a.low ^ b.low, a.high ^ b.high}; }
  PINTLE_LANES friend EightBits operator&(const EightBits& a, unsigned long long b) { return {a.low & b, a.high & b}; }
  PINTLE_LANES friend EightBits operator+(const EightBits& a, unsigned long long b) { return {a.low + b, a.high + b}; }
  PINTLE_LANES friend EightBits operator<<(const EightBits& a, int n) { return {a.low << n, a.high << n}; }
  PINTLE_LANES friend EightBits operator-(const EightBits& a) { return {-a.low, -a.high}; }
  PINTLE_LANES friend EightBits operator~(const EightBits& a) { return {~a.low, ~a.high}; }
};

struct EightReals {
  FourReals low, high;

  PINTLE_LANES double operator[](int i) const { return i < 4 ? low[i] : high[i - 4]; }
  PINTLE_LANES EightReals& operator+=(const EightReals& b) { return *this = *this + b; }
  PINTLE_LANES EightReals& operator-=(const EightReals& b) { return *this = *this - b; }
  PINTLE_LANES EightReals& operator*=(const EightReals& b) { return *this = *this * b; }
  PINTLE_LANES friend EightReals operator+(const EightReals& a, const EightReals& b) { return {a.low + b.low, a.high + b.high}; }
  PINTLE_LANES friend EightReals operator-(const EightReals& a, const EightReals& b) { return {a.low - b.low, a.high - b.high}; }
  PINTLE_LANES friend EightReals operator*(const EightReals& a, const EightReals& b) { return {a.low * b.low, a.high * b.high}; }
  PINTLE_LANES friend EightReals operator/(const EightReals& a, const EightReals& b) { return {a.low / b.low, a.high / b.high}; }
  PINTLE_LANES friend EightReals operator-(const EightReals& a) { return {-a.low, -a.high}; }
  PINTLE_LANES friend EightReals operator+(const EightReals& a, double b) { return {a.low + b, a.high + b}; }
  PINTLE_LANES friend EightReals operator+(double a, const EightReals& b) { return {a + b.low, a + b.high}; }
  PINTLE_LANES friend EightReals operator-(const EightReals& a, double b) { return {a.low - b, a.high - b}; }
  PINTLE_LANES friend EightReals operator-(double a, const EightReals& b) { return {a - b.low, a - b.high}; }
  PINTLE_LANES friend EightReals operator*(double a, const EightReals& b) { return {a * b.low, a * b.high}; }
  PINTLE_LANES friend EightReals operator*(const EightReals& a, double b) { return {a.low * b, a.high * b}; }
  PINTLE_LANES friend EightReals operator/(double a, const EightReals& b) { return {a / b.low, a / b.high}; }
};

/// x where a is less than b; elsewhere y.
template <class Reals>
PINTLE_LANES Reals where_less(const Reals& a, const Reals& b, const Reals& x, const Reals& y) {
  return a < b ? x : y;
}
PINTLE_LANES EightReals where_less(const EightReals& a, const EightReals& b, const EightReals& x, const EightReals& y) {
  return {where_less(a.low, b.low, x.low, y.low), where_less(a.high, b.high, x.high, y.high)};
}

template <class Reals>
PINTLE_LANES void set_lane(Reals& to, int i, double x) {
  to[i] = x;
}
PINTLE_LANES void set_lane(EightReals& to, int i, double x) {
  if (i < 4) to.low[i] = x;
  else to.high[i - 4] = x;
}

/// The same bits, read as integers or as numbers.
PINTLE_LANES TwoBits bits_of(const TwoReals& a) { return (TwoBits)a; }
PINTLE_LANES FourBits bits_of(const FourReals& a) { return (FourBits)a; }
PINTLE_LANES EightBits bits_of(const EightReals& a) { return {bits_of(a.low), bits_of(a.high)}; }
PINTLE_LANES TwoReals reals_of(const TwoBits& a) { return (TwoReals)a; }
PINTLE_LANES FourReals reals_of(const FourBits& a) { return (FourReals)a; }
PINTLE_LANES EightReals reals_of(const EightBits& a) { return {reals_of(a.low), reals_of(a.high)}; }

/// The register type with room for N numbers, and that for as many integers.
template <int N> struct Registers;
template <> struct Registers<1> {
  using Reals = TwoReals;
  using Bits = TwoBits;
};
template <> struct Registers<3> {
  using Reals = FourReals;
  using Bits = FourBits;
};
template <> struct Registers<4> : Registers<3> {};
template <> struct Registers<5> {
  using Reals = EightReals;
  using Bits = EightBits;
};
template <> struct Registers<8> : Registers<5> {};

}  // namespace pintle
