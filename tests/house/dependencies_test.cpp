#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "tests/house/source_tree.hpp"

/// The arrows of the diagram in docs/architecture.md say which folder may include which. They are held against what the
/// sources include, both ways.
namespace skinfit::house {
namespace {

using Complaints = std::vector<std::string>;
using Arrow = std::pair<std::string, std::string>;  // from the folder that includes to the one that is included

/// What the diagram shows, and what could not be read of it.
struct Diagram {
    std::set<std::string> folders;
    std::set<Arrow> arrows;
    Complaints unread;
};

/// The folder of a node, which may have a label: `fit["fit: configuration"]`. Empty where it is none.
std::string node_name(std::string_view node) {
    const std::string_view name = trimmed(node.substr(0, node.find('[')));
    const bool is_name = std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
    return is_name ? std::string(name) : std::string();
}

/// The text between one `-->` and the next.
std::vector<std::string_view> parts_between_arrows(std::string_view line) {
    constexpr std::string_view arrow = "-->";
    std::vector<std::string_view> parts;
    for (std::size_t found = line.find(arrow); found != std::string_view::npos; found = line.find(arrow)) {
        parts.push_back(line.substr(0, found));
        line.remove_prefix(found + arrow.size());
    }
    parts.push_back(line);
    return parts;
}

/// Reads a line `a & b --> c & d`, or one that only names nodes.
void read_line(std::string_view line, Diagram& diagram) {
    std::vector<std::string> from;
    for (const std::string_view part : parts_between_arrows(line)) {
        std::vector<std::string> to;
        for (const std::string_view node : split(part, '&')) {
            to.push_back(node_name(node));
            if (to.back().empty()) return diagram.unread.emplace_back(line), void();
            diagram.folders.insert(to.back());
        }
        for (const std::string& a : from) {
            for (const std::string& b : to) {
                if (!diagram.arrows.emplace(a, b).second) diagram.unread.push_back(a + " --> " + b + " again");
            }
        }
        from = to;
    }
}

/// The mermaid block of a document, which must have one.
Diagram diagram_of(std::string_view document) {
    Diagram diagram;
    int blocks = 0;
    bool inside = false;
    for (std::string_view line : split_lines(document)) {
        line = trimmed(line);
        if (line.starts_with("```")) {
            inside = !inside && line == "```mermaid";
            blocks += inside ? 1 : 0;
        } else if (inside && !line.empty() && !line.starts_with("%%") && !line.starts_with("flowchart ")) {
            read_line(line, diagram);
        }
    }
    if (blocks != 1) diagram.unread.push_back("there are " + std::to_string(blocks) + " mermaid blocks, not one");
    return diagram;
}

std::string first_folder(std::string_view path) {
    return std::string(path.substr(0, path.find('/')));
}

/// What a line includes, between quotes or angle brackets; empty where it includes nothing.
std::string_view included(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with('#')) return {};
    line = trimmed(line.substr(1));
    if (!line.starts_with("include")) return {};
    const std::size_t open = line.find_first_of("\"<");
    if (open == std::string_view::npos) return {};
    return line.substr(open + 1, line.find_first_of("\">", open + 1) - open - 1);
}

/// The includes from one of `folders` into another, or into the tests, each with the first line that has it.
std::map<Arrow, std::string> arrows_of(const std::vector<SourceFile>& files, const std::vector<std::string>& folders) {
    std::map<Arrow, std::string> arrows;
    for (const SourceFile& file : files) {
        const std::string from = first_folder(file.path);
        for (const std::string_view line : split_lines(file.text)) {
            const std::string to = first_folder(included(line));
            const bool is_ours = to == "tests" || std::ranges::find(folders, to) != folders.end();
            if (is_ours && to != from) arrows.emplace(Arrow(from, to), file.path + ": " + std::string(trimmed(line)));
        }
    }
    return arrows;
}

/// Where the diagram and the sources differ.
Complaints differences(const Diagram& diagram, const std::map<Arrow, std::string>& real) {
    Complaints complaints = diagram.unread;
    for (const auto& [arrow, line] : real) {
        if (!diagram.arrows.contains(arrow)) complaints.push_back("not in the diagram: " + line);
    }
    for (const Arrow& arrow : diagram.arrows) {
        if (!real.contains(arrow)) complaints.push_back("in no source: " + arrow.first + " --> " + arrow.second);
    }
    return complaints;
}

/// The folders from which arrows lead back to themselves.
std::set<std::string> folders_in_circles(std::set<Arrow> arrows) {
    for (bool grown = true; grown;) {
        const std::size_t before = arrows.size();
        const std::set<Arrow> known = arrows;
        for (const auto& [a, b] : known) {
            for (const auto& [c, d] : known) {
                if (b == c) arrows.emplace(a, d);
            }
        }
        grown = arrows.size() > before;
    }
    std::set<std::string> circular;
    for (const auto& [a, b] : arrows) {
        if (a == b) circular.insert(a);
    }
    return circular;
}

class Dependencies : public testing::Test {
protected:
    const std::vector<std::string> folders_ = source_folders();
    const Diagram diagram_ = diagram_of(source_text("docs/architecture.md"));
    const std::map<Arrow, std::string> real_ = arrows_of(source_files(folders_, {".cpp", ".hpp"}), folders_);
};

TEST_F(Dependencies, AreThoseOfTheDiagram) {
    ASSERT_FALSE(real_.empty());
    EXPECT_EQ(diagram_.folders, std::set<std::string>(folders_.begin(), folders_.end()));
    EXPECT_EQ(differences(diagram_, real_), Complaints());
}

TEST_F(Dependencies, PointOneWay) {
    EXPECT_EQ(folders_in_circles(diagram_.arrows), std::set<std::string>());
    for (const auto& [from, to] : diagram_.arrows) {
        EXPECT_NE(to, "app") << from;
        EXPECT_NE(to, "tests") << from;
        // The skin knows nothing of files of spectra, nor these of the skin.
        if (from == "model" || from == "measurements") {
            EXPECT_EQ(to, "core") << from;
        }
        // The second physics is no engine of a fit.
        if (from == "transport") {
            EXPECT_TRUE(to == "core" || to == "model") << to;
        }
        EXPECT_NE(from, "core") << to;
    }
}

TEST_F(Dependencies, EveryMissingAndEverySuperfluousArrowIsFound) {
    for (const std::string& from : folders_) {
        for (const std::string& to : folders_) {
            if (from == to) continue;
            Diagram other = diagram_;
            if (other.arrows.erase({from, to}) == 0) other.arrows.emplace(from, to);
            EXPECT_EQ(differences(other, real_).size(), 1U) << from << " --> " << to;
        }
    }
}

TEST(DependenciesReading, ACircleIsFound) {
    EXPECT_EQ(folders_in_circles({{"a", "b"}, {"b", "c"}, {"c", "b"}, {"c", "d"}}), (std::set<std::string>{"b", "c"}));
}

TEST(DependenciesReading, EveryFormOfTheDiagramIsRead) {
    const Diagram diagram = diagram_of(
        "text --> ignored\n```mermaid\nflowchart TD\n%% why --> not\n  app[\"app: commands\"]\n  app --> fit & core\n"
        "  fit & model --> core\n```\nmore --> ignored\n");
    EXPECT_EQ(diagram.folders, (std::set<std::string>{"app", "core", "fit", "model"}));
    EXPECT_EQ(diagram.arrows, (std::set<Arrow>{{"app", "core"}, {"app", "fit"}, {"fit", "core"}, {"model", "core"}}));
    EXPECT_EQ(diagram.unread, Complaints());
}

TEST(DependenciesReading, WhatTheTestCannotReadIsAComplaint) {
    EXPECT_EQ(diagram_of("no diagram").unread, Complaints{"there are 0 mermaid blocks, not one"});
    EXPECT_EQ(diagram_of("```mermaid\na -.-> b\na --- b\na --> b\na --> b\n```").unread,
              (Complaints{"a -.-> b", "a --- b", "a --> b again"}));
}

TEST(DependenciesReading, EveryWayToWriteAnIncludeIsRead) {
    const SourceFile file{.path = "model/a.cpp",
                          .text =
                              "  # include  <fit/b.hpp>\r\n#include <vector>\n#include \"app/c.hpp\"  // why\n"
                              "// #include \"core/d.hpp\"\n#define include \"core/e.hpp\"\n#include \"model/f.hpp\"\n"
                              "#include \"tests/g.hpp\"\n"};
    const std::map<Arrow, std::string> found = {
        {{"model", "app"}, "model/a.cpp: #include \"app/c.hpp\"  // why"},
        {{"model", "fit"}, "model/a.cpp: # include  <fit/b.hpp>"},
        {{"model", "tests"}, "model/a.cpp: #include \"tests/g.hpp\""},
    };
    EXPECT_EQ(arrows_of({file}, {"app", "core", "fit", "model"}), found);
}

}  // namespace
}  // namespace skinfit::house
