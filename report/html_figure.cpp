#include "report/html_figure.hpp"

#include <cassert>
#include <cstdint>

namespace skinfit {
namespace {

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

std::string_view media_type(std::string_view picture) {
    if (picture.starts_with(png_signature)) return "image/png";
    assert(picture.find("<svg") != std::string_view::npos);
    return "image/svg+xml";
}

}  // namespace

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::string_view group = bytes.substr(at, 3);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            bits = bits << 8U | (i < group.size() ? static_cast<unsigned char>(group[i]) : 0U);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            text += i <= group.size() ? digits[bits >> (18U - 6U * i) & 63U] : '=';
        }
    }
    return text;
}

Html html_figure(const HtmlFigure& figure) {
    const std::string address = "data:" + std::string(media_type(figure.picture)) + ";base64," + base64(figure.picture);
    const Html picture{"<img src=\"" + address + "\" alt=\"" + escaped(figure.alternative).markup + "\" />"};
    Html content = element("div", picture, {{"class", "picture"}});
    if (!figure.caption.empty()) content += element("figcaption", escaped(figure.caption));
    return element("figure", content) + Html{"\n"};
}

}  // namespace skinfit
