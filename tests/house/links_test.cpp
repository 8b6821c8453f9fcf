#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "tests/house/markdown.hpp"
#include "tests/house/source_tree.hpp"

/// Every relative link of the documents leads somewhere: to a file or folder, and where it names a heading to one.
namespace skinfit::house {
namespace {

using Complaints = std::vector<std::string>;

/// The targets of the links and pictures of a document: `[text](target)` and `[text]: target`.
std::vector<std::string> link_targets(std::string_view document) {
    const std::string prose = without_code(document);
    std::vector<std::string> targets;
    for (std::size_t at = prose.find("]("); at != std::string::npos; at = prose.find("](", at + 1)) {
        const std::size_t begin = at + 2;
        const std::string inside = prose.substr(begin, prose.find(')', begin) - begin);
        targets.emplace_back(trimmed(inside.substr(0, inside.find(" \""))));
    }
    for (const std::string_view line : split_lines(prose)) {
        const std::size_t colon = line.find("]: ");
        if (line.starts_with('[') && colon != std::string_view::npos) {
            targets.emplace_back(trimmed(line.substr(colon + 3)));
        }
    }
    return targets;
}

/// The anchor of a heading: small letters, digits, hyphens and underscores; blanks become hyphens.
std::string anchor_of(std::string_view heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
            anchor.push_back(static_cast<char>(std::tolower(byte)));
        } else if (c == ' ') {
            anchor.push_back('-');
        }
    }
    return anchor;
}

/// The anchors of a document; the second heading of the same words has -1 behind them, and so on.
std::set<std::string> anchors_in(std::string_view document) {
    std::set<std::string> anchors;
    std::map<std::string, int> seen;
    const std::string prose = without_code_blocks(document);
    for (const std::string_view line : split_lines(prose)) {
        const std::size_t level = line.find_first_not_of('#');
        if (level == 0 || level > 6 || level == std::string_view::npos || line[level] != ' ') continue;
        const std::string anchor = anchor_of(trimmed(line.substr(level)));
        const int before = seen[anchor]++;
        anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
    }
    return anchors;
}

bool leaves_the_project(const std::string& target) {
    return target.find("://") != std::string::npos || target.starts_with("mailto:");
}

/// What files there are and what is in them, for the test and for the tests of the test.
struct Tree {
    std::function<bool(const std::string&)> exists = source_exists;
    std::function<std::string(const std::string&)> text = source_text;
};

/// What is wrong with a link of the document at `path`; empty where it leads somewhere.
std::string fault(const std::string& path, const std::string& target, const Tree& tree) {
    if (leaves_the_project(target)) return {};
    if (target.empty() || target.starts_with('/')) return "is no relative link";
    const std::size_t hash = std::min(target.find('#'), target.size());
    const std::string file =
        hash == 0
            ? path
            : (std::filesystem::path(path).parent_path() / target.substr(0, hash)).lexically_normal().generic_string();
    if (file.starts_with("..")) return "leaves the project";
    if (!tree.exists(file)) return "leads to no file";
    if (hash == target.size()) return {};
    if (!file.ends_with(".md")) return "names a heading of a file that has none";
    return anchors_in(tree.text(file)).contains(target.substr(hash + 1)) ? "" : "leads to no heading";
}

Complaints broken_links(const std::vector<SourceFile>& documents, const Tree& tree) {
    Complaints complaints;
    for (const SourceFile& document : documents) {
        for (const std::string& target : link_targets(document.text)) {
            const std::string wrong = fault(document.path, target, tree);
            if (!wrong.empty()) complaints.push_back(document.path + ": " + target + " " + wrong);
        }
    }
    return complaints;
}

/// The documents in docs that no other document links.
Complaints unlinked(const std::vector<SourceFile>& documents) {
    std::set<std::string> linked;
    for (const SourceFile& document : documents) {
        for (const std::string& target : link_targets(document.text)) {
            const std::string file = target.substr(0, target.find('#'));
            const std::filesystem::path folder = std::filesystem::path(document.path).parent_path();
            const std::string to = (folder / file).lexically_normal().generic_string();
            if (to != document.path) linked.insert(to);
        }
    }
    Complaints complaints;
    for (const SourceFile& document : documents) {
        if (document.path.starts_with("docs/") && !linked.contains(document.path)) complaints.push_back(document.path);
    }
    return complaints;
}

TEST(Links, LeadToFilesAndHeadings) {
    const std::vector<SourceFile> all = documents();
    for (const char* const needed : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/model.md",
                                     "docs/architecture.md", "model/REFERENCES.md"}) {
        EXPECT_TRUE(std::ranges::any_of(all, [&](const SourceFile& file) { return file.path == needed; })) << needed;
    }
    EXPECT_EQ(broken_links(all, {}), Complaints());
}

TEST(Links, ReachEveryDocument) {
    EXPECT_EQ(unlinked(documents()), Complaints());
}

TEST(Links, EveryBrokenOneIsFound) {
    const Tree tree{.exists = [](const std::string& path) { return path == "docs/b.md" || path == "model/c.hpp"; },
                    .text = [](const std::string&) { return std::string("# A heading\n"); }};
    const SourceFile good{.path = "docs/a.md",
                          .text =
                              "[b](b.md) [b](b.md#a-heading) [`c`](../model/c.hpp \"title\") [x](https://x.org/a#b)\n"
                              "`[code](nowhere)` \n```\n[code](nowhere)\n```\n"};
    EXPECT_EQ(broken_links({good}, tree), Complaints());
    const SourceFile bad{.path = "docs/a.md",
                         .text =
                             "[no\nfile](no.md) ![no picture](no.png) [no heading](b.md#b) [own](#a-heading-1)\n"
                             "[`c`](../model/c.hpp#L3) [out](../../x) [root](/docs/b.md)\n\n[ref]: gone.md\n"};
    EXPECT_EQ(broken_links({bad}, tree),
              (Complaints{"docs/a.md: no.md leads to no file", "docs/a.md: no.png leads to no file",
                          "docs/a.md: b.md#b leads to no heading", "docs/a.md: #a-heading-1 leads to no file",
                          "docs/a.md: ../model/c.hpp#L3 names a heading of a file that has none",
                          "docs/a.md: ../../x leaves the project", "docs/a.md: /docs/b.md is no relative link",
                          "docs/a.md: gone.md leads to no file"}));
}

TEST(Links, EveryRealOneIsMissedWhenItsFileIsGone) {
    const Tree empty{.exists = [](const std::string&) { return false; }, .text = source_text};
    for (const SourceFile& document : documents()) {
        const std::vector<std::string> targets = link_targets(document.text);
        const auto inside = std::ranges::count_if(targets, std::not_fn(leaves_the_project));
        EXPECT_EQ(broken_links({document}, empty).size(), static_cast<std::size_t>(inside)) << document.path;
    }
}

TEST(Links, ADocumentThatNobodyLinksIsFound) {
    EXPECT_EQ(unlinked({{.path = "README.md", .text = "[b](docs/b.md#x)"},
                        {.path = "docs/b.md", .text = "[b](b.md)"},
                        {.path = "docs/c.md", .text = "[c](c.md)"}}),
              Complaints{"docs/c.md"});
}

TEST(Links, AnchorsAreThoseOfTheHeadings) {
    EXPECT_EQ(anchors_in("# The `model`, in (4) steps\ntext\n## A-b_c\n## A-b_c\n#no\n```\n# code\n```\n"),
              (std::set<std::string>{"the-model-in-4-steps", "a-b_c", "a-b_c-1"}));
}

}  // namespace
}  // namespace skinfit::house
