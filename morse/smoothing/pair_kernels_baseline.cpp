// Vectors of 16 bytes, as nearly every processor has them (SSE2, NEON); the compiler makes do where not.

#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {
namespace {

#include "morsel/morse/smoothing/pair_kernels.inc"
// after it:
#include "morsel/morse/smoothing/cell_kernels.inc"

using Double2 = double __attribute__((vector_size(16)));
using Int2 = std::int64_t __attribute__((vector_size(16)));
using UInt2 = std::uint64_t __attribute__((vector_size(16)));  // wraps round where Int2 must not
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using UInt4 = std::uint32_t __attribute__((vector_size(16)));

/// Fused where the processor does that fast.
template <class Vector, int lanes>
Vector fused(Vector a, Vector b, Vector c) {
#if defined(__FP_FAST_FMA) && defined(__FP_FAST_FMAF)
  Vector result;
  for (int i = 0; i < lanes; ++i) {
    if constexpr (lanes == 2)
      result[i] = __builtin_fma(a[i], b[i], c[i]);
    else
      result[i] = __builtin_fmaf(a[i], b[i], c[i]);
  }
  return result;
#else
  return a * b + c;
#endif
}

/// The common part of both.
template <class RealType, class VectorType, class IntsType, class Bits, int lanes>
struct Common {
  using Real = RealType;
  using Vector = VectorType;
  using Ints = IntsType;
  static constexpr int kLanes = lanes;

  static Vector zero() { return Vector{}; }
  static Vector all(Real a) { return Vector{} + a; }
  // Copies, since a vector must not be read where its elements were written.
  static Vector load(const Real* at) {
    Vector a;
    __builtin_memcpy(&a, at, sizeof(a));
    return a;
  }
  static void store(Real* at, Vector a) { __builtin_memcpy(at, &a, sizeof(a)); }
  // Bit by bit: arithmetic would quiet the NaN that an integer among floats may look like.
  static Vector broadcast(const Real* at) {
    Bits bits;
    __builtin_memcpy(&bits, at, sizeof(bits));
    return reinterpret_cast<Vector>(Ints{} + bits);
  }
  static Vector add(Vector a, Vector b) { return a + b; }
  static Vector subtract(Vector a, Vector b) { return a - b; }
  static Vector multiply(Vector a, Vector b) { return a * b; }
  static Vector fma(Vector a, Vector b, Vector c) { return fused<Vector, lanes>(a, b, c); }
  static Vector fnma(Vector a, Vector b, Vector c) { return fused<Vector, lanes>(-a, b, c); }
  static Vector where(Ints set, Vector a) {
    return reinterpret_cast<Vector>(set & reinterpret_cast<Ints>(a));
  }
  static Vector absolute(Vector a) { return where(~reinterpret_cast<Ints>(-zero()), a); }
  static Vector maximum(Vector a, Vector b) { return a > b ? a : b; }
  static std::uint32_t at_most(Vector a, Vector b) {
    const Ints set = a <= b;
    std::uint32_t bits = 0;
    for (int i = 0; i < lanes; ++i) bits |= static_cast<std::uint32_t>(set[i] & 1) << i;
    return bits;
  }
  static Ints lanes_of(std::uint32_t bits) {
    Ints set;
    for (int i = 0; i < lanes; ++i) set[i] = -static_cast<Bits>((bits >> i) & 1U);
    return set;
  }
  static Vector keep(Vector w, Vector e, Vector least) { return where(e >= least, w); }
  static Vector keep(Vector w, Vector e, Vector least, std::uint32_t bits) {
    return where((e >= least) & lanes_of(bits), w);
  }
  static Vector keep(Vector w, std::uint32_t bits) { return where(lanes_of(bits), w); }
};

struct Doubles : Common<double, Double2, Int2, std::int64_t, 2> {
  static Vector difference(Vector a, Vector b) { return a - b; }
  static Vector exp2_scale(Vector m) {
    const Int2 bits = reinterpret_cast<Int2>(m);
    const Int2 table = {kTable64[bits[0] & 7], kTable64[bits[1] & 7]};
    return reinterpret_cast<Vector>(reinterpret_cast<UInt2>(table) + (reinterpret_cast<UInt2>(bits) << 49));
  }
  static double sum(Vector a) { return a[0] + a[1]; }
  static double largest(Vector a) { return a[0] > a[1] ? a[0] : a[1]; }
};

struct Floats : Common<float, Float4, Int4, std::int32_t, 4> {
  static Vector difference(Vector a, Vector b) {
    return __builtin_convertvector(reinterpret_cast<Int4>(a) - reinterpret_cast<Int4>(b), Vector);
  }
  static Vector exp2_scale(Vector m) {
    const Int4 bits = reinterpret_cast<Int4>(m);
    const Int4 table = {kTable32[bits[0] & 7], kTable32[bits[1] & 7], kTable32[bits[2] & 7],
                        kTable32[bits[3] & 7]};
    return reinterpret_cast<Vector>(reinterpret_cast<UInt4>(table) + (reinterpret_cast<UInt4>(bits) << 20));
  }
  static float sum(Vector a) { return (a[0] + a[2]) + (a[1] + a[3]); }
  static float largest(Vector a) {
    const float first = a[0] > a[2] ? a[0] : a[2];
    const float second = a[1] > a[3] ? a[1] : a[3];
    return first > second ? first : second;
  }
};

}  // namespace

const PairKernels kBaselineKernels = kernels_of<Doubles, Floats>();

}  // namespace morsel::morse
