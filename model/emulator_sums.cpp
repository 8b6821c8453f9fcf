// Compiled once per instruction set by foreach_target.h, then chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/emulator_sums.cpp"  // NOLINT
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)  // their registers cannot be members of a struct
#include <hwy/foreach_target.h>                                  // must come before highway.h
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "model/emulator_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace skinfit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, emulator_lanes / 2>;
using Floats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;

/// Two registers side by side: twice as much to do while a sum waits for its last term.
struct Pair {
    Vector a;
    Vector b;
};

Pair load(const double* first) {
    const Doubles d;
    return {hn::LoadU(d, first), hn::LoadU(d, first + hn::Lanes(d))};
}

Pair load(const float* first) {
    const Doubles d;
    const Floats f;
    return {hn::PromoteTo(d, hn::LoadU(f, first)), hn::PromoteTo(d, hn::LoadU(f, first + hn::Lanes(d)))};
}

void store(const Pair& pair, double* first) {
    const Doubles d;
    hn::StoreU(pair.a, d, first);
    hn::StoreU(pair.b, d, first + hn::Lanes(d));
}

Pair set(double value) {
    const Doubles d;
    return {hn::Set(d, value), hn::Set(d, value)};
}

Pair operator+(const Pair& x, const Pair& y) {
    return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)};
}

Pair operator/(const Pair& x, const Pair& y) {
    return {hn::Div(x.a, y.a), hn::Div(x.b, y.b)};
}

/// x y + z
Pair multiply_add(const Pair& x, const Pair& y, const Pair& z) {
    return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)};
}

/// x y - z
Pair multiply_subtract(const Pair& x, const Pair& y, const Pair& z) {
    return {hn::MulSub(x.a, y.a, z.a), hn::MulSub(x.b, y.b, z.b)};
}

/// sum += x y
void add_product(Pair& sum, const Pair& x, const Pair& y) {
    sum = multiply_add(x, y, sum);
}

/// The Chebyshev polynomials of one layer's coordinate and their derivatives by the layer's optical depth.
struct Polynomials {
    HWY_ALIGN std::array<double, most_emulator_terms * emulator_lanes> value;
    HWY_ALIGN std::array<double, most_emulator_terms * emulator_lanes> by_depth;
};

void tabulate(const Pair& coordinate, const Pair& coordinate_by_depth, int count, std::size_t lanes,
              Polynomials& polynomials) {
    const Pair twice = coordinate + coordinate;
    const Pair twice_by = coordinate_by_depth + coordinate_by_depth;
    Pair before = set(1.0);
    Pair before_by = set(0.0);
    Pair last = coordinate;
    Pair last_by = coordinate_by_depth;
    for (int n = 0; n < count; ++n) {
        store(before, polynomials.value.data() + static_cast<std::size_t>(n) * lanes);
        store(before_by, polynomials.by_depth.data() + static_cast<std::size_t>(n) * lanes);
        // T_n+1 = 2 x T_n - T_n-1
        const Pair next = multiply_subtract(twice, last, before);
        const Pair next_by = multiply_add(twice_by, last, multiply_subtract(twice, last_by, before_by));
        before = last;
        before_by = last_by;
        last = next;
        last_by = next_by;
    }
}

void sum_lanes(const EmulatorSeries& series, const PerLayer<Polynomials>& polynomials, std::size_t first_lane,
               std::size_t lanes, EmulatorSums& sums) {
    const auto value = [&](std::size_t layer, std::size_t n) {
        return load(polynomials[layer].value.data() + n * lanes);
    };
    const auto by_depth = [&](std::size_t layer, std::size_t n) {
        return load(polynomials[layer].by_depth.data() + n * lanes);
    };
    const float* coefficient = series.coefficients.data() + first_lane;
    const std::uint8_t* count = series.counts.data();
    const Pair zero = set(0.0);
    Pair sum = zero;
    PerLayer<Pair> by = {zero, zero, zero, zero};
    const std::size_t count_0 = *count++;
    for (std::size_t i = 0; i < count_0; ++i) {
        Pair sum_i = zero;
        Pair by1_i = zero;
        Pair by2_i = zero;
        Pair by3_i = zero;
        const std::size_t count_1 = *count++;
        for (std::size_t j = 0; j < count_1; ++j) {
            Pair sum_j = zero;
            Pair by2_j = zero;
            Pair by3_j = zero;
            const std::size_t count_2 = *count++;
            for (std::size_t k = 0; k < count_2; ++k) {
                Pair sum_k = zero;
                Pair by3_k = zero;
                const std::size_t count_3 = *count++;
                for (std::size_t l = 0; l < count_3; ++l, coefficient += emulator_lanes) {
                    const Pair c = load(coefficient);
                    add_product(sum_k, c, value(3, l));
                    add_product(by3_k, c, by_depth(3, l));
                }
                add_product(sum_j, value(2, k), sum_k);
                add_product(by3_j, value(2, k), by3_k);
                add_product(by2_j, by_depth(2, k), sum_k);
            }
            add_product(sum_i, value(1, j), sum_j);
            add_product(by3_i, value(1, j), by3_j);
            add_product(by2_i, value(1, j), by2_j);
            add_product(by1_i, by_depth(1, j), sum_j);
        }
        add_product(sum, value(0, i), sum_i);
        add_product(by[3], value(0, i), by3_i);
        add_product(by[2], value(0, i), by2_i);
        add_product(by[1], value(0, i), by1_i);
        add_product(by[0], by_depth(0, i), sum_i);
    }
    store(sum, sums.value.data() + first_lane);
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        store(by[layer], sums.by_optical_depth[layer].data() + first_lane);
    }
}

EmulatorSums sum_series(const EmulatorSeries& series, const EmulatorCoordinate& coordinate,
                        const PerLayer<Lanes<double>>& optical_depth) {
    const Doubles d;
    const std::size_t lanes = 2 * hn::Lanes(d);
    EmulatorSums sums;
    PerLayer<Polynomials> polynomials;
    for (std::size_t first = 0; first < emulator_lanes; first += lanes) {
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            const Pair depth = load(optical_depth[layer].data() + first);
            const Pair shifted = depth + load(coordinate.shift[layer].data() + first);
            const Pair logarithm = {hn::Log(d, shifted.a), hn::Log(d, shifted.b)};
            const Pair scale = load(coordinate.scale[layer].data() + first);
            tabulate(multiply_add(logarithm, scale, load(coordinate.offset[layer].data() + first)), scale / shifted,
                     series.most[layer], lanes, polynomials[layer]);
        }
        sum_lanes(series, polynomials, first, lanes, sums);
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
