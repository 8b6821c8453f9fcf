// Compiled once per instruction set by foreach_target.h, then chosen at run time. Every step is an elementwise IEEE
// operation in the order of model/random_walk.hpp, products and sums unfused (CMakeLists.txt forbids contraction), so
// that the bits depend neither on the instruction set nor on which rays share a vector.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/group_event.cpp"  // NOLINT
#include <hwy/foreach_target.h>                     // must come before highway.h
//
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "model/constants.hpp"
#include "model/group_event.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Vector = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;
using Words = hn::Rebind<std::int32_t, Doubles>;
using Integers = hn::RebindToSigned<Doubles>;
constexpr Doubles doubles;

HWY_INLINE Vector constant(double value) {
    return hn::Set(doubles, value);
}

template <std::size_t terms>
HWY_INLINE Vector series(const std::array<double, terms>& coefficients, Vector x) {
    Vector sum = constant(coefficients[terms - 1]);
    for (std::size_t k = terms - 1; k-- > 0;) sum = hn::Add(hn::Mul(sum, x), constant(coefficients[k]));
    return sum;
}

HWY_INLINE Vector cosine_of_turns(Vector turns) {
    const Vector angle = hn::Mul(constant(2.0 * pi), hn::Sub(hn::Abs(hn::Sub(turns, constant(0.5))), constant(0.25)));
    return hn::Mul(angle, series(detail::alternating_coefficients<8, 1>, hn::Mul(angle, angle)));
}

HWY_INLINE Vector sine_of_turns(Vector turns) {
    return cosine_of_turns(
        hn::IfThenElse(hn::Lt(turns, constant(0.25)), hn::Add(turns, constant(0.75)), hn::Sub(turns, constant(0.25))));
}

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

HWY_INLINE Vector root_or_zero(Vector x) {
    return hn::Sqrt(hn::Max(x, hn::Zero(doubles)));
}

HWY_INLINE Vector sine_to(Vector cosine) {
    return root_or_zero(hn::Sub(constant(1.0), hn::Mul(cosine, cosine)));
}

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

template <class WordVector>
HWY_INLINE Vector uniforms_of(WordVector bits) {
    // As signed numbers the words lie 2^31 too low once their highest bit is turned over.
    const auto centred = hn::Xor(bits, hn::Set(Words(), std::numeric_limits<std::int32_t>::min()));
    return hn::Mul(hn::Add(hn::PromoteTo(doubles, centred), constant(0x1p31 + 0.5)), constant(0x1p-32));
}

#if HWY_TARGET <= HWY_AVX3
/// `ForwardScattering::polar_angle` of vectors. The tables lie in registers, where permutations look them up: gathers
/// from memory take several times as long.
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
/// `ForwardScattering::polar_angle` of the numbers `xi`, which stand for `bits`.
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

/// The cosine after one try of forward scattering with the points of rank `rank` on.
HWY_INLINE Vector forward_try(const PolarAngles& polar_angles, Vector cosine, const SobolPoints& points,
                              const FourWords& shift, std::size_t rank) {
    const auto polar = shifted_words(points.dimension(0) + rank, shift[0]);
    const auto azimuth = shifted_words(points.dimension(1) + rank, shift[1]);
    const Vector angle = polar_angles(polar, uniforms_of(polar));
    const Vector square = hn::Mul(angle, angle);
    return deflected_cosine(cosine, series(detail::alternating_coefficients<7, 0>, square),
                            hn::Mul(angle, series(detail::alternating_coefficients<7, 1>, square)),
                            cosine_of_turns(uniforms_of(azimuth)));
}

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

/// Rays that meet an interface and what becomes of them.
struct Crossing {
    Vector cosine;
    Vector state;
};

HWY_INLINE Crossing cross(const MetInterface& interface, Vector cosine, Vector xi) {
    const Vector reflected = constant(interface.reflected_state);
    const Vector transmitted = constant(interface.transmitted_state);
    if (interface.kind == MetInterface::Kind::mirror) return {cosine, reflected};
    if (interface.kind == MetInterface::Kind::open) return {cosine, transmitted};
    const Vector beyond =
        root_or_zero(hn::Sub(constant(1.0), hn::Mul(constant(interface.optics.ratio_squared()),
                                                    hn::Sub(constant(1.0), hn::Mul(cosine, cosine)))));
    const Vector n1 = constant(interface.optics.n1());
    const Vector n2 = constant(interface.optics.n2());
    const Vector n1c1 = hn::Mul(n1, cosine);
    const Vector n2c2 = hn::Mul(n2, beyond);
    const Vector n2c1 = hn::Mul(n2, cosine);
    const Vector n1c2 = hn::Mul(n1, beyond);
    const Vector perpendicular_sum = hn::Add(n1c1, n2c2);
    const Vector parallel_sum = hn::Add(n2c1, n1c2);
    const Vector perpendicular = hn::Mul(hn::Sub(n1c1, n2c2), parallel_sum);
    const Vector parallel = hn::Mul(hn::Sub(n2c1, n1c2), perpendicular_sum);
    const Vector both = hn::Mul(perpendicular_sum, parallel_sum);
    const Mask reflects = hn::Or(hn::Eq(beyond, hn::Zero(doubles)),
                                 hn::Lt(hn::Mul(hn::Mul(hn::Mul(constant(2.0), xi), both), both),
                                        hn::Add(hn::Mul(perpendicular, perpendicular), hn::Mul(parallel, parallel))));
    return {hn::IfThenElse(reflects, cosine, beyond), hn::IfThenElse(reflects, reflected, transmitted)};
}

HWY_INLINE void store(const GroupRays& rays, std::size_t i, const Crossing& crossing, Vector length) {
    const Vector bin = hn::Min(hn::Mul(crossing.cosine, constant(cosine_bins)), constant(cosine_bins - 0.5));
    const Vector key = hn::Add(hn::Mul(crossing.state, constant(cosine_bins)), bin);
    hn::StoreU(crossing.cosine, doubles, rays.next_cosine + i);
    hn::StoreU(length, doubles, rays.length + i);
    hn::StoreU(hn::DemoteTo(Words(), key), Words(), rays.next_key + i);
}

/// Tries the rays `again[0..count)` anew, from attempt 1 on, until all go forward.
void try_again(const PolarAngles& polar_angles, const SobolPoints& points, const RankedNumbers& numbers,
               const GroupRays& rays, std::size_t count) {
    const std::size_t lanes = hn::Lanes(doubles);
    alignas(64) std::array<double, hn::MaxLanes(doubles)> tried;
    for (std::uint32_t attempt = 1; count > 0; ++attempt) {
        const FourWords shift = numbers.shift(attempt);
        std::size_t still = 0;
        for (std::size_t rank = 0; rank < count; rank += lanes) {
            const auto ray = hn::PromoteTo(Integers(), hn::LoadU(Words(), rays.again + rank));
            const Vector cosine = hn::GatherIndex(doubles, rays.cosine, ray);
            hn::Store(forward_try(polar_angles, cosine, points, shift, rank), doubles, tried.data());
            for (std::size_t lane = 0; lane < std::min(lanes, count - rank); ++lane) {
                const std::int32_t index = rays.again[rank + lane];
                rays.next_cosine[index] = tried[lane];
                rays.again[still] = index;
                still += tried[lane] <= 0.0 ? 1 : 0;
            }
        }
        count = still;
    }
}

void follow_forward(const Group& group, const SobolPoints& points, const RankedNumbers& numbers,
                    const GroupRays& rays) {
    const PolarAngles polar_angles(group.stack->forward[static_cast<std::size_t>(group.state.layer)].lookup());
    const FourWords shift = numbers.shift(0);
    const std::size_t lanes = hn::Lanes(doubles);
    std::size_t rejected = 0;
    for (std::size_t i = 0; i < rays.count; i += lanes) {
        const Vector next = forward_try(polar_angles, hn::LoadU(doubles, rays.cosine + i), points, shift, i);
        hn::StoreU(next, doubles, rays.next_cosine + i);
        const Mask turned = hn::And(hn::Le(next, hn::Zero(doubles)), hn::FirstN(doubles, rays.count - i));
        std::array<std::uint8_t, 8> bits;
        (void)hn::StoreMaskBits(doubles, turned, bits.data());
        const auto index = hn::Iota(Words(), static_cast<std::int32_t>(i));
        hn::StoreU(hn::CompressBits(index, bits.data()), Words(), rays.again + rejected);
        rejected += hn::CountTrue(doubles, turned);
    }
    try_again(polar_angles, points, numbers, rays, rejected);
    for (std::size_t i = 0; i < rays.count; i += lanes) {
        const Vector next = hn::LoadU(doubles, rays.next_cosine + i);
        const Vector xi = uniforms_of(shifted_words(points.dimension(2) + i, shift[2]));
        store(rays, i, cross(group.ahead, next, xi), hn::Div(constant(1.0), next));
    }
}

void follow_in_dermis(const Group& group, const SobolPoints& points, const RankedNumbers& numbers,
                      const GroupRays& rays) {
    const FourWords shift = numbers.shift(0);
    const Vector rayleigh_depth = constant(group.stack->rayleigh_depth[static_cast<std::size_t>(group.state.layer)]);
    for (std::size_t i = 0; i < rays.count; i += hn::Lanes(doubles)) {
        const auto uniforms = [&](std::size_t dimension) {
            return uniforms_of(shifted_words(points.dimension(dimension) + i, shift[dimension]));
        };
        const Vector direction_xi = uniforms(1);
        const Vector interface_xi = uniforms(2);
        const Vector diffuse = hn::Sqrt(direction_xi);
        if (!group.asks) {
            store(rays, i, cross(group.ahead, diffuse, interface_xi), hn::Div(constant(1.0), diffuse));
            continue;
        }
        const Vector cosine = hn::LoadU(doubles, rays.cosine + i);
        const Vector share = hn::Sub(constant(1.0), decay(hn::Div(rayleigh_depth, cosine)));
        const Vector test_xi = uniforms(0);
        const Mask rayleigh = hn::Lt(test_xi, share);
        const Vector polar = rayleigh_cosine(group.stack->edition, hn::Div(test_xi, share));
        const Vector scattered = deflected_cosine(cosine, polar, sine_to(polar), cosine_of_turns(direction_xi));
        const Mask turned = hn::And(rayleigh, hn::Lt(scattered, hn::Zero(doubles)));
        const Vector next = hn::IfThenElse(rayleigh, hn::Abs(scattered), diffuse);
        const Vector length = hn::IfThenZeroElse(turned, hn::Div(constant(1.0), next));
        const Crossing ahead = cross(group.ahead, next, interface_xi);
        const Crossing behind = cross(group.behind, next, interface_xi);
        store(rays, i,
              {hn::IfThenElse(turned, behind.cosine, ahead.cosine), hn::IfThenElse(turned, behind.state, ahead.state)},
              length);
    }
}

void follow_group(const Group& group, const SobolPoints& points, const RankedNumbers& numbers, const GroupRays& rays) {
    if (group.state.layer < 2) {
        follow_forward(group, points, numbers, rays);
    } else {
        follow_in_dermis(group, points, numbers, rays);
    }
}

}  // namespace skinfit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skinfit {
namespace {

/// Interface `number`, above layer `number`, as rays meet it that come from `from`.
MetInterface met_interface(const LayerStack& stack, const RayState& from, bool upward) {
    const int number = upward ? from.layer : from.layer + 1;
    const int beyond = upward ? from.layer - 1 : from.layer + 1;
    const bool base = number == stack.layers;
    // [KA04, Sec. 3.2]: reflected at interface 3, 4 or 5, either side.
    const bool bounces = stack.edition == Edition::printed && number >= 2;
    const auto kind = !base || stack.base == Base::Kind::index ? MetInterface::Kind::fresnel
                      : stack.base == Base::Kind::matched      ? MetInterface::Kind::open
                                                               : MetInterface::Kind::mirror;
    return {.kind = kind,
            .optics = stack.between(from.layer, beyond),
            .reflected_state = number_of({.layer = from.layer, .upward = !upward, .bounced = from.bounced || bounces}),
            .transmitted_state = beyond < 0 ? left_through_top
                                 : base     ? left_through_base
                                            : number_of({.layer = beyond, .upward = upward, .bounced = from.bounced})};
}

}  // namespace

Group group_of(const LayerStack& stack, const RayState& state) {
    return {.stack = &stack,
            .state = state,
            .asks = stack.edition == Edition::revised ? !state.upward : !state.bounced,
            .ahead = met_interface(stack, state, state.upward),
            .behind = met_interface(stack, state, !state.upward)};
}

HWY_EXPORT(follow_group);

void follow_group(const Group& group, const SobolPoints& points, const RankedNumbers& numbers, const GroupRays& rays) {
    HWY_DYNAMIC_DISPATCH(follow_group)(group, points, numbers, rays);
}

}  // namespace skinfit
#endif
