#include "model/path_ensemble.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/memory.hpp"
#include "model/recorded_walk.hpp"

namespace skinfit {
namespace {

/// The path lengths of one batch at one wavelength, per side, one row of layers per path.
using BatchPaths = std::array<std::vector<PerLayer<float>>, side_count>;

struct RayRange {
    std::uint64_t begin;
    std::uint64_t end;
};

RayRange rays_of_batch(std::uint64_t rays, std::size_t batch) {
    return {rays * batch / PathEnsemble::batch_count, rays * (batch + 1) / PathEnsemble::batch_count};
}

double size_of_batch(std::uint64_t rays, std::size_t batch) {
    const RayRange range = rays_of_batch(rays, batch);
    return static_cast<double>(range.end - range.begin);
}

BatchPaths trace_batch(const LayerStack& stack, const RecordedBatch& batch, const SobolPoints& points,
                       const std::stop_token& stop) {
    BatchPaths paths;
    for (const RecordedRay& ray : record_batch(stack, batch, points, stop)) {
        const Side side = ray.exit == Exit::reflected ? Side::top : Side::bottom;
        PerLayer<float> row{};
        std::ranges::transform(ray.lengths, row.begin(), [](double length) { return static_cast<float>(length); });
        paths[static_cast<std::size_t>(side)].push_back(row);
    }
    return paths;
}

/// Appends one side of all batches to `lengths`, layer by layer.
PathEnsemble::Segment append(const std::vector<BatchPaths>& batches, std::size_t side, std::vector<float>& lengths) {
    PathEnsemble::Segment segment{.first_float = lengths.size(), .batch_begins = {}};
    for (std::size_t batch = 0; batch < batches.size(); ++batch) {
        segment.batch_begins[batch + 1] = segment.batch_begins[batch] + batches[batch][side].size();
    }
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        for (const BatchPaths& batch : batches) {
            for (const PerLayer<float>& row : batch[side]) lengths.push_back(row[layer]);
        }
    }
    return segment;
}

}  // namespace

PathEnsemble::PathEnsemble(Parts parts)
    : surface_share_(parts.surface_share),
      rays_(parts.rays),
      segments_(std::move(parts.segments)),
      lengths_(parts.lengths),
      owner_(std::move(parts.owner)) {}

PathEnsemble PathEnsemble::trace(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                 const WalkOptions& options, const std::stop_token& stop) {
    assert(options.rays >= batch_count);
    constexpr double bytes_per_ray = sizeof(float) * layer_count;
    // Those of the wavelength in work lie beside the rest before they join it.
    refuse_beyond_memory(
        bytes_per_ray * static_cast<double>(options.rays) * static_cast<double>(wavelengths_nm.size() + 1),
        fmt::format("engine paths, {} rays at {} wavelengths", options.rays, wavelengths_nm.size()),
        "take fewer rays (rays=...) or wavelengths, or engine=solver, which keeps none");
    const auto lengths = std::make_shared<std::vector<float>>();
    lengths->reserve(wavelengths_nm.size() * options.rays * layer_count);
    const FresnelInterface surface(1.0, sample.skin.stratum_corneum_refractive_index);
    const double incidence_cosine = std::cos(options.incidence_rad);
    const double refracted_cosine = surface.transmitted_cosine(incidence_cosine);
    const SobolPoints points(options.rays / batch_count + 1);
    std::vector<Segments> segments;
    for (const double wavelength_nm : wavelengths_nm) {
        const LayerStack stack = layer_stack(sample, wavelength_nm);
        std::vector<BatchPaths> batches(batch_count);
        tbb::parallel_for(std::size_t{0}, batch_count, [&](std::size_t batch) {
            const RayRange range = rays_of_batch(options.rays, batch);
            batches[batch] = trace_batch(stack,
                                         {.refracted_cosine = refracted_cosine,
                                          .rays = range.end - range.begin,
                                          .seed = options.seed,
                                          .number = static_cast<std::uint32_t>(batch)},
                                         points, stop);
        });
        segments.push_back({append(batches, 0, *lengths), append(batches, 1, *lengths)});
    }
    return PathEnsemble({.surface_share = surface.reflectance(incidence_cosine),
                         .rays = options.rays,
                         .segments = std::move(segments),
                         .lengths = *lengths,
                         .owner = lengths});
}

PathSpan PathEnsemble::paths(std::size_t wavelength, Side side, std::size_t batch) const {
    const Segment& segment = segments_[wavelength][static_cast<std::size_t>(side)];
    const std::uint64_t begin = segment.batch_begins[batch];
    return {.first = lengths_.data() + segment.first_float + begin,
            .stride = segment.batch_begins.back(),
            .count = segment.batch_begins[batch + 1] - begin};
}

std::uint64_t PathEnsemble::used_rays() const {
    return rays_of_batch(rays_, used_batches_ - 1).end;
}

PathEnsemble PathEnsemble::with_about(std::uint64_t rays) const {
    PathEnsemble part = *this;
    part.used_batches_ = 1;
    while (part.used_batches_ < used_batches_ && part.used_rays() < rays) ++part.used_batches_;
    return part;
}

std::vector<EnsembleResponse> PathEnsemble::respond(std::span<const PerLayer<double>> optical_depths) const {
    assert(optical_depths.size() == wavelength_count());
    // The order of summation is fixed: within a batch, then batch by batch.
    std::vector<std::array<std::array<PathSums, batch_count>, side_count>> sums(wavelength_count());
    tbb::parallel_for(std::size_t{0}, wavelength_count() * used_batches_, [&](std::size_t unit) {
        const std::size_t wavelength = unit / used_batches_;
        const std::size_t batch = unit % used_batches_;
        for (std::size_t side = 0; side < side_count; ++side) {
            sums[wavelength][side][batch] =
                sum_paths(paths(wavelength, static_cast<Side>(side), batch), optical_depths[wavelength]);
        }
    });
    const double entering = 1.0 - surface_share_;
    const auto count = static_cast<double>(used_rays());
    const auto batches = static_cast<double>(used_batches_);
    std::vector<EnsembleResponse> responses(wavelength_count());
    for (std::size_t wavelength = 0; wavelength < wavelength_count(); ++wavelength) {
        for (std::size_t side = 0; side < side_count; ++side) {
            PathSums total;
            for (const PathSums& batch : sums[wavelength][side]) total += batch;
            Escape& escape = responses[wavelength].side[side];
            const double mean = total.weight / count;
            escape.share = entering * mean;
            double scatter = 0.0;
            for (std::size_t batch = 0; batch < used_batches_; ++batch) {
                const double deviation = sums[wavelength][side][batch].weight - mean * size_of_batch(rays_, batch);
                scatter += deviation * deviation;
            }
            escape.standard_error = used_batches_ == 1
                                        ? std::numeric_limits<double>::infinity()
                                        : entering * std::sqrt(scatter * batches / (batches - 1.0)) / count;
            for (std::size_t layer = 0; layer < layer_count; ++layer) {
                escape.by_optical_depth[layer] = -entering * total.weight_length[layer] / count;
            }
        }
    }
    return responses;
}

std::vector<std::array<double, PathEnsemble::batch_count>> PathEnsemble::batch_shares(
    std::span<const PerLayer<double>> optical_depths, Side side) const {
    assert(optical_depths.size() == wavelength_count() && used_batches_ == batch_count);
    std::vector<std::array<double, batch_count>> shares(wavelength_count());
    for (std::size_t wavelength = 0; wavelength < wavelength_count(); ++wavelength) {
        for (std::size_t batch = 0; batch < batch_count; ++batch) {
            const PathSums sums = sum_paths(paths(wavelength, side, batch), optical_depths[wavelength]);
            shares[wavelength][batch] = (1.0 - surface_share_) * sums.weight / size_of_batch(rays_, batch);
        }
    }
    return shares;
}

}  // namespace skinfit
