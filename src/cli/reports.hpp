// What a render tells of itself: on the terminal, in a file of statistics, and in its images.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "image/image_file.hpp"
#include "plan/plan.hpp"
#include "wavefront/goal.hpp"
#include "wavefront/render.hpp"

namespace orrery {

/// "x.json: 512 x 512, 64 samples per pixel in 3.21 s, 80.1 Mrays/s (avx512, 2 threads), error 2.1 % (2.0 to 2.2)", and
/// where there was a goal, whether it was reached.
std::string summary(const Plan& plan, const Goal& goal, const RenderStats& stats);

/// "64 samples per pixel, error 2.1 % (2.0 to 2.2)", for a film.
std::string film_summary(double samples_per_pixel, const ImageError& error);

/// The profile as lines of text: a row per stage and bounce that ran, sums per stage, "others" last, so that the
/// seconds add up to threads times wall time.
std::string profile_table(const RenderStats& stats);

/// `--stats`: an object with a newline at its end. `images` are the files written.
std::string statistics_json(const Plan& plan, const Goal& goal, const RenderStats& stats,
                            const std::vector<std::filesystem::path>& images);

/// What made an image.
struct Making {
    std::string scene;    ///< the file's name, not the folders of somebody's machine
    std::string version;  ///< of the program
    RenderSettings settings;
    Goal goal = {};
    double exposure = 0;
    double samples = 0;                     ///< per pixel, the mean
    std::string_view content = "radiance";  ///< what the pixels are; said where it is not this
};

/// Scene, seed, samples, options and version. Nothing that threads, waves, the machine or the clock decide: the same
/// seed gives the same bytes. The exception is a goal of time.
Metadata image_metadata(const Making& making, ImageFormat format);

/// Indented, with a newline at its end. In ASCII: names of files may hold what a terminal should not see, and need not
/// be UTF-8, which JSON must be.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace orrery
