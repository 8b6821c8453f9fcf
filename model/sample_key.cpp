#include "model/sample_key.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include "core/file.hpp"

namespace skinfit {

std::string sample_key(const Sample& sample, double incidence_rad,
                       const std::function<bool(const ParameterInfo&)>& counts) {
    const bool has_index = sample.base.kind == Base::Kind::index;
    // Hexadecimal floating point: exact.
    std::string key =
        fmt::format("edition {}; layers {}; base {} {:a}; incidence {:a};",
                    sample.edition == Edition::printed ? "printed" : "revised", sample.layers,
                    static_cast<int>(sample.base.kind), has_index ? sample.base.refractive_index : 0.0, incidence_rad);
    const ParameterValues values{.skin = sample.skin, .instrument = {}};
    for (const ParameterInfo& row : parameter_table()) {
        if (belongs_to_instrument(row.parameter) || row.parameter == Parameter::fold_aspect_ratio || !counts(row)) {
            continue;
        }
        key += fmt::format(" {} {:a}", row.name, value_of(values, row.parameter));
    }
    return key;
}

std::uint64_t program_fingerprint() {
    static const std::uint64_t fingerprint = [] {
        const std::string program = read_file("/proc/self/exe");
        return XXH3_64bits(program.data(), program.size());
    }();
    return fingerprint;
}

}  // namespace skinfit
