// Compiled once per instruction set by foreach_target.h, then chosen at run time. Every step is an elementwise IEEE
// operation in the order of model/random_walk.hpp, products and sums unfused (CMakeLists.txt forbids contraction), so
// that the bits depend neither on the instruction set nor on which rays share a vector.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/group_event.cpp"  // NOLINT
#include <hwy/foreach_target.h>                     // must come before highway.h
//
#include <hwy/highway.h>

#include <algorithm>

#include "model/group_event.hpp"
#include "model/vector_scattering.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

/// Rays that meet an interface and what becomes of them.
struct Crossing {
    Vector cosine;
    Vector state;
};

/// What a Fresnel interface is to each ray.
struct Refraction {
    Vector n1;
    Vector n2;
    Vector ratio_squared;
    Vector reflected_state;
    Vector transmitted_state;
};

HWY_INLINE Refraction refraction_of(const MetInterface& interface) {
    return {constant(interface.optics.n1()), constant(interface.optics.n2()),
            constant(interface.optics.ratio_squared()), constant(interface.reflected_state),
            constant(interface.transmitted_state)};
}

HWY_INLINE Refraction either(Mask first, const Refraction& a, const Refraction& b) {
    return {hn::IfThenElse(first, a.n1, b.n1), hn::IfThenElse(first, a.n2, b.n2),
            hn::IfThenElse(first, a.ratio_squared, b.ratio_squared),
            hn::IfThenElse(first, a.reflected_state, b.reflected_state),
            hn::IfThenElse(first, a.transmitted_state, b.transmitted_state)};
}

HWY_INLINE Crossing refract(const Refraction& at, Vector cosine, Vector xi) {
    const Vector beyond = root_or_zero(
        hn::Sub(constant(1.0), hn::Mul(at.ratio_squared, hn::Sub(constant(1.0), hn::Mul(cosine, cosine)))));
    const Vector n1c1 = hn::Mul(at.n1, cosine);
    const Vector n2c2 = hn::Mul(at.n2, beyond);
    const Vector n2c1 = hn::Mul(at.n2, cosine);
    const Vector n1c2 = hn::Mul(at.n1, beyond);
    const Vector perpendicular_sum = hn::Add(n1c1, n2c2);
    const Vector parallel_sum = hn::Add(n2c1, n1c2);
    const Vector perpendicular = hn::Mul(hn::Sub(n1c1, n2c2), parallel_sum);
    const Vector parallel = hn::Mul(hn::Sub(n2c1, n1c2), perpendicular_sum);
    const Vector both = hn::Mul(perpendicular_sum, parallel_sum);
    const Mask reflects = hn::Or(hn::Eq(beyond, hn::Zero(doubles)),
                                 hn::Lt(hn::Mul(hn::Mul(hn::Mul(constant(2.0), xi), both), both),
                                        hn::Add(hn::Mul(perpendicular, perpendicular), hn::Mul(parallel, parallel))));
    return {hn::IfThenElse(reflects, cosine, beyond),
            hn::IfThenElse(reflects, at.reflected_state, at.transmitted_state)};
}

HWY_INLINE Crossing cross(const MetInterface& interface, Vector cosine, Vector xi) {
    if (interface.kind == InterfaceKind::mirror) return {cosine, constant(interface.reflected_state)};
    if (interface.kind == InterfaceKind::open) return {cosine, constant(interface.transmitted_state)};
    return refract(refraction_of(interface), cosine, xi);
}

/// The interface behind for rays that have `turned`, else that ahead.
HWY_INLINE Crossing cross_either(const EventGroup& group, Mask turned, Vector cosine, Vector xi) {
    if (group.ahead.kind == InterfaceKind::fresnel && group.behind.kind == InterfaceKind::fresnel) {
        return refract(either(turned, refraction_of(group.behind), refraction_of(group.ahead)), cosine, xi);
    }
    const Crossing ahead = cross(group.ahead, cosine, xi);
    const Crossing behind = cross(group.behind, cosine, xi);
    return {hn::IfThenElse(turned, behind.cosine, ahead.cosine), hn::IfThenElse(turned, behind.state, ahead.state)};
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

void follow_forward(const EventGroup& group, const SobolPoints& points, const RankedNumbers& numbers,
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

void follow_in_dermis(const EventGroup& group, const SobolPoints& points, const RankedNumbers& numbers,
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
        store(rays, i, cross_either(group, turned, next, interface_xi), length);
    }
}

void follow_group(const EventGroup& group, const SobolPoints& points, const RankedNumbers& numbers,
                  const GroupRays& rays) {
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

/// The interface above or below the layer of rays in state `from`, as they meet it.
MetInterface met_interface(const LayerStack& stack, const RayState& from, bool upward) {
    const int beyond = upward ? from.layer - 1 : from.layer + 1;
    const bool base = beyond == stack.layers;
    // Whether a ray has been reflected in the dermis matters to the edition as printed alone.
    const bool bounced = from.bounced || (stack.edition == Edition::printed && bounces(from.layer, beyond));
    return {.kind = interface_kind(stack.base, stack.layers, beyond),
            .optics = stack.between(from.layer, beyond),
            .reflected_state = number_of({.layer = from.layer, .upward = !upward, .bounced = bounced}),
            .transmitted_state = beyond < 0 ? left_through_top
                                 : base     ? left_through_base
                                            : number_of({.layer = beyond, .upward = upward, .bounced = from.bounced})};
}

}  // namespace

EventGroup group_of(const LayerStack& stack, const RayState& state) {
    return {.stack = &stack,
            .state = state,
            .asks = asks_for_rayleigh(stack.edition, !state.upward, state.bounced),
            .ahead = met_interface(stack, state, state.upward),
            .behind = met_interface(stack, state, !state.upward)};
}

HWY_EXPORT(follow_group);

void follow_group(const EventGroup& group, const SobolPoints& points, const RankedNumbers& numbers,
                  const GroupRays& rays) {
    HWY_DYNAMIC_DISPATCH(follow_group)(group, points, numbers, rays);
}

}  // namespace skinfit
#endif
