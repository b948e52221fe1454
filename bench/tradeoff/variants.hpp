// The ways to render a scene that are compared: the options that trade accuracy for time, and combinations of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernels/isa.hpp"
#include "scene/scene.hpp"

namespace orrery::tradeoff {

/// How samples are taken: all of a pixel in one go, or as --error and --time do, the same for all pixels or where the
/// error is.
enum class Taking : std::uint8_t { at_once, in_passes, adaptively };

/// All that a variant may choose.
struct Setup {
    RenderSettings settings;
    Isa isa = best_isa();
    Taking taking = Taking::at_once;
};

/// One word of one option, as on the command line: {"--transport", "nee"}.
struct Choice {
    std::string option, word;
    std::function<void(Setup&)> choose = {};  ///< puts it into a setup
};

/// The usual setup with some choices made. No choice: the program's defaults.
struct Variant {
    std::vector<Choice> choices;

    Setup setup(const RenderSettings& usual) const;
    /// "--transport nee --roulette off"; "defaults" where nothing is chosen.
    std::string name() const;
    bool chooses(const std::string& option) const;
    /// Whether it chooses instruction set or number format, which change time, and of the image hardly anything.
    bool is_about_time() const { return chooses("--isa") || chooses("--precision"); }
};

/// The defaults first; then all combinations of the options whose effects depend on each other; then each other option
/// by itself. A setting of words that changes no expectation is among them without further
/// ado; of one of numbers variants.cpp says which to try.
std::vector<Variant> all_variants();

/// What the scene says to compute, at `pixels` pixels or about, as the program would by default: whatever the scene
/// says about the options compared does not count.
RenderSettings usual_settings(const RenderSettings& of_scene, double pixels);

}  // namespace orrery::tradeoff
