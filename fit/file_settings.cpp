#include "fit/file_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"

namespace skinfit {

Configuration with_file_settings(Configuration configuration, const Spectrum& spectrum) {
    constexpr std::array<std::string_view, 3> keys = {"edition", "layers", "base"};
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

}  // namespace skinfit
