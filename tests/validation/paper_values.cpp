#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/file.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "validation/shipped.hpp"

namespace skinfit {
namespace {

/// A value that the paper states.
struct PaperValue {
    int figure;  ///< 0: Table 1
    std::size_t panel;
    std::size_t series;
    std::string name;
    double value;
};

std::vector<PaperValue> paper_values() {
    const std::string text = read_file(SKINFIT_SOURCE_DIR "/tests/validation/ka04_values.csv");
    std::vector<PaperValue> values;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with('#') || line.starts_with("place,")) continue;
        const std::vector<std::string_view> cells = split(line, ',');
        const bool is_table = cells[0] == "Table 1";
        const auto number = [&](std::string_view cell) { return is_table ? 0 : parse_count(cell).value(); };
        values.push_back({.figure = static_cast<int>(number(is_table ? "" : cells[0].substr(7))),
                          .panel = number(cells[1]),
                          .series = number(cells[2]),
                          .name = std::string(cells[3]),
                          .value = parse_number(cells[4]).value()});
    }
    return values;
}

double configured_value(const Configuration& configuration, const std::string& name) {
    if (name == "incidence_deg") return configuration.incidence_deg.value();
    return value_of(configuration.values, find_parameter(name).value());
}

std::map<int, Figure> figures() {
    std::map<int, Figure> all;
    for (const Figure& figure : shipped_figures()) all.emplace(figure.number, figure);
    return all;
}

TEST(PaperValues, FiguresAndDefaultsHaveThem) {
    const std::map<int, Figure> all = figures();
    for (const PaperValue& each : paper_values()) {
        SCOPED_TRACE(testing::Message() << "figure " << each.figure << " panel " << each.panel << " series "
                                        << each.series << ": " << each.name);
        if (each.figure == 0) {
            EXPECT_EQ(configured_value(default_configuration(), each.name), each.value);
            continue;
        }
        const FigurePanel& panel = all.at(each.figure).panels.at(each.panel);
        EXPECT_EQ(configured_value(panel.series.at(each.series).configuration, each.name), each.value);
    }
}

TEST(PaperValues, FiguresHaveNoSeriesMoreThanThePaperStates) {
    const std::map<int, Figure> all = figures();
    EXPECT_EQ(all.at(4).panels[0].series.size(), 2U);
    EXPECT_EQ(all.at(8).panels[0].series.size(), 3U);
    EXPECT_EQ(all.at(9).panels[0].series.size(), 3U);
    EXPECT_EQ(all.at(10).panels[0].series.size(), 4U);
    std::set<std::string> pigments;
    for (const FigurePanel& panel : all.at(2).panels) {
        for (const FigureSeries& series : panel.series) pigments.insert(series.name);
    }
    EXPECT_EQ(pigments.size(), 6U);
    for (const FigureSeries& series : all.at(6).panels[0].series) {
        EXPECT_LE(series.configuration.incidence_deg.value(), 60.0);
    }
}

TEST(PaperValues, ASourceSaysThePaperWhereTheTableHasIt) {
    std::map<int, std::set<std::string>> stated;
    for (const PaperValue& each : paper_values()) stated[each.figure].insert(each.name);
    for (const auto& [number, figure] : figures()) {
        for (const auto& [name, source] : figure.sources.items()) {
            const bool is_number = name == "incidence_deg" || find_parameter(name).has_value();
            if (!is_number || name == "fibril_radius_nm") continue;  // whose paper's value is that of Table 1
            EXPECT_EQ(source.get<std::string>().starts_with("paper: "), stated[number].contains(name))
                << "figure " << number << ": " << name;
        }
    }
}

}  // namespace
}  // namespace skinfit
