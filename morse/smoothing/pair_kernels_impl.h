// The kernels of pair_kernels.h over a vector type V. Included once by each pair_kernels_*.cpp, inside its
// unnamed namespace (see pair_kernels.h for why); deliberately without #pragma once and includes.
//
// V::Vector holds V::kLanes of V::Real; a block of L points has L / kLanes parts. V needs
//   zero load store broadcast add subtract multiply difference (of values) fma(a, b, c) = ab + c, fnma(a, b, c) = c − ab, absolute,
//   maximum, at_most(a, b) → bits, exp2_scale(m), keep(w, e, least), keep(w, e, least, bits), keep(w, bits),
//   sum and largest of one vector's lanes, by halves.

/// 2^e for e ≤ 0 in vectors: 2^(k/8) by table and exponent, the rest |r| ≤ 1/16 by a polynomial that
/// interpolates (2^r − 1) / r at Chebyshev's nodes. 1.8e-15 (double) and 3.8e-8 (float) from the true value,
/// plus rounding; exactly 1 at 0.
template <class Real>
struct Exp2;

template <>
struct Exp2<double> {
  static constexpr double kMagic = 0x1.8p49;  // adding it rounds to a multiple of 1/8
  static constexpr double kLeast = -1000;     // what is smaller counts as 0
  static constexpr double kCoefficients[] = {0.0001540430475647682, 0.0013334451887507994,
                                             0.009618129096285193,  0.055504108533901385,
                                             0.24022650695910316,   0.6931471805599737};
};

template <>
struct Exp2<float> {
  static constexpr float kMagic = 0x1.8p20F;
  static constexpr float kLeast = -120;
  static constexpr float kCoefficients[] = {0.05550801511160262F, 0.24025468639384956F, 0.6931471805599453F};
};

/// Bits of 2^(j/8), less j at the place where the exponent's eighths would be.
alignas(64) constexpr std::int64_t kTable64[8] = {0x3ff0000000000000, 0x3fef72b83c7d517b, 0x3fef06fe0a31b715,
                                                  0x3feebfdad5362a27, 0x3feea09e667f3bcd, 0x3feeace5422aa0db,
                                                  0x3feee89f995ad3ad, 0x3fef5818dcfba487};
alignas(64) constexpr std::int32_t kTable32[8] = {0x3f800000, 0x3f7b95c2, 0x3f7837f0, 0x3f75fed7,
                                                  0x3f7504f3, 0x3f75672a, 0x3f7744fd, 0x3f7ac0c7};

/// 2^e, or anything where e < kLeast.
template <class V>
typename V::Vector exp2_of(typename V::Vector e) {
  using E = Exp2<typename V::Real>;
  using Vector = typename V::Vector;
  const Vector magic = V::all(E::kMagic);
  const Vector m = V::add(e, magic);
  const Vector r = V::subtract(e, V::subtract(m, magic));
  Vector p = V::all(E::kCoefficients[0]);
  for (std::size_t i = 1; i < sizeof(E::kCoefficients) / sizeof(E::kCoefficients[0]); ++i)
    p = V::fma(p, r, V::all(E::kCoefficients[i]));
  p = V::fma(p, r, V::all(1));
  return V::multiply(p, V::exp2_scale(m));
}

/// Nothing is cut off.
struct Whole {
  template <class V>
  typename V::Vector weight(typename V::Vector w, typename V::Vector e) const {
    return V::keep(w, e, V::all(Exp2<typename V::Real>::kLeast));
  }
  template <class V>
  typename V::Vector value(typename V::Vector d) const {
    return d;
  }
};

/// Only the lanes whose bits are set count.
struct Cut {
  std::uint32_t bits;
  template <class V>
  typename V::Vector weight(typename V::Vector w, typename V::Vector e) const {
    return V::keep(w, e, V::all(Exp2<typename V::Real>::kLeast), bits);
  }
  template <class V>
  typename V::Vector value(typename V::Vector d) const {
    return V::keep(d, bits);
  }
};

/// What a block holds of its points, a part of it or one point for all lanes.
template <class V, int L>
struct Points {
  typename V::Vector x, y, z, value, per_sigma;

  static Points load(const typename V::Real* at, bool has_sigma) {
    return {V::load(at), V::load(at + L), V::load(at + 2 * L), V::load(at + 3 * L),
            has_sigma ? V::load(at + 4 * L) : V::zero()};
  }
  static Points broadcast(const typename V::Real* at, bool has_sigma) {
    return {V::broadcast(at), V::broadcast(at + L), V::broadcast(at + 2 * L), V::broadcast(at + 3 * L),
            has_sigma ? V::broadcast(at + 4 * L) : V::zero()};
  }
};

/// −‖x − v‖², the exponent of the weight of distances.
template <class V, class P>
typename V::Vector distance_exponent(const P& v, const P& x) {
  const typename V::Vector dx = V::subtract(x.x, v.x);
  const typename V::Vector dy = V::subtract(x.y, v.y);
  const typename V::Vector dz = V::subtract(x.z, v.z);
  return V::fnma(dx, dx, V::fnma(dy, dy, V::fnma(dz, dz, V::zero())));
}

/// One weight for both directions of a pair. `own` is added up for v, `other` for the points x.
template <class V, int L>
struct FixedRule {
  using Vector = typename V::Vector;
  static constexpr bool kHasSigma = false;
  static constexpr int kSums = 2;
  static constexpr bool kMaximum = false;

  template <class Limit>
  static void visit(const Points<V, L>& v, const Points<V, L>& x, Vector unit, Vector* own, Vector* other,
                    Limit limit) {
    const Vector d = V::difference(x.value, v.value);
    const Vector t = V::multiply(d, unit);
    const Vector e = V::fnma(t, t, distance_exponent<V>(v, x));
    const Vector w = limit.template weight<V>(exp2_of<V>(e), e);
    own[0] = V::fma(w, d, own[0]);
    own[1] = V::add(own[1], w);
    other[0] = V::fnma(w, d, other[0]);
    other[1] = V::add(other[1], w);
  }
};

/// Each point has its own σ_s.
template <class V, int L>
struct LocalRule {
  using Vector = typename V::Vector;
  static constexpr bool kHasSigma = true;
  static constexpr int kSums = 2;
  static constexpr bool kMaximum = false;

  template <class Limit>
  static void visit(const Points<V, L>& v, const Points<V, L>& x, Vector /*unit*/, Vector* own, Vector* other,
                    Limit limit) {
    const Vector d = V::difference(x.value, v.value);
    const Vector distance = distance_exponent<V>(v, x);
    const Vector t = V::multiply(d, v.per_sigma);
    const Vector e = V::fnma(t, t, distance);
    const Vector w = limit.template weight<V>(exp2_of<V>(e), e);
    own[0] = V::fma(w, d, own[0]);
    own[1] = V::add(own[1], w);
    const Vector t2 = V::multiply(d, x.per_sigma);
    const Vector e2 = V::fnma(t2, t2, distance);
    const Vector w2 = limit.template weight<V>(exp2_of<V>(e2), e2);
    other[0] = V::fnma(w2, d, other[0]);
    other[1] = V::add(other[1], w2);
  }
};

/// The largest difference.
template <class V, int L>
struct SpreadRule {
  using Vector = typename V::Vector;
  static constexpr bool kHasSigma = false;
  static constexpr int kSums = 1;
  static constexpr bool kMaximum = true;

  template <class Limit>
  static void visit(const Points<V, L>& v, const Points<V, L>& x, Vector /*unit*/, Vector* own, Vector* other,
                    Limit limit) {
    const Vector d = limit.template value<V>(V::absolute(V::difference(x.value, v.value)));
    own[0] = V::maximum(own[0], d);
    other[0] = V::maximum(other[0], d);
  }
};

/// One number of L: halves are put together again and again, whatever the vectors' length.
template <class V, int L, bool maximum>
typename V::Real reduce(const typename V::Real* lanes) {
  typename V::Vector part[L / V::kLanes];
  for (int i = 0; i < L / V::kLanes; ++i) part[i] = V::load(lanes + i * V::kLanes);
  for (int half = L / V::kLanes / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i)
      part[i] = maximum ? V::maximum(part[i], part[i + half]) : V::add(part[i], part[i + half]);
  return maximum ? V::largest(part[0]) : V::sum(part[0]);
}

template <bool maximum>
void add_to(double& sum, double more) {
  sum = maximum ? (more > sum ? more : sum) : sum + more;
}

template <template <class, int> class RuleOf, class V, int L, class Mask>
void visit_pairs(const TilePairs<Mask>& pairs, const typename V::Real* points, double* totals,
                 typename V::Real value_unit, const PairScratch<typename V::Real>& scratch) {
  using Rule = RuleOf<V, L>;
  using Real = typename V::Real;
  using Vector = typename V::Vector;
  constexpr int kSums = Rule::kSums;
  constexpr int kStride = (Rule::kHasSigma ? 5 : 4) * L;
  constexpr int kParts = L / V::kLanes;
  alignas(64) Real own[L * kSums * L];  // per point of the tile, per sum, lanes
  const Vector unit = V::all(value_unit);
  Real* sums;
  if constexpr (sizeof(Real) == sizeof(double)) {
    sums = totals;
  } else {
    sums = scratch.sums;
    for (std::size_t i = 0; i < pairs.reached * kSums * L; ++i) sums[i] = 0;
  }
  std::uint32_t run = 0;
  std::uint32_t mixed = 0;
  for (std::size_t tile = 0; tile < pairs.tiles; ++tile) {
    for (int i = 0; i < L * kSums * L; i += V::kLanes) V::store(own + i, V::zero());
    const Real* const centers = points + tile * kStride;

    // Lists first, so that the loops over them are long and their ends easily foreseen.
    std::size_t wholes = 0;
    for (; run < pairs.run_ends[tile]; ++run)
      for (std::uint32_t b = pairs.runs[2 * run]; b < pairs.runs[2 * run + 1]; ++b)
        scratch.whole[wholes++] = b;
    std::size_t steps = 0;
    for (; mixed < pairs.block_ends[tile]; ++mixed)
      for (int i = 0; i < L; ++i) {
        const Mask mask = pairs.masks[mixed * L + static_cast<unsigned>(i)];
        scratch.steps[steps] = {pairs.blocks[mixed], static_cast<std::uint16_t>(i), mask};
        steps += mask != 0;
      }

    for (std::size_t k = 0; k < wholes; ++k) {
      const std::size_t b = scratch.whole[k];
      for (int offset = 0; offset < L; offset += V::kLanes) {
        Real* const to = sums + b * kSums * L + offset;
        Vector other[kSums];
        for (int s = 0; s < kSums; ++s) other[s] = V::zero();
        for (int i = 0; i < L; ++i) {
          Real* const at = own + i * kSums * L + offset;
          Vector mine[kSums];
          for (int s = 0; s < kSums; ++s) mine[s] = V::load(at + s * L);
          Rule::visit(Points<V, L>::broadcast(centers + i, Rule::kHasSigma),
                      Points<V, L>::load(points + b * kStride + offset, Rule::kHasSigma), unit, mine, other,
                      Whole{});
          for (int s = 0; s < kSums; ++s) V::store(at + s * L, mine[s]);
        }
        for (int s = 0; s < kSums; ++s) {
          const Vector before = V::load(to + s * L);
          V::store(to + s * L, Rule::kMaximum ? V::maximum(before, other[s]) : V::add(before, other[s]));
        }
      }
    }
    for (std::size_t k = 0; k < steps; ++k) {
      const PairStep step = scratch.steps[k];
      for (int part = 0; part < kParts; ++part) {
        const int offset = part * V::kLanes;
        Real* const to = sums + std::size_t{step.block} * kSums * L + offset;
        Real* const at = own + step.point * kSums * L + offset;
        Vector other[kSums];
        Vector mine[kSums];
        for (int s = 0; s < kSums; ++s) other[s] = V::load(to + s * L);
        for (int s = 0; s < kSums; ++s) mine[s] = V::load(at + s * L);
        Rule::visit(Points<V, L>::broadcast(centers + step.point, Rule::kHasSigma),
                    Points<V, L>::load(points + std::size_t{step.block} * kStride + offset, Rule::kHasSigma),
                    unit, mine, other, Cut{static_cast<std::uint32_t>(step.mask) >> offset});
        for (int s = 0; s < kSums; ++s) V::store(to + s * L, other[s]);
        for (int s = 0; s < kSums; ++s) V::store(at + s * L, mine[s]);
      }
    }
    for (int i = 0; i < L; ++i)
      for (int s = 0; s < kSums; ++s)
        add_to<Rule::kMaximum>(
            totals[(tile * kSums + static_cast<unsigned>(s)) * L + static_cast<unsigned>(i)],
            static_cast<double>(reduce<V, L, Rule::kMaximum>(own + (i * kSums + s) * L)));
    // Long sums of floats would lose digits.
    constexpr std::size_t kTiles = 8;
    if (sizeof(Real) < sizeof(double) && (tile % kTiles == kTiles - 1 || tile + 1 == pairs.tiles))
      for (std::size_t i = 0; i < pairs.reached * kSums * L; ++i) {
        add_to<Rule::kMaximum>(totals[i], static_cast<double>(sums[i]));
        sums[i] = 0;
      }
  }
}

template <class V, int L, class Mask>
void cut(const double* tile, const double* coordinates, const std::uint32_t* blocks, std::size_t count,
         double square, Mask* masks) {
  using Vector = typename V::Vector;
  const Vector most = V::all(square);
  for (std::size_t k = 0; k < count; ++k) {
    const double* const block = coordinates + std::size_t{blocks[k]} * 3 * L;
    for (int i = 0; i < L; ++i) {
      std::uint32_t bits = 0;
      for (int offset = 0; offset < L; offset += V::kLanes) {
        const Vector dx = V::subtract(V::load(block + offset), V::broadcast(tile + i));
        const Vector dy = V::subtract(V::load(block + L + offset), V::broadcast(tile + L + i));
        const Vector dz = V::subtract(V::load(block + 2 * L + offset), V::broadcast(tile + 2 * L + i));
        const Vector s = V::add(V::multiply(dx, dx), V::add(V::multiply(dy, dy), V::multiply(dz, dz)));
        bits |= V::at_most(s, most) << offset;
      }
      masks[k * L + static_cast<unsigned>(i)] = static_cast<Mask>(bits);
    }
  }
}

template <class V, int L, class Mask>
constexpr PairFunctions<typename V::Real, Mask> functions_of() {
  return {visit_pairs<FixedRule, V, L, Mask>, visit_pairs<LocalRule, V, L, Mask>,
          visit_pairs<SpreadRule, V, L, Mask>};
}

template <class Doubles, class Floats>
constexpr PairKernels kernels_of() {
  return {cut<Doubles, 8, std::uint8_t>, cut<Doubles, 16, std::uint16_t>,
          functions_of<Doubles, 8, std::uint8_t>(), functions_of<Doubles, 16, std::uint16_t>(),
          functions_of<Floats, 16, std::uint16_t>()};
}
