#include "model/ranked_numbers.hpp"

#include <boost/random/sobol.hpp>

namespace skinfit {

SobolPoints::SobolPoints(std::size_t count) : stride_(count + slack), words_(4 * stride_) {
    boost::random::sobol_engine<std::uint32_t, 32> sequence(4);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t dimension = 0; dimension < 4; ++dimension) words_[dimension * stride_ + i] = sequence();
    }
}

}  // namespace skinfit
