#include "report/html_page.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "core/embedded_file.hpp"

namespace skinfit {

namespace page_style {
std::span<const EmbeddedFile> embedded_files();
}  // namespace page_style

namespace {

std::string_view style() {
    return page_style::embedded_files().front().text;
}

std::string words_joined(std::string_view title) {
    std::string anchor;
    for (const char c : title) {
        const bool is_upper = c >= 'A' && c <= 'Z';
        if (is_upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            anchor += is_upper ? static_cast<char>(c - 'A' + 'a') : c;
        } else if (!anchor.empty() && anchor.back() != '-') {
            anchor += '-';
        }
    }
    while (anchor.ends_with('-')) anchor.pop_back();
    return anchor.empty() ? "section" : anchor;
}

Html contents(const std::vector<HtmlSection>& sections, const std::vector<std::string>& anchors) {
    if (sections.size() < 2) return {};
    Html items;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        items += element("li", element("a", escaped(sections[i].title), {{"href", "#" + anchors[i]}})) + Html{"\n"};
    }
    return element("nav", element("ol", Html{"\n"} + items), {{"aria-label", "Contents"}}) + Html{"\n"};
}

Html section(const HtmlSection& part, const std::string& anchor) {
    HtmlAttributes attributes = {{"aria-labelledby", anchor}};
    if (part.starts_page) attributes.emplace_back("class", "page");
    const Html heading = element("h2", escaped(part.title), {{"id", anchor}}) + Html{"\n"};
    return element("section", heading + part.body, attributes) + Html{"\n"};
}

// Nothing is loaded and nothing runs, whatever the text of a file managed to become.
constexpr std::string_view head_start =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\" />\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
    "<meta name=\"color-scheme\" content=\"light dark\" />\n"
    "<meta name=\"referrer\" content=\"no-referrer\" />\n";

}  // namespace

std::vector<std::string> anchors_of(const std::vector<HtmlSection>& sections) {
    std::vector<std::string> anchors;
    for (const HtmlSection& each : sections) {
        const std::string words = words_joined(each.title);
        std::string anchor = words;
        for (int number = 2; std::ranges::find(anchors, anchor) != anchors.end(); ++number) {
            anchor = words + "-" + std::to_string(number);
        }
        anchors.push_back(anchor);
    }
    return anchors;
}

std::string html_page(const HtmlPage& page) {
    const std::vector<std::string> anchors = anchors_of(page.sections);
    Html sections;
    for (std::size_t i = 0; i < page.sections.size(); ++i) sections += section(page.sections[i], anchors[i]);
    const Html header = element("header", element("h1", escaped(page.title)) + Html{"\n"} + page.summary) + Html{"\n"};
    Html body = header + contents(page.sections, anchors);
    body += element("main", Html{"\n"} + sections) + Html{"\n"};
    if (!page.footer.empty()) body += element("footer", paragraph(page.footer)) + Html{"\n"};
    std::string text(head_start);
    text += element("title", escaped(page.title)).markup + "\n<style>\n" + std::string(style()) + "</style>\n</head>\n";
    return text + element("body", Html{"\n"} + body).markup + "\n</html>\n";
}

std::string html_page(const std::string& title, const Html& body) {
    return html_page(HtmlPage{.title = title, .summary = body, .sections = {}});
}

}  // namespace skinfit
