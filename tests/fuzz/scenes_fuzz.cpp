// Structured scenes through every oracle: the first bytes choose the settings and the world, the last the oracle.
#include <cstdio>
#include <cstdlib>

#include "oracles.hpp"
#include "scene_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace orrery;
    fuzz::Choices choices(std::span(data, size));
    // Ahead of the scene, so that an input that ends early still names its oracle.
    std::array<std::uint8_t, 32> how{};
    for (std::uint8_t& byte : how) byte = static_cast<std::uint8_t>(choices.byte());
    fuzz::Choices way(how);
    try {
        fuzz::check(fuzz::scene_from_bytes(choices), way);
    } catch (const fuzz::Finding& finding) {
        std::fprintf(stderr, "FINDING: %s\n%s\n", finding.what(), fuzz::scene_text(finding.scene).c_str());
        std::abort();
    }
    return 0;
}
