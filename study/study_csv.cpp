#include "study/study_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/csv.hpp"
#include "fit/report.hpp"
#include "study/colour_classes.hpp"

namespace skinfit {
namespace {

/// The columns that some row has, each once, in the order of their first row.
struct StudyColumns {
    std::vector<std::string> metadata;
    std::vector<std::string> parameters;
    std::vector<std::string> tissue;
    std::vector<std::string> indices;
    std::vector<std::pair<std::string, std::string>> correlated;
};

template <class List, class Item>
void add_new(List& list, const Item& item) {
    if (std::ranges::find(list, item) == list.end()) list.push_back(item);
}

StudyColumns columns_of(const std::vector<AnsweredRow>& rows) {
    StudyColumns columns;
    for (const AnsweredRow& each : rows) {
        for (const auto& [name, word] : each.row.metadata) add_new(columns.metadata, name);
        const std::vector<ParameterEstimate>& parameters = each.row.studied.parameters;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            add_new(columns.parameters, parameters[i].name);
            for (std::size_t k = 0; k < i; ++k) {
                add_new(columns.correlated, std::pair(parameters[i].name, parameters[k].name));
            }
        }
        for (const TissueValue& tissue : each.row.studied.tissue) add_new(columns.tissue, tissue.name);
        for (const IndexValue& index : each.row.studied.indices) add_new(columns.indices, std::string(index.name));
    }
    return columns;
}

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
}

/// The correlation of two parameters of a spectrum.
std::optional<double> correlation_of(const StudiedSpectrum& studied, const std::pair<std::string, std::string>& pair) {
    const auto place = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(studied.parameters, name, &ParameterEstimate::name) -
                                        studied.parameters.begin());
    };
    const std::size_t row = place(pair.first);
    const std::size_t column = place(pair.second);
    if (row >= studied.parameters.size() || column >= row) return std::nullopt;
    return studied.correlation[row * (row - 1) / 2 + column];
}

class Line {
public:
    void add(const std::string& text) { cells_.push_back(csv_cell(text)); }
    [[nodiscard]] std::string ended() const { return fmt::format("{}\n", fmt::join(cells_, ",")); }

private:
    std::vector<std::string> cells_;
};

/// Words of the metadata go under their own names, unless another column has the name.
std::string metadata_column(const std::string& name, const std::vector<std::string>& others) {
    return std::ranges::find(others, name) == others.end() ? name : "metadata_" + name;
}

std::string header_line(const Study& study, const StudyColumns& columns) {
    const std::vector<std::string> first = {"source", "number", "spectrum", "status", "verdict", "reason"};
    std::vector<std::string> last;
    for (const std::string& name : columns.parameters) {
        last.push_back(name);
        for (const char* part : {"sigma", "lower_95", "upper_95", "status", "decided_by_prior", "split_by_model"})
            last.push_back(name + "_" + part);
    }
    for (const std::string& name : columns.tissue) {
        for (const char* part : {"", "_lower_95", "_upper_95"}) last.push_back(name + part);
    }
    for (const std::string& name : columns.indices) {
        last.push_back(name);
        last.push_back(name + "_sigma");
    }
    last.emplace_back("skin_colour");
    last.emplace_back("p_skin_colour");
    for (const Indicator& indicator : study.indicators) {
        last.push_back("p_" + indicator.name);
        last.push_back("p_" + indicator.name + "_decided_by_prior");
    }
    for (const auto& [a, b] : columns.correlated) last.push_back(fmt::format("correlation_{}_{}", a, b));
    for (const char* name :
         {"rmse", "chi2", "degrees_of_freedom", "p_value", "input_hash", "configuration_hash", "seconds"}) {
        last.emplace_back(name);
    }
    std::vector<std::string> others = first;
    others.insert(others.end(), last.begin(), last.end());
    Line line;
    for (const std::string& name : first) line.add(name);
    for (const std::string& name : columns.metadata) line.add(metadata_column(name, others));
    for (const std::string& name : last) line.add(name);
    return line.ended();
}

std::string yes_or_no(bool is_so) {
    return is_so ? "yes" : "no";
}

void add_parameter(const StudiedSpectrum& studied, const std::string& name, Line& line) {
    const auto found = std::ranges::find(studied.parameters, name, &ParameterEstimate::name);
    if (found == studied.parameters.end()) {
        for (int i = 0; i < 7; ++i) line.add("");
        return;
    }
    line.add(number(found->value));
    line.add(number(found->sigma));
    line.add(number(found->interval_95.lower));
    line.add(number(found->interval_95.upper));
    line.add(std::string(name_of(found->status)));
    line.add(yes_or_no(found->decided_by_prior));
    line.add(yes_or_no(found->split_by_model));
}

void add_tissue(const StudiedSpectrum& studied, const std::string& name, Line& line) {
    const auto found = std::ranges::find(studied.tissue, name, &TissueValue::name);
    const bool known = found != studied.tissue.end();
    line.add(known ? number(found->value) : "");
    line.add(known && found->interval_95 ? number(found->interval_95->lower) : "");
    line.add(known && found->interval_95 ? number(found->interval_95->upper) : "");
}

/// The most probable class of skin colour, and its probability.
void add_colour(const StudiedSpectrum& studied, Line& line) {
    const std::optional<ColourClassProbabilities> classes = colour_classes_of(studied);
    if (!classes) {
        line.add("");
        line.add("");
        return;
    }
    const auto most = std::ranges::max_element(*classes);
    line.add(std::string(name_of(static_cast<SkinColour>(most - classes->begin()))));
    line.add(number(*most));
}

std::string row_line(const AnsweredRow& each, const StudyColumns& columns) {
    const LedgerRow& row = each.row;
    const StudiedSpectrum& studied = row.studied;
    Line line;
    line.add(row.key.source);
    line.add(fmt::format("{}", row.key.number));
    line.add(row.key.name);
    line.add(std::string(name_of(studied.status)));
    line.add(studied.verdict);
    line.add(studied.reason);
    for (const std::string& name : columns.metadata) line.add(word_of(row.metadata, name));
    for (const std::string& name : columns.parameters) add_parameter(studied, name, line);
    for (const std::string& name : columns.tissue) add_tissue(studied, name, line);
    for (const std::string& name : columns.indices) {
        const auto found = std::ranges::find(studied.indices, name, &IndexValue::name);
        const bool known = found != studied.indices.end();
        line.add(known ? number(found->value) : "");
        line.add(known ? number(found->sigma) : "");
    }
    add_colour(studied, line);
    for (const IndicatorAnswer& answer : each.indicators) {
        line.add(number(answer.probability));
        line.add(answer.probability ? yes_or_no(answer.decided_by_prior) : "");
    }
    for (const auto& pair : columns.correlated) line.add(number(correlation_of(studied, pair)));
    for (const std::optional<double>& value :
         {studied.rmse, studied.chi2, studied.degrees_of_freedom, studied.p_value}) {
        line.add(number(value));
    }
    line.add(row.input_hash);
    line.add(row.configuration_hash);
    line.add(fmt::format("{}", studied.seconds));
    return line.ended();
}

}  // namespace

std::string study_csv(const Study& study, const std::vector<AnsweredRow>& rows) {
    const StudyColumns columns = columns_of(rows);
    std::string text = header_line(study, columns);
    for (const AnsweredRow& each : rows) text += row_line(each, columns);
    return text;
}

}  // namespace skinfit
