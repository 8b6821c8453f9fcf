#include "explore/guard.hpp"

#include <fmt/format.h>

#include "explore/page.hpp"
#include "explore/token.hpp"

namespace skinfit {
namespace {

bool is_own_host(std::string_view host, int port) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool is_own_origin(std::string_view origin, int port) {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && is_own_host(origin.substr(scheme.size()), port);
}

}  // namespace

std::optional<RequestRefusal> refusal(const RequestParts& request, const Access& access) {
    if (!is_own_host(request.host, access.port)) {
        return RequestRefusal{421, "this server answers to its own address alone; use the URL that skinfit printed"};
    }
    if (!request.origin.empty() && !is_own_origin(request.origin, access.port)) {
        return RequestRefusal{403, "another site may not ask this server"};
    }
    if (request.is_encoded) return RequestRefusal{411, "send the body as it is, with its Content-Length"};
    if (request.asks_for_part) return RequestRefusal{416, "ask for the whole of it"};
    if (request.method == "GET" && find_page_file(request.path) != nullptr) return std::nullopt;
    if (same_secret(request.token, access.token)) return std::nullopt;
    return RequestRefusal{403, "the token is missing or wrong; use the URL that skinfit printed"};
}

}  // namespace skinfit
