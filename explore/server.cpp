#include "explore/server.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"
#include "explore/guard.hpp"
#include "explore/http_server.hpp"
#include "explore/page.hpp"
#include "explore/token.hpp"

namespace skinfit {
namespace {

const httplib::Headers safe_headers = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; "
     "form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"}};

const char* content_type(std::string_view name) {
    if (name.ends_with(".html")) return "text/html; charset=utf-8";
    if (name.ends_with(".css")) return "text/css; charset=utf-8";
    if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
    return "image/svg+xml";
}

RequestParts parts_of(const httplib::Request& request) {
    const bool in_header = request.has_header(token_header);
    return {.method = request.method,
            .path = request.path,
            .host = request.get_header_value("Host"),
            .origin = request.get_header_value("Origin"),
            .token = in_header ? request.get_header_value(token_header) : request.get_param_value("token"),
            .is_encoded = request.has_header("Content-Encoding") || request.has_header("Transfer-Encoding"),
            .asks_for_part = request.has_header("Range")};
}

void give(const ApiAnswer& answer, httplib::Response& response) {
    response.status = answer.status;
    // httplib does not compress JSON. To be fetched by the page, or saved: a browser that is sent to an answer's
    // address shows none of it.
    const std::string name = answer.saved_as.empty() ? "answer.json" : answer.saved_as;
    response.set_header("Content-Disposition", "attachment; filename=\"" + name + "\"");
    response.set_content(answer.body, answer.saved_as.empty() ? "application/json; charset=utf-8" : content_type(name));
}

std::string reason(int status) {
    switch (status) {
        case 404:
            return "there is nothing at this address";
        case 413:
            return fmt::format("more than {} MiB were sent at once", largest_body_bytes >> 20U);
        case 414:
            return "the address is too long";
        default:
            return "this is no request that the server understands";
    }
}

}  // namespace

struct Server::Parts {
    Api& api;
    Access access;
    HttpServer http{};

    /// Before a body is read.
    void set_guard() {
        http.set_default_headers(safe_headers);
        http.set_payload_max_length(largest_body_bytes);
        http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            const std::optional<RequestRefusal> refused = refusal(parts_of(request), access);
            if (!refused) return httplib::Server::HandlerResponse::Unhandled;
            give(error_answer(refused->message, refused->status), response);
            return httplib::Server::HandlerResponse::Handled;
        });
        http.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.body.empty()) give(error_answer(reason(response.status), response.status), response);
        });
    }

    void set_answers() {
        const auto ask = [this](const httplib::Request& request, httplib::Response& response) {
            give(api.answer({.method = request.method,
                             .path = request.path,
                             .name = request.get_param_value("name"),
                             .size = request.get_param_value("size"),
                             .body = request.body}),
                 response);
        };
        for (const char* path : {"/api/simulate", "/api/sensitivity", "/api/spectra", "/api/export", "/api/fit"}) {
            http.Post(path, ask);
        }
        http.Get("/api/vocabulary", ask).Get("/api/sample", ask).Get("/api/report", ask);
        http.Get("/api/fit", ask).Delete("/api/fit", ask);
        const auto show = [](const httplib::Request& request, httplib::Response& response) {
            // A path is matched as a regular expression, which other paths may meet.
            const EmbeddedFile* const file = find_page_file(request.path);
            if (file == nullptr) return give(error_answer(reason(404), 404), response);
            response.set_content(file->text.data(), file->text.size(), content_type(file->name));
        };
        http.Get("/", show);
        for (const EmbeddedFile& file : page_files()) http.Get("/" + std::string(file.name), show);
    }
};

Server::Server(Api& api, int port) : parts_(new Parts{.api = api, .access = {.port = port, .token = random_token()}}) {
    parts_->set_guard();
    parts_->set_answers();
    const std::optional<int> taken = parts_->http.bind(port);
    parts_->access.port = taken.value_or(port);
    if (taken) return;
    throw InputError({.where = fmt::format("--port {}", port),
                      .problem = "cannot be had",
                      .why = port == 0 ? "the system has no free one" : "it is in use, or reserved for the system",
                      .remedy = "choose another, or leave the option out for a free one"});
}

Server::~Server() = default;

int Server::port() const {
    return parts_->access.port;
}

const std::string& Server::token() const {
    return parts_->access.token;
}

std::string Server::url() const {
    return fmt::format("http://127.0.0.1:{}/?token={}", port(), token());
}

void Server::run() {
    parts_->http.listen_after_bind();
}

void Server::stop() {
    parts_->http.end();
}

}  // namespace skinfit
