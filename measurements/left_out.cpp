#include "measurements/left_out.hpp"

#include <fmt/format.h>

namespace skinfit {

void LeftOut::tell(std::vector<Spectrum>& spectra) const {
    if (errors_.empty()) return;
    if (spectra.empty()) throw errors_.front();
    constexpr std::size_t most = 3;
    std::string message =
        fmt::format("{} of the file's spectra {} left out", errors_.size(), errors_.size() == 1 ? "is" : "are");
    for (std::size_t i = 0; i < errors_.size() && i < most; ++i) {
        message += fmt::format("{} {}", i == 0 ? ":" : ";", errors_[i].what());
    }
    if (errors_.size() > most) message += fmt::format("; and {} more", errors_.size() - most);
    for (Spectrum& spectrum : spectra) spectrum.remarks.push_back(message);
}

}  // namespace skinfit
