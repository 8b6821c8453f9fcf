#include "fit/file_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "measurements/description.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

constexpr std::array<std::string_view, 3> keys = {"edition", "layers", "base"};

/// Of `base` other letters only are a slip: a "case" is none.
void refuse_slips(const Spectrum& spectrum) {
    static constexpr std::array<std::string_view, 2> long_keys = {"edition", "layers"};
    for (const FileNote& note : spectrum.notes) {
        const bool is_base = lower_case(note.key) == "base";
        refuse_slip(spectrum.source, note.line, note.key,
                    is_base ? std::span<const std::string_view>(keys) : long_keys);
    }
}

/// What the file states, and nothing else.
Configuration stated_in(const Spectrum& spectrum) {
    refuse_slips(spectrum);
    Configuration configuration;
    for (const std::string_view key : keys) {
        const FileNote* stated = nullptr;
        for (const FileNote& note : spectrum.notes) {
            if (note.key != key) continue;
            const std::string where = fmt::format("{}:{}: {}", spectrum.source, note.line, key);
            if (stated != nullptr) {
                throw InputError({.where = where,
                                  .problem = "is given again",
                                  .why = fmt::format("line {} gives it already", stated->line),
                                  .remedy = "keep one of the two"});
            }
            stated = &note;
            configuration = configured_by_word(std::move(configuration), key, note.value, where);
        }
    }
    return configuration;
}

}  // namespace

Configuration with_file_settings(const Configuration& configuration, std::span<const Spectrum> spectra) {
    const Configuration first = stated_in(spectra.front());
    for (const Spectrum& spectrum : spectra.subspan(1)) {
        const Configuration other = stated_in(spectrum);
        if (other.edition == first.edition && other.layers == first.layers && other.base == first.base) continue;
        throw InputError({.where = fmt::format("{}, {}", spectra.front().source, spectrum.source),
                          .problem = "state different editions, layers or bases",
                          .why = "spectra that are explained together need one model",
                          .remedy = "fit them apart, or correct the comments of one"});
    }
    Configuration complete = configuration;
    if (!complete.edition) complete.edition = first.edition;
    if (!complete.layers) complete.layers = first.layers;
    if (!complete.base) complete.base = first.base;
    return complete;
}

}  // namespace skinfit
