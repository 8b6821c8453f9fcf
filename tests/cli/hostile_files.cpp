#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>

#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

/// Files that no instrument wrote: each is refused at once, with exactly this message, by every command that reads one.
class HostileFiles : public CliTest {
protected:
    void expect_message(const std::string& file, const std::string& message) const {
        for (const std::string command : {"inspect", "convert", "fit"}) {
            SCOPED_TRACE("skinfit " + command + " " + file);
            const auto start = std::chrono::steady_clock::now();
            const Outcome outcome = run({command, file});
            EXPECT_EQ(outcome.exit_code, 2);
            EXPECT_EQ(outcome.out, "");
            EXPECT_EQ(outcome.err, "error: " + message + "\n");
            // None of them takes a second; ten leave room for a busy machine.
            EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
        }
    }

    /// A file of holes, which takes no room on the disk, after `text`.
    void put_holes(const std::string& name, const std::string& text, std::uintmax_t bytes) const {
        put(name, text);
        std::filesystem::resize_file(folder() / name, bytes);
    }
};

constexpr std::uintmax_t two_gigabytes = 2'000'000'000;

TEST_F(HostileFiles, ThatAreNoOrdinaryFiles) {
    ASSERT_EQ(::mkfifo((folder() / "pipe.csv").c_str(), 0600), 0);
    expect_message("pipe.csv",
                   "pipe.csv: is a pipe into which nobody writes (5 s have been waited for it); start the program that "
                   "writes into "
                   "it first, or name a file");
    std::filesystem::create_directory(folder() / "folder.csv");
    expect_message("folder.csv", "folder.csv: is a folder (a file is needed here); name a file inside it");
    std::filesystem::create_symlink("loop.csv", folder() / "loop.csv");
    expect_message("loop.csv",
                   "loop.csv: cannot be read (Too many levels of symbolic links); check the name and the permission to "
                   "read it");
    expect_message(
        "/dev/zero",
        "/dev/zero: is a pipe or a device (an ordinary file is needed here); write its content to a file first");
}

TEST_F(HostileFiles, ThatAreHuge) {
    put_holes("line.csv", "400,0.5", two_gigabytes);
    expect_message(
        "line.csv",
        "line.csv:1: has more than 16 MiB in one line (no file of spectra has such lines); check that this is a "
        "file of spectra");
    put_holes("large.csv", "400,0.5\n", 3 * two_gigabytes);
    expect_message("large.csv", "large.csv: is too large (at most 2 GiB are read at once); split it");
    struct rusage used {};
    ASSERT_EQ(::getrusage(RUSAGE_CHILDREN, &used), 0);
    EXPECT_LT(used.ru_maxrss, 100L << 10U) << "KiB: the line is read block by block";
}

TEST_F(HostileFiles, ThatAreSomethingElse) {
    put("spectra.csv", std::string("PK\x03\x04\x14\0\0\0\x08\0", 10));
    expect_message("spectra.csv",
                   "spectra.csv: is a zip archive (plain text is needed; spreadsheets such as .xlsx and .ods are zip "
                   "archives too); unpack it, or export the spreadsheet as CSV in UTF-8");
    put("binary.csv", std::string("400,0.5\n\x7f"
                                  "ELF\0\1\2",
                                  15));
    expect_message("binary.csv",
                   "binary.csv:2: holds the control byte 0x7f (plain text is needed; this is a binary, spreadsheet or "
                   "UTF-16 file); export it as plain text or CSV in UTF-8");
    put("empty.csv", "");
    expect_message(
        "empty.csv",
        "empty.csv: is empty (lines of a wavelength and its values are needed); check that the file is complete");
}

TEST_F(HostileFiles, ThatNestDeeply) {
    put("deep.json", std::string(1'000'000, '['));
    expect_message(
        "deep.json",
        "deep.json: nests more than 64 deep (no file of ours is so deep); check that this is the right file");
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    put("objects.json", objects);
    expect_message(
        "objects.json",
        "objects.json: nests more than 64 deep (no file of ours is so deep); check that this is the right file");
}

TEST_F(HostileFiles, ThatPromiseMoreThanTheyHold) {
    const std::string layout = "data type = 4\ninterleave = bip\nbyte order = 0\n";
    put("cube.dat", "");
    put("cube.hdr", "ENVI\nsamples = 1000000000000000000\nlines = 1\nbands = 1\n" + layout);
    expect_message(
        "cube.hdr",
        "cube.hdr:2: \"samples\" is \"1000000000000000000\" (it must be a whole number from 1 to 2147483647); "
        "correct the header, or export the data in another way");
    put("cube.hdr", "ENVI\nsamples = 1000000000\nlines = 1000000000\nbands = 1\n" + layout);
    expect_message("cube.dat",
                   "cube.dat: has 0 bytes (its header promises 4000000000000000000); copy the file again if it is cut "
                   "short, else correct the sizes in the header");
}

TEST_F(HostileFiles, OfMoreWavelengthsThanAnyEngineFits) {
    std::string text = "wavelength_nm,reflectance\n";
    for (int i = 0; i < 10'001; ++i) text += fmt::format("{},{}\n", 400 + 0.02 * i, 0.2 + 1e-5 * i);
    put("fine.csv", text);
    for (const std::string engine : {"paths", "solver", "emulator"}) {
        const Outcome outcome = run({"fit", "fine.csv", "--set", "engine=" + engine});
        EXPECT_EQ(outcome.exit_code, 2) << engine;
        EXPECT_EQ(outcome.err,
                  "error: fine.csv: holds 10001 wavelengths between 400 and 700 nm (at most 10000 are fitted); average "
                  "neighbours, or narrow the window\n");
    }
}

}  // namespace
}  // namespace skinfit::test
