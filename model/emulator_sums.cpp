// Compiled once per instruction set by foreach_target.h, then chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/emulator_sums.cpp"  // NOLINT
#include <hwy/foreach_target.h>                       // must come before highway.h
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "model/emulator_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, emulator_lanes>;
using Floats = hn::Rebind<float, Doubles>;

/// The Chebyshev polynomials of one layer's coordinate and their derivatives by the layer's optical depth.
struct Polynomials {
    HWY_ALIGN double value[most_emulator_terms * hn::MaxLanes(Doubles())];
    HWY_ALIGN double by_depth[most_emulator_terms * hn::MaxLanes(Doubles())];
};

template <class Vector>
void tabulate(Vector coordinate, Vector coordinate_by_depth, int count, Polynomials& polynomials) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    const auto twice = hn::Add(coordinate, coordinate);
    auto before = hn::Set(d, 1.0);
    auto before_by = hn::Zero(d);
    auto last = coordinate;
    auto last_by = coordinate_by_depth;
    const auto twice_by = hn::Add(coordinate_by_depth, coordinate_by_depth);
    for (int n = 0; n < count; ++n) {
        hn::Store(before, d, polynomials.value + static_cast<std::size_t>(n) * lanes);
        hn::Store(before_by, d, polynomials.by_depth + static_cast<std::size_t>(n) * lanes);
        // T_n+1 = 2 x T_n - T_n-1
        const auto next = hn::MulSub(twice, last, before);
        const auto next_by = hn::MulAdd(twice_by, last, hn::MulSub(twice, last_by, before_by));
        before = last;
        before_by = last_by;
        last = next;
        last_by = next_by;
    }
}

void sum_lanes(const EmulatorSeries& series, const PerLayer<Polynomials>& polynomials, std::size_t first_lane,
               EmulatorSums& sums) {
    const Doubles d;
    const Floats f;
    const std::size_t lanes = hn::Lanes(d);
    const auto value = [&](std::size_t layer, int n) {
        return hn::Load(d, polynomials[layer].value + static_cast<std::size_t>(n) * lanes);
    };
    const auto by_depth = [&](std::size_t layer, int n) {
        return hn::Load(d, polynomials[layer].by_depth + static_cast<std::size_t>(n) * lanes);
    };
    const float* coefficient = series.coefficients.data() + first_lane;
    const std::uint8_t* terms = series.terms.data();
    auto sum = hn::Zero(d);
    auto by0 = hn::Zero(d);
    auto by1 = hn::Zero(d);
    auto by2 = hn::Zero(d);
    auto by3 = hn::Zero(d);
    for (int i = 0; i < series.counts[0]; ++i) {
        auto sum_i = hn::Zero(d);
        auto by1_i = hn::Zero(d);
        auto by2_i = hn::Zero(d);
        auto by3_i = hn::Zero(d);
        for (int j = 0; j < series.counts[1]; ++j) {
            auto sum_j = hn::Zero(d);
            auto by2_j = hn::Zero(d);
            auto by3_j = hn::Zero(d);
            for (int k = 0; k < series.counts[2]; ++k) {
                auto sum_k = hn::Zero(d);
                auto by3_k = hn::Zero(d);
                const int count = *terms++;
                for (int l = 0; l < count; ++l, coefficient += emulator_lanes) {
                    const auto c = hn::PromoteTo(d, hn::LoadU(f, coefficient));
                    sum_k = hn::MulAdd(c, value(3, l), sum_k);
                    by3_k = hn::MulAdd(c, by_depth(3, l), by3_k);
                }
                sum_j = hn::MulAdd(value(2, k), sum_k, sum_j);
                by3_j = hn::MulAdd(value(2, k), by3_k, by3_j);
                by2_j = hn::MulAdd(by_depth(2, k), sum_k, by2_j);
            }
            sum_i = hn::MulAdd(value(1, j), sum_j, sum_i);
            by3_i = hn::MulAdd(value(1, j), by3_j, by3_i);
            by2_i = hn::MulAdd(value(1, j), by2_j, by2_i);
            by1_i = hn::MulAdd(by_depth(1, j), sum_j, by1_i);
        }
        sum = hn::MulAdd(value(0, i), sum_i, sum);
        by3 = hn::MulAdd(value(0, i), by3_i, by3);
        by2 = hn::MulAdd(value(0, i), by2_i, by2);
        by1 = hn::MulAdd(value(0, i), by1_i, by1);
        by0 = hn::MulAdd(by_depth(0, i), sum_i, by0);
    }
    hn::StoreU(sum, d, sums.value.data() + first_lane);
    hn::StoreU(by0, d, sums.by_optical_depth[0].data() + first_lane);
    hn::StoreU(by1, d, sums.by_optical_depth[1].data() + first_lane);
    hn::StoreU(by2, d, sums.by_optical_depth[2].data() + first_lane);
    hn::StoreU(by3, d, sums.by_optical_depth[3].data() + first_lane);
}

EmulatorSums sum_series(const EmulatorSeries& series, const EmulatorCoordinate& coordinate,
                        const PerLayer<Lanes<double>>& optical_depth) {
    const Doubles d;
    EmulatorSums sums;
    PerLayer<Polynomials> polynomials;
    for (std::size_t first = 0; first < emulator_lanes; first += hn::Lanes(d)) {
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            const auto load = [&](const Lanes<double>& values) { return hn::LoadU(d, values.data() + first); };
            const auto shifted = hn::Add(load(optical_depth[layer]), load(coordinate.shift[layer]));
            const auto scale = load(coordinate.scale[layer]);
            const int count = layer < 3 ? series.counts[layer] : series.terms[0];  // the first triple has most terms
            tabulate(hn::MulAdd(hn::Log(d, shifted), scale, load(coordinate.offset[layer])), hn::Div(scale, shifted),
                     count, polynomials[layer]);
        }
        sum_lanes(series, polynomials, first, sums);
    }
    return sums;
}

}  // namespace skinfit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skinfit {

HWY_EXPORT(sum_series);

EmulatorSums sum_series(const EmulatorSeries& series, const EmulatorCoordinate& coordinate,
                        const PerLayer<Lanes<double>>& optical_depth) {
    return HWY_DYNAMIC_DISPATCH(sum_series)(series, coordinate, optical_depth);
}

}  // namespace skinfit
#endif
