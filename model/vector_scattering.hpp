// Included once per instruction set by files that foreach_target.h compiles again and again, hence no #pragma once.
// The functions of model/trigonometry.hpp and model/scattering.hpp on vectors, with the same bits.
#if defined(SKINFIT_VECTOR_SCATTERING) == defined(HWY_TARGET_TOGGLE)
#ifdef SKINFIT_VECTOR_SCATTERING
#undef SKINFIT_VECTOR_SCATTERING
#else
#define SKINFIT_VECTOR_SCATTERING
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "model/constants.hpp"
#include "model/scattering.hpp"
#include "model/trigonometry.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// As many rays at a time as a register of this instruction set holds.
using Doubles = hn::ScalableTag<double>;
using Vector = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;
using Words = hn::Rebind<std::int32_t, Doubles>;
using Integers = hn::RebindToSigned<Doubles>;
constexpr Doubles doubles;

/// `value` for every ray.
HWY_INLINE Vector constant(double value) {
    return hn::Set(doubles, value);
}

/// A polynomial with these coefficients, the constant first, by Horner's rule.
template <std::size_t terms>
HWY_INLINE Vector series(const std::array<double, terms>& coefficients, Vector x) {
    Vector sum = constant(coefficients[terms - 1]);
    for (std::size_t k = terms - 1; k-- > 0;) sum = hn::Add(hn::Mul(sum, x), constant(coefficients[k]));
    return sum;
}

/// The functions of model/trigonometry.hpp, operation by operation, so that rays get the same bits.
HWY_INLINE Vector cosine_of_turns(Vector turns) {
    const Vector angle = hn::Mul(constant(2.0 * pi), hn::Sub(hn::Abs(hn::Sub(turns, constant(0.5))), constant(0.25)));
    return hn::Mul(angle, series(detail::alternating_coefficients<8, 1>, hn::Mul(angle, angle)));
}

/// See `cosine_of_turns`.
HWY_INLINE Vector sine_of_turns(Vector turns) {
    return cosine_of_turns(
        hn::IfThenElse(hn::Lt(turns, constant(0.25)), hn::Add(turns, constant(0.75)), hn::Sub(turns, constant(0.25))));
}

/// See `cosine_of_turns`.
HWY_INLINE Vector decay(Vector depth) {
    const Vector limited = hn::Min(depth, constant(detail::most_decay));
    const Vector shifted = hn::Add(hn::Mul(limited, constant(detail::halvings_per_decay)), constant(detail::rounder));
    const Vector halvings = hn::Sub(shifted, constant(detail::rounder));
    const Vector rest = hn::Sub(hn::Sub(limited, hn::Mul(halvings, constant(detail::ln2_high))),
                                hn::Mul(halvings, constant(detail::ln2_low)));
    const Integers integers;
    const auto integer = hn::Sub(hn::BitCast(integers, shifted), hn::BitCast(integers, constant(detail::rounder)));
    const auto power = hn::BitCast(doubles, hn::ShiftLeft<52>(hn::Sub(hn::Set(integers, 1023), integer)));
    return hn::Mul(series(detail::decay_coefficients<detail::decay_terms>, rest), power);
}

/// The square root, 0 for what rounding has left below 0.
HWY_INLINE Vector root_or_zero(Vector x) {
    return hn::Sqrt(hn::Max(x, hn::Zero(doubles)));
}

/// The sine of an angle of that cosine.
HWY_INLINE Vector sine_to(Vector cosine) {
    return root_or_zero(hn::Sub(constant(1.0), hn::Mul(cosine, cosine)));
}

/// The polar cosine after a deflection: `deflected_cosine` of the scalar walk.
HWY_INLINE Vector deflected_cosine(Vector cosine, Vector deflection_cosine, Vector deflection_sine,
                                   Vector azimuth_cosine) {
    return hn::Add(hn::Mul(cosine, deflection_cosine),
                   hn::Mul(hn::Mul(sine_to(cosine), deflection_sine), azimuth_cosine));
}

/// The words of consecutive points, shifted, and the uniform numbers they stand for.
HWY_INLINE auto shifted_words(const std::uint32_t* points, std::uint32_t shift) {
    const Words words;
    return hn::Xor(hn::LoadU(words, reinterpret_cast<const std::int32_t*>(points)),
                   hn::Set(words, static_cast<std::int32_t>(shift)));
}

/// `to_uniform` of each word.
template <class WordVector>
HWY_INLINE Vector uniforms_of(WordVector bits) {
    // As signed numbers the words lie 2^31 too low once their highest bit is turned over.
    const auto centred = hn::Xor(bits, hn::Set(Words(), std::numeric_limits<std::int32_t>::min()));
    return hn::Mul(hn::Add(hn::PromoteTo(doubles, centred), constant(0x1p31 + 0.5)), constant(0x1p-32));
}

#if HWY_TARGET <= HWY_AVX3
/// `ForwardScattering::polar_angle` of the numbers `xi`, which stand for `bits`. The tables lie in registers, where
/// permutations look them up: gathers from memory take longer. The segment is the one that starts at the
/// last knot below xi, which is also where the guide leads: no xi is a multiple of 1 / guide_size.
class PolarAngles {
public:
    explicit PolarAngles(const ForwardScattering::Lookup& table)
        : offset_(load(table.offset)), slope_(load(table.slope)) {
        static_assert(ForwardScattering::table_size == 4 * hn::MaxLanes(doubles));
        hn::LoadInterleaved4(doubles, table.share, share_[0], share_[1], share_[2], share_[3]);
        const Integers integers;
        middle_ = hn::TableLookupLanes(share_[0], hn::IndicesFromVec(doubles, hn::Set(integers, 4)));
    }

    template <class WordVector>
    HWY_INLINE Vector operator()(WordVector /*bits*/, Vector xi) const {
        const Integers integers;
        // The last of every fourth knot that lies below xi, by halving; then how many of the three knots after it do.
        const Mask upper_half = hn::Lt(middle_, xi);
        auto fourth = hn::IfThenElseZero(hn::RebindMask(integers, upper_half), hn::Set(integers, 4));
        for (const std::int64_t step : {2, 1}) {
            const auto further = hn::Add(fourth, hn::Set(integers, step));
            const Mask beyond = hn::Lt(hn::TableLookupLanes(share_[0], hn::IndicesFromVec(doubles, further)), xi);
            fourth = hn::IfThenElse(hn::RebindMask(integers, beyond), further, fourth);
        }
        auto segment = hn::ShiftLeft<2>(fourth);
        for (const int knot : {1, 2, 3}) {
            const Mask beyond = hn::Lt(hn::TableLookupLanes(share_[knot], hn::IndicesFromVec(doubles, fourth)), xi);
            segment = hn::Sub(segment, hn::VecFromMask(integers, hn::RebindMask(integers, beyond)));
        }
        return hn::Add(entry(offset_, segment, upper_half), hn::Mul(entry(slope_, segment, upper_half), xi));
    }

private:
    using Table = std::array<__m512d, 4>;
    static Table load(const double* table) {
        return {_mm512_loadu_pd(table), _mm512_loadu_pd(table + 8), _mm512_loadu_pd(table + 16),
                _mm512_loadu_pd(table + 24)};
    }
    static HWY_INLINE Vector entry(const Table& table, hn::Vec<Integers> index, Mask upper_half) {
        return hn::IfThenElse(upper_half, Vector{_mm512_permutex2var_pd(table[2], index.raw, table[3])},
                              Vector{_mm512_permutex2var_pd(table[0], index.raw, table[1])});
    }

    Vector share_[4];  // of every fourth knot, from the first, second, third and fourth on
    Vector middle_;    // the share of knot 16
    Table offset_;
    Table slope_;
};
#else
/// The same by way of the guide.
class PolarAngles {
public:
    explicit PolarAngles(const ForwardScattering::Lookup& table) : table_(table) {}

    template <class WordVector>
    HWY_INLINE Vector operator()(WordVector bits, Vector xi) const {
        const Integers integers;
        const hn::Rebind<std::uint32_t, Doubles> unsigned_words;
        const hn::RebindToUnsigned<Doubles> unsigned_integers;
        const auto entry =
            hn::BitCast(integers, hn::PromoteTo(unsigned_integers, hn::ShiftRight<32 - ForwardScattering::guide_bits>(
                                                                       hn::BitCast(unsigned_words, bits))));
        auto segment = hn::GatherIndex(integers, table_.guide, entry);
        for (;;) {
            const Mask beyond = hn::Lt(hn::GatherIndex(doubles, table_.share + 1, segment), xi);
            if (hn::AllFalse(doubles, beyond)) break;
            segment = hn::Sub(segment, hn::VecFromMask(integers, hn::RebindMask(integers, beyond)));
        }
        return hn::Add(hn::GatherIndex(doubles, table_.offset, segment),
                       hn::Mul(hn::GatherIndex(doubles, table_.slope, segment), xi));
    }

private:
    ForwardScattering::Lookup table_;
};
#endif

/// `RayleighScattering` of the scalar walk.
HWY_INLINE Vector rayleigh_cosine(Edition edition, Vector xi) {
    if (edition == Edition::revised) {
        const Vector q = hn::Sub(hn::Mul(constant(8.0), xi), constant(4.0));
        Vector cosine = hn::Div(q, hn::Add(constant(3.0), hn::Mul(hn::Mul(q, q), constant(0.0625))));
        for (int step = 0; step < RayleighScattering::revised_steps; ++step) {
            const Vector square = hn::Mul(cosine, cosine);
            cosine = hn::Div(hn::Add(hn::Mul(hn::Mul(constant(2.0), square), cosine), q),
                             hn::Add(hn::Mul(constant(3.0), square), constant(3.0)));
        }
        return cosine;
    }
    Vector turns = xi;
    for (int step = 0; step < RayleighScattering::printed_steps; ++step) {
        const Vector excess = hn::Sub(hn::Add(turns, hn::Mul(sine_of_turns(turns), constant(1.0 / (6.0 * pi)))), xi);
        turns = hn::Sub(turns,
                        hn::Div(excess, hn::Add(constant(1.0), hn::Mul(cosine_of_turns(turns), constant(1.0 / 3.0)))));
    }
    return cosine_of_turns(hn::Mul(constant(0.5), turns));
}

}  // namespace skinfit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
