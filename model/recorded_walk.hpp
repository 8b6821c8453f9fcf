#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "model/layer_stack.hpp"
#include "model/random_walk.hpp"
#include "model/ranked_numbers.hpp"

namespace skinfit {

/// One ray followed until it has left the sample: how far it ran in each layer, in multiples of the layer's thickness.
struct RecordedRay {
    PerLayer<double> lengths;
    Exit exit;  ///< reflected or transmitted
};

/// Which rays to record.
struct RecordedBatch {
    double refracted_cosine;  ///< of all rays as they enter
    std::size_t rays;
    std::uint64_t seed;
    std::uint32_t number;  ///< of the batch; batches are independent
};

/// Follows the rays of a batch without absorption, all together, event by event: each is a ray of `RandomWalk`, but the
/// rays of a group, ordered by cosine, share out `RankedNumbers` among them. Any statistic of a batch is unbiased and
/// varies less than that of as many independent rays; the error of several batches is seen in their scatter.
/// [LECUYER08] `points` must hold `batch.rays` points. Throws Cancelled at the
/// next event after `stop` is requested.
[[nodiscard]] std::vector<RecordedRay> record_batch(const LayerStack& stack, const RecordedBatch& batch,
                                                    const SobolPoints& points, const std::stop_token& stop = {});

}  // namespace skinfit
