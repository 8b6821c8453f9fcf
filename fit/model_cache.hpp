#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fit/models.hpp"

namespace skinfit {

/// Walks and emulators in memory, for many fits that share them. May be used from any thread; a model that two of them
/// want at once is made once.
class ModelCache {
public:
    explicit ModelCache(DiskCache cache) : cache_(std::move(cache)) {}

    /// As `make_models`, with what was made for an earlier problem where that fits this one.
    [[nodiscard]] std::vector<ForwardModel> models(const FitProblem& problem, Engine engine);

private:
    struct Place {
        std::mutex making;
        std::vector<ForwardModel> models;
    };

    DiskCache cache_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Place>> places_;
};

}  // namespace skinfit
