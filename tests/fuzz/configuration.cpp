#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"

/// Reads the bytes as a configuration in JSON. One that is accepted survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skinfit;
    try {
        const Configuration configuration =
            configured_by_text(default_configuration(), {reinterpret_cast<const char*>(data), size}, "fuzz");
        const Json json = to_json(configuration);
        if (to_json(configured(default_configuration(), json, "fuzz")) != json) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
