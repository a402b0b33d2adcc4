// Compiled with the flags of AVX-512 F, DQ, BW and VL, see pair_kernels.h.

#include <immintrin.h>

#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {
namespace {

#include "morsel/morse/smoothing/pair_kernels.inc"
// after it:
#include "morsel/morse/smoothing/cell_kernels.inc"

struct Doubles {
  using Real = double;
  using Vector = __m512d;
  static constexpr int kLanes = 8;

  static Vector zero() { return _mm512_setzero_pd(); }
  static Vector all(double a) { return _mm512_set1_pd(a); }
  static Vector load(const double* at) { return _mm512_load_pd(at); }
  static void store(double* at, Vector a) { _mm512_store_pd(at, a); }
  static Vector broadcast(const double* at) { return _mm512_set1_pd(*at); }
  static Vector add(Vector a, Vector b) { return _mm512_add_pd(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm512_sub_pd(a, b); }
  static Vector multiply(Vector a, Vector b) { return _mm512_mul_pd(a, b); }
  static Vector difference(Vector a, Vector b) { return subtract(a, b); }
  static Vector fma(Vector a, Vector b, Vector c) { return _mm512_fmadd_pd(a, b, c); }
  static Vector fnma(Vector a, Vector b, Vector c) { return _mm512_fnmadd_pd(a, b, c); }
  static Vector absolute(Vector a) { return _mm512_abs_pd(a); }
  static Vector maximum(Vector a, Vector b) { return _mm512_max_pd(a, b); }
  static std::uint32_t at_most(Vector a, Vector b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static Vector exp2_scale(Vector m) {
    const __m512i bits = _mm512_castpd_si512(m);
    const __m512i table = _mm512_load_si512(kTable64);
    return _mm512_castsi512_pd(
        _mm512_add_epi64(_mm512_permutexvar_epi64(bits, table), _mm512_slli_epi64(bits, 49)));
  }
  static Vector keep(Vector w, Vector e, Vector least) {
    return _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(e, least, _CMP_GE_OQ), w);
  }
  static Vector keep(Vector w, Vector e, Vector least, std::uint32_t bits) {
    return _mm512_maskz_mov_pd(_mm512_mask_cmp_pd_mask(static_cast<__mmask8>(bits), e, least, _CMP_GE_OQ), w);
  }
  static Vector keep(Vector w, std::uint32_t bits) {
    return _mm512_maskz_mov_pd(static_cast<__mmask8>(bits), w);
  }
  static double sum(Vector a) {
    const __m256d b = _mm256_add_pd(_mm512_castpd512_pd256(a), _mm512_extractf64x4_pd(a, 1));
    const __m128d c = _mm_add_pd(_mm256_castpd256_pd128(b), _mm256_extractf128_pd(b, 1));
    return _mm_cvtsd_f64(_mm_add_sd(c, _mm_unpackhi_pd(c, c)));
  }
  static double largest(Vector a) { return _mm512_reduce_max_pd(a); }
};

struct Floats {
  using Real = float;
  using Vector = __m512;
  static constexpr int kLanes = 16;

  static Vector zero() { return _mm512_setzero_ps(); }
  static Vector all(float a) { return _mm512_set1_ps(a); }
  static Vector load(const float* at) { return _mm512_load_ps(at); }
  static void store(float* at, Vector a) { _mm512_store_ps(at, a); }
  static Vector broadcast(const float* at) { return _mm512_set1_ps(*at); }
  static Vector add(Vector a, Vector b) { return _mm512_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm512_sub_ps(a, b); }
  static Vector multiply(Vector a, Vector b) { return _mm512_mul_ps(a, b); }
  static Vector difference(Vector a, Vector b) {
    return _mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
  }
  static Vector fma(Vector a, Vector b, Vector c) { return _mm512_fmadd_ps(a, b, c); }
  static Vector fnma(Vector a, Vector b, Vector c) { return _mm512_fnmadd_ps(a, b, c); }
  static Vector absolute(Vector a) { return _mm512_abs_ps(a); }
  static Vector maximum(Vector a, Vector b) { return _mm512_max_ps(a, b); }
  static Vector exp2_scale(Vector m) {
    const __m512i bits = _mm512_castps_si512(m);
    const __m512i table =
        _mm512_broadcast_i32x8(_mm256_load_si256(reinterpret_cast<const __m256i*>(kTable32)));
    return _mm512_castsi512_ps(
        _mm512_add_epi32(_mm512_permutexvar_epi32(bits, table), _mm512_slli_epi32(bits, 20)));
  }
  static Vector keep(Vector w, Vector e, Vector least) {
    return _mm512_maskz_mov_ps(_mm512_cmp_ps_mask(e, least, _CMP_GE_OQ), w);
  }
  static Vector keep(Vector w, Vector e, Vector least, std::uint32_t bits) {
    return _mm512_maskz_mov_ps(_mm512_mask_cmp_ps_mask(static_cast<__mmask16>(bits), e, least, _CMP_GE_OQ),
                               w);
  }
  static Vector keep(Vector w, std::uint32_t bits) {
    return _mm512_maskz_mov_ps(static_cast<__mmask16>(bits), w);
  }
  static float sum(Vector a) {
    const __m256 b = _mm256_add_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1));
    const __m128 c = _mm_add_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
    const __m128 d = _mm_add_ps(c, _mm_movehl_ps(c, c));
    return _mm_cvtss_f32(_mm_add_ss(d, _mm_shuffle_ps(d, d, 1)));
  }
  static float largest(Vector a) { return _mm512_reduce_max_ps(a); }
};

}  // namespace

const PairKernels kAvx512Kernels = kernels_of<Doubles, Floats>();

}  // namespace morsel::morse
