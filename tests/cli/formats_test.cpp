// The four formats of one image, read back by somebody else's programs and library.
#include <ImathBox.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "cli/process.hpp"
#include "program.hpp"
#include "support/external_program.hpp"

namespace orrery::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int width = 24;
constexpr int height = 16;

struct Exr {
    std::vector<float> red;
    std::map<std::string, std::string> attributes;
};

Exr load_exr(const std::filesystem::path& path) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i box = file.header().dataWindow();
    EXPECT_EQ(box.max.x - box.min.x + 1, width);
    EXPECT_EQ(box.max.y - box.min.y + 1, height);
    Exr exr;
    exr.red.resize(std::size_t{width} * height);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, exr.red.data(), box));
    file.setFrameBuffer(buffer);
    file.readPixels(box.min.y, box.max.y);
    for (auto i = file.header().begin(); i != file.header().end(); ++i)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            exr.attributes[i.name()] = text->value();
    return exr;
}

std::string quoted(const std::filesystem::path& path) { return " '" + path.string() + "'"; }

/// One render for all tests: a DEPTH image, whose linear values lie in [0, 1] where netpbm can show them.
class Formats : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = new TemporaryFolder;
        const Outcome outcome = orrery({"render", scene_file("tests/depth.json"), "--size", "24x16", "--seed", "7",
                                        "-o", "a.ppm", "-o", "a.png", "-o", "a.pfm", "-o", "a.EXR"},
                                       {.folder = folder->path()});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
        ASSERT_EQ(outcome.output, "a.ppm\na.png\na.pfm\na.EXR\n");
    }
    static void TearDownTestSuite() { delete folder; }

    static TemporaryFolder* folder;
};

TemporaryFolder* Formats::folder = nullptr;

TEST_F(Formats, PngAndPpmAreTheSameImageToNetpbm) {
    const std::string png = to_text(output_of(ORRERY_PNGTOPNM + quoted(*folder / "a.png")));
    const std::string ppm = to_text(output_of(ORRERY_PAMTOPNM + quoted(*folder / "a.ppm")));
    ASSERT_EQ(png.substr(0, 13), "P6\n24 16\n255\n");
    EXPECT_EQ(png, ppm);
    EXPECT_NE(png.find_first_not_of(png[13], 13), std::string::npos) << "one colour shows nothing";
}

TEST_F(Formats, PfmToNetpbmIsExrToOpenExr) {
    // 16 bit, big-endian, RGB; rows top down.
    const std::string pam = to_text(output_of(ORRERY_PFMTOPAM " -maxval=65535" + quoted(*folder / "a.pfm")));
    const std::size_t pixels = pam.size() - std::size_t{width} * height * 6;
    const std::vector<float> red = load_exr(*folder / "a.EXR").red;
    for (std::size_t i = 0; i < red.size(); ++i) {
        const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(pam[pixels + 6 * i + at]); };
        EXPECT_NEAR(red[i], (byte(0) * 256 + byte(1)) / 65535.0, 1.0 / 65535) << i;
    }
}

TEST_F(Formats, EightBitValuesAreRoundedLinearOnes) {
    // No tone mapper by default, DEPTH images lie in [0, 1).
    const std::string ppm = to_text(output_of(ORRERY_PAMTOPNM + quoted(*folder / "a.ppm")));
    const std::vector<float> red = load_exr(*folder / "a.EXR").red;
    for (std::size_t i = 0; i < red.size(); ++i)
        EXPECT_EQ(static_cast<unsigned char>(ppm[13 + 3 * i]), std::lround(255 * red[i])) << i;
}

TEST_F(Formats, CarryWhatMadeThem) {
    const std::filesystem::path text = *folder / "text";
    output_of(ORRERY_PNGTOPNM " -text=" + text.string() + quoted(*folder / "a.png"));
    const std::string ppm = load(*folder / "a.ppm");
    auto exr = load_exr(*folder / "a.EXR").attributes;
    for (const std::string& metadata : {load(text), ppm}) {
        EXPECT_THAT(metadata, HasSubstr("depth.json"));
        EXPECT_THAT(metadata, HasSubstr("orrery " ORRERY_VERSION));
        EXPECT_THAT(metadata, HasSubstr("--integrator depth --size 24x16 --spp 4"));
        EXPECT_THAT(metadata, HasSubstr("--tonemap none"));
    }
    EXPECT_EQ(exr["orrery:scene"], "depth.json");
    EXPECT_EQ(exr["orrery:seed"], "7");
    EXPECT_EQ(exr["orrery:samples"], "4");
    EXPECT_EQ(exr["orrery:version"], "orrery " + std::string(version()));
    EXPECT_EQ(exr["orrery:options"],
              "--integrator depth --size 24x16 --spp 4 --estimator sobol --seed 7 --precision float");
}

TEST_F(Formats, CarryNothingOfThisMachine) {
    for (const char* name : {"a.ppm", "a.png", "a.pfm", "a.EXR"}) {
        const std::string bytes = load(*folder / name);
        EXPECT_THAT(bytes, Not(HasSubstr(ORRERY_SCENES_DIR)));
        EXPECT_THAT(bytes, Not(HasSubstr(folder->path().string())));
    }
}

TEST_F(Formats, CanonicalOptionsRepeatTheImage) {
    const std::string options = load_exr(*folder / "a.EXR").attributes["orrery:options"];
    std::vector<std::string> arguments = {"render", scene_file("tests/depth.json"), "-o", "again.exr"};
    std::istringstream words(options);
    for (std::string word; words >> word;) arguments.push_back(word);
    ASSERT_EQ(orrery(arguments, {.folder = folder->path()}).exit_code, 0);
    EXPECT_TRUE(load(*folder / "again.exr") == load(*folder / "a.EXR"));
}

}  // namespace
}  // namespace orrery::test
