#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/text.hpp"
#include "core/version.hpp"
#include "tests/cli/cli_test.hpp"
#include "tests/install/this_build.hpp"

namespace skinfit::test {
namespace {

class Package : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        const Outcome packed = pack_build(folder());
        ASSERT_EQ(packed.exit_code, 0) << packed.out << packed.err;
        for (const auto& entry : std::filesystem::directory_iterator(folder())) {
            if (entry.path().extension() == ".deb") package_ = entry.path();
        }
        ASSERT_FALSE(package_.empty()) << packed.out;
    }

    [[nodiscard]] std::string field(const std::string& name) const {
        return std::string(trimmed(run_words({"dpkg-deb", "--field", package_.string(), name}, folder()).out));
    }
    /// Permissions and owner, by the path of each file and folder of the package.
    [[nodiscard]] std::map<std::string, std::string> content() const {
        std::map<std::string, std::string> content;
        const std::string text = run_words({"dpkg-deb", "--contents", package_.string()}, folder()).out;
        for (const std::string_view line : split_lines(text)) {
            const std::size_t path = line.find("./");
            if (path != std::string_view::npos)
                content.emplace(line.substr(path + 1), line.substr(0, line.find(' ', line.find(' ') + 1)));
        }
        return content;
    }

    void expect_fields() const;
    void expect_content() const;
    void expect_program() const;

private:
    std::filesystem::path package_;
};

void Package::expect_fields() const {
    EXPECT_EQ(field("Package"), "skinfit");
    EXPECT_EQ(field("Version"), std::string(version) + "-1");
    EXPECT_EQ(field("Maintainer"), "skinfit developers");
    EXPECT_EQ(field("Section"), "science");
    EXPECT_TRUE(field("Description").starts_with("estimates skin biology from measured light\n"));
    for (const std::string library : {"libc6", "libnlopt0", "libsqlite3-0", "libtbb12"})
        EXPECT_NE(field("Depends").find(library), std::string::npos) << library << " in " << field("Depends");
    for (const std::string recommended : {"gnuplot-nox", "libgdal"})
        EXPECT_NE(field("Recommends").find(recommended), std::string::npos) << field("Recommends");
}

void Package::expect_content() const {
    const auto files = content();
    const std::string document = "-rw-r--r-- root/root";
    const std::map<std::string, std::string> expected = {
        {"/usr/bin/skinfit", "-rwxr-xr-x root/root"},
        {"/usr/share/doc/skinfit/README.md", document},
        {"/usr/share/doc/skinfit/CITATION.cff", document},
        {"/usr/share/doc/skinfit/copyright", document},
        {"/usr/share/doc/skinfit/changelog.gz", document},
        {"/usr/share/doc/skinfit/changelog.Debian.gz", document},
        {"/usr/share/doc/skinfit/docs/installing.md", document},
        {"/usr/share/doc/skinfit/model/REFERENCES.md", document},
        {"/usr/share/man/man1/skinfit.1.gz", document},
        {"/usr/share/bash-completion/completions/skinfit", document},
        {"/usr/share/fish/vendor_completions.d/skinfit.fish", document},
        {"/usr/share/zsh/vendor-completions/_skinfit", document},
        {"/usr/share/skinfit/configs/study_example.json", document},
        {"/usr/share/skinfit/configs/instruments/ncsu_45_0.json", document},
        {"/usr/share/skinfit/configs/slurm_study.sh", "-rwxr-xr-x root/root"},
        {"/usr/share/skinfit/measurements/data/ncsu_113.csv", document},
        {"/usr/share/skinfit/measurements/data/ncsu_082.csv", document},
    };
    for (const auto& [path, permissions] : expected) {
        ASSERT_TRUE(files.contains(path)) << path;
        EXPECT_EQ(files.at(path), permissions) << path;
    }
    for (const auto& [path, permissions] : files) {
        const bool is_ours = path.starts_with("/usr/bin/") || path.starts_with("/usr/share/");
        EXPECT_TRUE(is_ours || path == "/usr/") << path;
        const bool is_known =
            permissions == document || permissions == "-rwxr-xr-x root/root" || permissions == "drwxr-xr-x root/root";
        EXPECT_TRUE(is_known) << permissions << " " << path;
    }
}

void Package::expect_program() const {
    const std::filesystem::path root = folder() / "root";
    const Outcome extracted = run_words({"dpkg-deb", "--extract", package_.string(), root.string()}, folder());
    ASSERT_EQ(extracted.exit_code, 0) << extracted.err;
    const std::filesystem::path program = root / "usr/bin/skinfit";
    EXPECT_EQ(trimmed(run_words({program.string(), "--version"}, folder()).out), version);
#ifdef NDEBUG  // asserts name their source
    EXPECT_FALSE(names_this_build(program));
#endif
}

// One test, since each would make the package anew.
TEST_F(Package, IsOfTheProgramAlone) {
    expect_fields();
    expect_content();
    expect_program();
}

}  // namespace
}  // namespace skinfit::test
