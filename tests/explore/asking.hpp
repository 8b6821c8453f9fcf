#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <thread>

#include "core/json.hpp"
#include "explore/api.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {

/// An answer of the application, its body read.
struct Answer {
    int status;
    Json json;
};

/// Tests that ask the application without a network.
class Asking : public ::testing::Test {
protected:
    [[nodiscard]] Answer ask(const std::string& method, const std::string& path, const std::string& body = "",
                             const std::string& name = "") {
        const ApiAnswer answer = api_.answer({.method = method, .path = path, .name = name, .body = body});
        return {answer.status, Json::parse(answer.body)};
    }
    [[nodiscard]] Answer post(const std::string& path, const Json& json) { return ask("POST", path, json.dump()); }
    /// Of the one model of a configuration without spectra; or the error.
    [[nodiscard]] Answer simulate(const Json& configuration) {
        const Answer answer = post("/api/simulate", {{"configuration", configuration}});
        return answer.status == 200 ? Answer{200, answer.json["models"].at(0)} : answer;
    }

    /// The state of a fit once it has ended.
    [[nodiscard]] Json ended(const std::string& name) {
        for (;;) {
            Json state = ask("GET", "/api/fit", "", name).json;
            if (state["state"] != "running") return state;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }

    Api api_{no_cache(), std::nullopt};
};

}  // namespace skinfit::test
