#include "core/utf8.hpp"

#include "core/json.hpp"

namespace skinfit {

bool is_utf8(std::string_view text) {
    try {
        (void)Json(text).dump();
        return true;
    } catch (const Json::type_error&) {
        return false;
    }
}

}  // namespace skinfit
