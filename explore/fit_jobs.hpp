#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "explore/fit_order.hpp"

namespace skinfit {

/// Fits that run while the page goes on asking. Calls may come from any thread; the end of the object cancels what
/// still runs and waits for it.
class FitJobs {
public:
    explicit FitJobs(DiskCache cache) : cache_(std::move(cache)) {}

    /// Starts a fit and returns its name; none while as many run as may at a time. Of the fits that have ended the
    /// latest eight are kept.
    [[nodiscard]] std::optional<std::string> start(FitOrder order);

    /// How far a fit is: {"state": "running"|"done"|"cancelled"|"failed", "progress": {...}, "seconds": ...}, and with
    /// it "documents" of one that is done or "error" of one that has failed. None where there is no such fit.
    [[nodiscard]] std::optional<Json> state(const std::string& name) const;

    /// `fitted_page` of a fit that is done; none where there is no such fit, or it is not done. One is drawn at a time.
    [[nodiscard]] std::optional<std::string> page(const std::string& name);

    /// Asks a fit to stop, which it does within about 0.2 s. False where there is no such fit.
    bool cancel(const std::string& name);

private:
    struct Job;
    void forget_old();

    DiskCache cache_;
    mutable std::mutex mutex_;
    std::mutex drawing_;
    int started_ = 0;
    std::map<int, std::shared_ptr<Job>> jobs_;
    [[nodiscard]] std::shared_ptr<Job> find(const std::string& name) const;
};

}  // namespace skinfit
