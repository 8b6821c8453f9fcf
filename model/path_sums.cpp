// Compiled once per instruction set by foreach_target.h, then chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/path_sums.cpp"  // NOLINT
#include <hwy/foreach_target.h>                   // must come before highway.h
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "model/path_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds whole vectors from path `i` on; returns the first path not added.
template <class Doubles>
std::size_t add_vectors(Doubles doubles, const PathSpan& paths, const PerLayer<double>& optical_depth, std::size_t i,
                        PathSums& sums) {
    const hn::Rebind<float, Doubles> floats;
    const std::size_t lanes = hn::Lanes(doubles);
    const auto load = [&](std::size_t layer, std::size_t path) {
        return hn::PromoteTo(doubles, hn::LoadU(floats, paths.first + layer * paths.stride + path));
    };
    const auto depth0 = hn::Set(doubles, -optical_depth[0]);
    const auto depth1 = hn::Set(doubles, -optical_depth[1]);
    const auto depth2 = hn::Set(doubles, -optical_depth[2]);
    const auto depth3 = hn::Set(doubles, -optical_depth[3]);
    auto weights = hn::Zero(doubles);
    auto lengths0 = hn::Zero(doubles);
    auto lengths1 = hn::Zero(doubles);
    auto lengths2 = hn::Zero(doubles);
    auto lengths3 = hn::Zero(doubles);
    for (; i + lanes <= paths.count; i += lanes) {
        const auto length0 = load(0, i);
        const auto length1 = load(1, i);
        const auto length2 = load(2, i);
        const auto length3 = load(3, i);
        const auto depth = hn::MulAdd(
            depth0, length0, hn::MulAdd(depth1, length1, hn::MulAdd(depth2, length2, hn::Mul(depth3, length3))));
        const auto weight = hn::Exp(doubles, depth);
        weights = hn::Add(weights, weight);
        lengths0 = hn::MulAdd(weight, length0, lengths0);
        lengths1 = hn::MulAdd(weight, length1, lengths1);
        lengths2 = hn::MulAdd(weight, length2, lengths2);
        lengths3 = hn::MulAdd(weight, length3, lengths3);
    }
    const auto total = [&](auto lane_sums) { return hn::GetLane(hn::SumOfLanes(doubles, lane_sums)); };
    sums += {.weight = total(weights),
             .weight_length = {total(lengths0), total(lengths1), total(lengths2), total(lengths3)}};
    return i;
}

PathSums sum_paths(const PathSpan& paths, const PerLayer<double>& optical_depth) {
    PathSums sums;
    const std::size_t rest = add_vectors(hn::ScalableTag<double>(), paths, optical_depth, 0, sums);
    (void)add_vectors(hn::CappedTag<double, 1>(), paths, optical_depth, rest, sums);
    return sums;
}

}  // namespace skinfit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skinfit {

HWY_EXPORT(sum_paths);

PathSums& PathSums::operator+=(const PathSums& other) {
    weight += other.weight;
    for (std::size_t layer = 0; layer < layer_count; ++layer) weight_length[layer] += other.weight_length[layer];
    return *this;
}

PathSums sum_paths(const PathSpan& paths, const PerLayer<double>& optical_depth) {
    return HWY_DYNAMIC_DISPATCH(sum_paths)(paths, optical_depth);
}

}  // namespace skinfit
#endif
