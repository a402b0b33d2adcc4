// Compiled with the flags of AVX2 and FMA, see pair_kernels.h.

#include <immintrin.h>

#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {
namespace {

#include "morsel/morse/smoothing/pair_kernels.inc"
// after it:
#include "morsel/morse/smoothing/cell_kernels.inc"

struct Doubles {
  using Real = double;
  using Vector = __m256d;
  static constexpr int kLanes = 4;

  static Vector zero() { return _mm256_setzero_pd(); }
  static Vector all(double a) { return _mm256_set1_pd(a); }
  static Vector load(const double* at) { return _mm256_load_pd(at); }
  static void store(double* at, Vector a) { _mm256_store_pd(at, a); }
  static Vector broadcast(const double* at) { return _mm256_broadcast_sd(at); }
  static Vector add(Vector a, Vector b) { return _mm256_add_pd(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm256_sub_pd(a, b); }
  static Vector multiply(Vector a, Vector b) { return _mm256_mul_pd(a, b); }
  static Vector difference(Vector a, Vector b) { return subtract(a, b); }
  static Vector fma(Vector a, Vector b, Vector c) { return _mm256_fmadd_pd(a, b, c); }
  static Vector fnma(Vector a, Vector b, Vector c) { return _mm256_fnmadd_pd(a, b, c); }
  static Vector absolute(Vector a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
  static Vector maximum(Vector a, Vector b) { return _mm256_max_pd(a, b); }
  static std::uint32_t at_most(Vector a, Vector b) {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ)));
  }
  static Vector exp2_scale(Vector m) {
    // The table in two halves of four, looked up as pairs of floats; bit 2 chooses the half.
    const __m256i bits = _mm256_castpd_si256(m);
    const __m256 low = _mm256_load_ps(reinterpret_cast<const float*>(kTable64));
    const __m256 high = _mm256_load_ps(reinterpret_cast<const float*>(kTable64 + 4));
    const __m256i twice = _mm256_add_epi32(bits, bits);
    const __m256i pair =
        _mm256_or_si256(_mm256_shuffle_epi32(twice, 0xA0), _mm256_set1_epi64x(std::int64_t{1} << 32));
    const Vector a = _mm256_castps_pd(_mm256_permutevar8x32_ps(low, pair));
    const Vector b = _mm256_castps_pd(_mm256_permutevar8x32_ps(high, pair));
    const Vector half = _mm256_castsi256_pd(_mm256_slli_epi64(bits, 61));
    return _mm256_castsi256_pd(
        _mm256_add_epi64(_mm256_castpd_si256(_mm256_blendv_pd(a, b, half)), _mm256_slli_epi64(bits, 49)));
  }
  static Vector lanes_of(std::uint32_t bits) {
    const __m256i lane = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(bits), lane);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, lane));
  }
  static Vector keep(Vector w, Vector e, Vector least) {
    return _mm256_and_pd(_mm256_cmp_pd(e, least, _CMP_GE_OQ), w);
  }
  static Vector keep(Vector w, Vector e, Vector least, std::uint32_t bits) {
    return _mm256_and_pd(_mm256_and_pd(_mm256_cmp_pd(e, least, _CMP_GE_OQ), lanes_of(bits)), w);
  }
  static Vector keep(Vector w, std::uint32_t bits) { return _mm256_and_pd(lanes_of(bits), w); }
  static double sum(Vector a) {
    const __m128d c = _mm_add_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_add_sd(c, _mm_unpackhi_pd(c, c)));
  }
  static double largest(Vector a) {
    const __m128d c = _mm_max_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_max_sd(c, _mm_unpackhi_pd(c, c)));
  }
};

struct Floats {
  using Real = float;
  using Vector = __m256;
  static constexpr int kLanes = 8;

  static Vector zero() { return _mm256_setzero_ps(); }
  static Vector all(float a) { return _mm256_set1_ps(a); }
  static Vector load(const float* at) { return _mm256_load_ps(at); }
  static void store(float* at, Vector a) { _mm256_store_ps(at, a); }
  static Vector broadcast(const float* at) { return _mm256_broadcast_ss(at); }
  static Vector add(Vector a, Vector b) { return _mm256_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm256_sub_ps(a, b); }
  static Vector multiply(Vector a, Vector b) { return _mm256_mul_ps(a, b); }
  static Vector difference(Vector a, Vector b) {
    return _mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
  }
  static Vector fma(Vector a, Vector b, Vector c) { return _mm256_fmadd_ps(a, b, c); }
  static Vector fnma(Vector a, Vector b, Vector c) { return _mm256_fnmadd_ps(a, b, c); }
  static Vector absolute(Vector a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a); }
  static Vector maximum(Vector a, Vector b) { return _mm256_max_ps(a, b); }
  static Vector exp2_scale(Vector m) {
    const __m256i bits = _mm256_castps_si256(m);
    const __m256i table = _mm256_load_si256(reinterpret_cast<const __m256i*>(kTable32));
    return _mm256_castsi256_ps(
        _mm256_add_epi32(_mm256_permutevar8x32_epi32(table, bits), _mm256_slli_epi32(bits, 20)));
  }
  static Vector lanes_of(std::uint32_t bits) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lane));
  }
  static Vector keep(Vector w, Vector e, Vector least) {
    return _mm256_and_ps(_mm256_cmp_ps(e, least, _CMP_GE_OQ), w);
  }
  static Vector keep(Vector w, Vector e, Vector least, std::uint32_t bits) {
    return _mm256_and_ps(_mm256_and_ps(_mm256_cmp_ps(e, least, _CMP_GE_OQ), lanes_of(bits)), w);
  }
  static Vector keep(Vector w, std::uint32_t bits) { return _mm256_and_ps(lanes_of(bits), w); }
  static float sum(Vector a) {
    const __m128 c = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 d = _mm_add_ps(c, _mm_movehl_ps(c, c));
    return _mm_cvtss_f32(_mm_add_ss(d, _mm_shuffle_ps(d, d, 1)));
  }
  static float largest(Vector a) {
    const __m128 c = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 d = _mm_max_ps(c, _mm_movehl_ps(c, c));
    return _mm_cvtss_f32(_mm_max_ss(d, _mm_shuffle_ps(d, d, 1)));
  }
};

}  // namespace

const PairKernels kAvx2Kernels = kernels_of<Doubles, Floats>();

}  // namespace morsel::morse
