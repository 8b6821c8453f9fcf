#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skinfit {

/// Why a request is not answered.
struct RequestRefusal {
    int status;           ///< of HTTP
    std::string message;  ///< for people
};

/// Who may ask: whoever knows the token, at the server's own address.
struct Access {
    int port;
    std::string token;
};

/// The parts of a request that decide whether it is answered; empty where they are missing.
struct RequestParts {
    std::string method;
    std::string path;
    std::string host;
    std::string origin;
    std::string token;           ///< of the header or the query
    bool is_encoded = false;     ///< has a Content-Encoding or Transfer-Encoding, whose size is not known beforehand
    bool asks_for_part = false;  ///< has a Range
};

/// The header that carries the token.
inline constexpr const char* token_header = "X-Skinfit-Token";

/// Nothing for a request that may be answered. `Host` must name this server, so that no other name can be made to lead
/// here (DNS rebinding); `Origin`, where there is one, must be this server. Everything but the page's files, which are
/// the same in every installation, needs the token.
[[nodiscard]] std::optional<RequestRefusal> refusal(const RequestParts& request, const Access& access);

}  // namespace skinfit
